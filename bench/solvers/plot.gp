# Picture of convergence.csv, as SVG and PNG beside it.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/solvers/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
set datafile separator ","
set datafile missing NaN
set grid lc rgb "#dddddd"
set logscale y
set format y "10^{%T}"
solvers = "gauss-seidel jacobi progressive"
colours = "#c03028 #2060b0 #409040"
of(k, rho, x) = (strcol(1) eq word(solvers, k) && $2 == rho && $6 > 0) ? x : NaN
do for [type in "svg png"] {
  if (type eq "svg") { set terminal svg size 1200,640 font "sans-serif,12" background "white" } else { set terminal pngcairo size 1200,640 font "sans,9" }
  set output folder . "/convergence." . type
  set multiplot layout 2,3 title "Cornell box, 2,400 patches, one thread: error of B against the solution at 1e-13"
  do for [field in "3 4"] {
    do for [rho in "0.5 0.8 0.99"] {
      set title "rho = " . rho
      set xlabel field eq "3" ? "sweeps, or shots per patch" : "seconds, set-up included"
      set ylabel "largest error over largest B"
      if (rho eq "0.5") { set key top right } else { unset key }
      plot for [k = 1:3] folder . "/convergence.csv" using (of(k, rho + 0, column(int(field)))):6 with linespoints lc rgb word(colours, k) lw 1.5 pt 7 ps 0.5 title word(solvers, k)
    }
  }
  unset multiplot
  unset output
}
