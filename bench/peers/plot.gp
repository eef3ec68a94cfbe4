# Two pictures of peers.csv. Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" plot.gp
# With -e "type='png'" as PNG.
if (!exists("folder")) folder = "."
if (!exists("type")) type = "svg"
if (!exists("target")) target = folder
table = folder . "/peers.csv"

set datafile separator ","
set datafile missing NaN
set key outside right top Left reverse samplen 3
set grid lc rgb "#dddddd"
set logscale xy
set format y "%.0s%c"
set ylabel "hemicubes per second, one thread"

colours = "#c03028 #2060b0 #70a0d8 #409040 #909090"
program_count = 5
program(k) = k == 1 ? "hemicube" : k == 2 ? "embree" : k == 3 ? "embree robust" : k == 4 ? "llvmpipe" : "floor"
is_office(name) = name[1:6] eq "office"
# Rates at a resolution of one program, in offices or elsewhere; NaN for other lines.
at_resolution(r, k, office) = (strcol(3) eq r && strcol(4) eq program(k) && is_office(strcol(1)) == office) ? $6 : NaN
in_scene(name, k) = (strcol(1) eq name && strcol(4) eq program(k)) ? $6 : NaN

if (type eq "png") set terminal pngcairo size 900,480; else set terminal svg size 900,480 font "sans-serif,13" background "white"

set output target . "/peers_patches." . type
set title "Resolution 256: solid, rooms where much is visible; dashed, offices"
set xlabel "patches"
set format x "10^{%T}"
plot for [k = 1:program_count] table using 2:(at_resolution("256", k, 0)) smooth unique \
       with linespoints lc rgb word(colours, k) lw 2 pt 7 ps 0.6 title program(k), \
     for [k = 1:program_count] table using 2:(at_resolution("256", k, 1)) smooth unique \
       with linespoints lc rgb word(colours, k) lw 2 dt 2 pt 6 ps 0.6 notitle

set output target . "/peers_resolution." . type
set title "Solid, cornell10k; dashed, office100k"
set xlabel "resolution"
set format x "%.0f"
set xtics (64, 256, 1024)
set xrange [50:1300]
plot for [k = 1:program_count] table using 3:(in_scene("cornell10k", k)) smooth unique \
       with linespoints lc rgb word(colours, k) lw 2 pt 7 ps 0.6 title program(k), \
     for [k = 1:program_count] table using 3:(in_scene("office100k", k)) smooth unique \
       with linespoints lc rgb word(colours, k) lw 2 dt 2 pt 6 ps 0.6 notitle
