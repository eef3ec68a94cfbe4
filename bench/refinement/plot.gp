# Pictures of refinement.csv, as SVG and PNG beside it.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/refinement/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
set datafile separator ","
set datafile missing NaN
set grid lc rgb "#dddddd"
set logscale xy
set format y "10^{%T}"
scenes = "tableroom_a cornell corner2_90_a"
of(scene, rung, mesh, x) = (strcol(1) eq scene && strcol(2) eq rung && strcol(3) eq mesh) ? x : NaN
table = folder . "/refinement.csv"
do for [type in "svg png"] {
  if (type eq "svg") { set terminal svg size 1200,640 font "sans-serif,12" background "white" } else { set terminal pngcairo size 1200,640 font "sans,9" }
  set output folder . "/refinement." . type
  set multiplot layout 2,3 title "Error of B against the continuous solution, elements averaged to its patches"
  do for [field in "4 7"] {
    do for [s = 1:3] {
      set title word(scenes, s) noenhanced
      set xlabel field eq "4" ? "elements" : "seconds of the processor"
      set ylabel "relative RMS error of B"
      if (s == 3) { set key top right } else { unset key }
      plot table using (of(word(scenes, s), "adaptive", "uniform", column(int(field)))):8 with linespoints lc rgb "#2060b0" lw 1.5 pt 7 ps 0.5 title "uniform, rung adaptive", \
           table using (of(word(scenes, s), "adaptive", "adaptive", column(int(field)))):8 with linespoints lc rgb "#c03028" lw 1.5 pt 7 ps 0.5 title "adaptive mesh, rung adaptive", \
           table using (of(word(scenes, s), "area", "uniform", column(int(field)))):8 with linespoints lc rgb "#2060b0" dt 3 pt 6 ps 0.5 title "uniform, rung area", \
           table using (of(word(scenes, s), "area", "adaptive", column(int(field)))):8 with linespoints lc rgb "#c03028" dt 3 pt 6 ps 0.5 title "adaptive mesh, rung area"
    }
  }
  unset multiplot
  unset output
}
