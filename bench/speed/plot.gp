# Pictures of speed_error.csv, as SVG and PNG beside it.
# Usage: gnuplot -e "folder='bench/results/<cpu>_<isa>'" bench/speed/plot.gp, from the checkout.
if (!exists("folder")) folder = "."
if (!exists("target")) target = folder
table = folder . "/speed_error.csv"
published = "bench/speed/published.csv"

set datafile separator ","
set datafile missing NaN
set grid lc rgb "#dddddd"
set border lc rgb "#808080"
set tics textcolor rgb "black"
set logscale xy
set format "10^{%T}"
set lmargin 9
set rmargin 2

rungs = "hemicube analytic area adaptive exact"
rung_colours = "#909090 #70a0d8 #2060b0 #c03028 #000000"
rung_points = "7 5 9 7 3"
# Of a matrix: columns 9 and 7, RMS error of F and time of the form factors. Of a scene: columns 11
# and 8, relative error of B and time of form factors and solver. 3 is the rung, 4 and 5 are what is
# varied on it.
of(scene, k, value) = (strcol(1) eq scene && strcol(3) eq word(rungs, k)) ? value : NaN
# The first and the last point of a line are named.
is_end(s) = s eq "64" || s eq "512" || s eq "0.3" || s eq "0.001"
setting(n) = strcol(4) . strcol(5)
end_label(n) = is_end(setting(n)) ? setting(n) : ""

programs = '"View3D" "Chaparral pairwise" "Chaparral hemicube" "Chaparral hemicube subdivided"'
program_keys = '"View3D, eps" "Chaparral pairwise, rays" "Chaparral hemicube, R" "the same, subdivided and smoothed"'
program_colours = "#409040 #b07010 #a060c0 #a060c0"
program_points = "8 4 10 12"
by(scene, k, value) = (strcol(1) eq scene && strcol(2) eq word(programs, k)) ? value : NaN

titles = '"cornell" "tableroom_a" "tworooms_a" "corridor_a" "corner2_90_a" "corner2_10_a" "cube_mixed" "room_bleed"'

do for [type in "svg png"] {
  # Matrices.
  do for [scene in "cube8 boxin"] {
    if (type eq "svg") {
      set terminal svg size 960,560 font "sans-serif,13" background "white"
    } else {
      set terminal pngcairo size 960,560 font "sans,10"
    }
    set output target . "/speed_error_" . scene . "." . type
    set key outside right top Left reverse samplen 2 spacing 1.2 width -2
    if (scene eq "cube8") {
      set title "Inside of a cube, 8 x 8 patches a face, nothing blocks (cube8, N = 384)"
      set xrange [5e-11:3e-3]
    } else {
      set title "The same cube with a box of 4 x 4 patches a face in it (boxin, N = 480)"
      set xrange [1e-8:3e-3]
    }
    set xlabel "RMS error of the form factors over all pairs"
    set ylabel "seconds, one thread"
    set yrange [*:*]
    plot for [k = 1:5] table using (of(scene, k, $9)):(of(scene, k, $7)) \
           with linespoints lc rgb word(rung_colours, k) lw 2 pt int(word(rung_points, k)) ps 0.8 title word(rungs, k), \
         for [k = 1:4] table using (of(scene, k, $9)):(of(scene, k, $7)):(end_label(0)) \
           with labels offset 0,0.8 tc rgb word(rung_colours, k) notitle, \
         for [k = 1:4] published using (by(scene, k, $5)):(by(scene, k, $4)) \
           with points lc rgb word(program_colours, k) lw 2 pt int(word(program_points, k)) ps 1.1 \
           title word(program_keys, k), \
         for [k = 1:4] published using (by(scene, k, $5)):(by(scene, k, $4)):(strcol(3)) \
           with labels offset 0,-0.9 tc rgb word(program_colours, k) notitle
    unset output
  }

  # Scenes.
  if (type eq "svg") {
    set terminal svg size 1200,640 font "sans-serif,11" background "white"
  } else {
    set terminal pngcairo size 1200,640 font "sans,8"
  }
  set output target . "/speed_error_scenes." . type
  set multiplot layout 2,4 title "Radiosity: form factors and solver, one thread, against the solution with exact form factors on the same mesh"
  do for [scene in titles] {
    set title scene
    set xlabel "relative error of B"
    set ylabel "seconds"
    set autoscale xy
    if (scene eq "cornell") { set key inside right top Left reverse samplen 1.5 } else { unset key }
    plot for [k = 1:5] table using (of(scene, k, $11)):(of(scene, k, $8)) \
           with linespoints lc rgb word(rung_colours, k) lw 1.5 pt int(word(rung_points, k)) ps 0.6 title word(rungs, k), \
         for [k = 1:4] table using (of(scene, k, $11)):(of(scene, k, $8)):(end_label(0)) \
           with labels offset 0,0.7 tc rgb word(rung_colours, k) notitle
  }
  unset multiplot
  unset output
}
