# Pictures of growth.csv, as SVG and PNG beside it.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/growth/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
table = folder . "/growth.csv"

set datafile separator ","
set datafile commentschars "#"
set grid lc rgb "#dddddd"
set border lc rgb "#808080"
set logscale xy
set xlabel "patches"
set key left top
set xrange [8000:450000]

do for [type in "svg png"] {
  if (type eq "svg") { set terminal svg size 900,400 font "sans,12" background "white" }
  else { set terminal pngcairo size 900,400 font "sans,10" background "white" }
  set output folder . "/growth." . type
  set multiplot layout 1,2
  set ylabel "seconds, start to end, 2 threads"
  plot table using 1:3 with linespoints pt 7 lc rgb "#2060b0" title "whole run", \
       table using 1:4 with linespoints pt 5 lc rgb "#70a0d8" title "form factors", \
       table using 1:5 with linespoints pt 9 lc rgb "#c03028" title "solver and certificate", \
       table using 1:8 with points pt 6 lc rgb "#000000" title "predicted"
  set ylabel "peak memory, MB"
  plot table using 1:7 with linespoints pt 7 lc rgb "#2060b0" title "whole run", \
       table using 1:($1*$2*8/1e6) with lines dt 2 lc rgb "#909090" title "8 bytes a form factor", \
       table using 1:9 with points pt 6 lc rgb "#000000" title "predicted"
  unset multiplot
  unset output
}
