# Pictures of convergence.csv and progressive.csv, as SVG and PNG beside them.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/solvers/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
set datafile separator ","
set datafile missing NaN
set grid lc rgb "#dddddd"
set logscale y
set format y "10^{%T}"
solvers = "gauss-seidel jacobi progressive"
colours = "#c03028 #2060b0 #409040"
scenes = 'cornell corridor white_room'
of(scene, name, x) = (strcol(1) eq scene && strcol(3) eq name) ? x : NaN
do for [type in "svg png"] {
  if (type eq "svg") { set terminal svg size 1200,640 font "sans-serif,12" background "white" } else { set terminal pngcairo size 1200,640 font "sans,9" }
  set output folder . "/convergence." . type
  set multiplot layout 2,3 title "Stored matrix, one thread: error of B against the solution at 1e-13"
  do for [field in "4 5"] {
    do for [s = 1:3] {
      set title word(scenes, s) noenhanced
      set xlabel field eq "4" ? "sweeps, or shots per patch" : "seconds, set-up included"
      set ylabel "relative RMS error of B"
      if (s == 1) { set key bottom left } else { unset key }
      plot for [k = 1:3] folder . "/convergence.csv" using (of(word(scenes, s), word(solvers, k), column(int(field)))):($7 > 0 ? $7 : NaN) with linespoints lc rgb word(colours, k) lw 1.5 pt 7 ps 0.5 title word(solvers, k), \
           for [k = 1:2] folder . "/convergence.csv" using (of(word(scenes, s), word(solvers, k), column(int(field)))):($6 > 0 ? $6 : NaN) with lines dt 3 lc rgb word(colours, k) title word(solvers, k) . ", residual"
    }
  }
  unset multiplot
  unset output
  if (type eq "svg") { set terminal svg size 1200,360 font "sans-serif,12" background "white" } else { set terminal pngcairo size 1200,360 font "sans,9" }
  set output folder . "/progressive." . type
  set logscale x
  set multiplot layout 1,3 title "From the mesh to light, rows included, one thread"
  do for [s = 1:3] {
    set title word(scenes, s) noenhanced
    set xlabel "seconds"
    set ylabel "relative RMS error of B"
    if (s == 1) { set key bottom left } else { unset key }
    plot folder . "/progressive.csv" using (of(word(scenes, s), "gauss-seidel", $5)):6 with linespoints lc rgb "#c03028" lw 1.5 pt 7 ps 0.5 title "all rows, then Gauss-Seidel", \
         folder . "/progressive.csv" using (of(word(scenes, s), "progressive", $5)):6 with linespoints lc rgb "#409040" lw 1.5 pt 7 ps 0.5 title "progressive, no matrix"
  }
  unset multiplot
  unset output
  unset logscale x
}
