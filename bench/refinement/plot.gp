# Pictures of refinement.csv, as SVG and PNG beside it.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/refinement/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
set datafile separator ","
set datafile missing NaN
set grid lc rgb "#dddddd"
set logscale xy
set format y "10^{%T}"
of(scene, mesh, x) = (strcol(1) eq scene && strcol(2) eq "adaptive" && strcol(3) eq mesh) ? x : NaN
table = folder . "/refinement.csv"
# Rows of plots: which scenes, which column across, which error.
scenes(row) = row == 3 ? "tableroom_a cornell corner2_90_a" : "half_plane tableroom_a cornell"
across(row) = row == 2 ? 7 : 4
error(row) = row == 3 ? 8 : 9
do for [type in "svg png"] {
  if (type eq "svg") { set terminal svg size 1200,960 font "sans-serif,12" background "white" } else { set terminal pngcairo size 1200,960 font "sans,9" }
  set output folder . "/refinement." . type
  set multiplot layout 3,3 title "Error of B on rung adaptive: of what is drawn on the floor, and of means over the patches of the reference mesh"
  do for [row = 1:3] {
    do for [s = 1:3] {
      scene = word(scenes(row), s)
      set title scene noenhanced
      set xlabel row == 2 ? "seconds of the processor" : "elements"
      set ylabel row == 3 ? "relative RMS error, means" : "relative RMS error, drawn"
      if (row == 1 && s == 3) { set key top right } else { unset key }
      plot table using (of(scene, "uniform", column(across(row)))):(column(error(row))) with linespoints lc rgb "#2060b0" lw 1.5 pt 7 ps 0.5 title "uniform", \
           table using (of(scene, "adaptive", column(across(row)))):(column(error(row))) with linespoints lc rgb "#c03028" lw 1.5 pt 7 ps 0.5 title "adaptive", \
           table using (of(scene, "discontinuity", column(across(row)))):(column(error(row))) with linespoints lc rgb "#208040" lw 1.5 pt 7 ps 0.5 title "discontinuity", \
           table using (of(scene, "both", column(across(row)))):(column(error(row))) with linespoints lc rgb "#8040a0" lw 1.5 pt 7 ps 0.5 title "discontinuity, then adaptive"
    }
  }
  unset multiplot
  unset output
}
