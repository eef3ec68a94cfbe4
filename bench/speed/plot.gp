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

rungs = "hemicube analytic area adaptive exact"
rung_colours = "#909090 #70a0d8 #2060b0 #c03028 #000000"
rung_points = "7 5 9 7 3"
# Of a matrix: columns 9 and 7, RMS error of F and time of the form factors. Of a scene: columns 11
# and 8, relative error of B and time of form factors and solver. 3 is the rung, 4 and 5 are what is
# varied on it.
of(scene, k, value) = (strcol(1) eq scene && strcol(3) eq word(rungs, k)) ? value : NaN
# The ends of a line are named: to its left (a column of 1) or to its right (2).
resolution_label(k, side) = side == (k == 2 ? 1 : 2) && (strcol(4) eq "64" || strcol(4) eq "512") ? strcol(4) : ""
target_label(side) = side == 2 && strcol(5) eq "0.3" ? "0.3" : side == 1 && strcol(5) eq "0.001" ? "0.001" : ""
end_label(k, side) = k == 4 ? target_label(side) : resolution_label(k, side)
rung_keys = '"hemicube, resolution" "analytic, resolution" "area, resolution" "adaptive, error target" "exact"'

programs = '"View3D" "Chaparral pairwise" "Chaparral hemicube" "Chaparral hemicube subdivided"'
program_keys = '"View3D, eps" "Chaparral pairwise" "Chaparral hemicube" "Chaparral, subdivided"'
program_colours = "#409040 #b07010 #a060c0 #a060c0"
program_points = "8 4 10 12"
by(scene, k, value) = (strcol(1) eq scene && strcol(2) eq word(programs, k)) ? value : NaN

scenes = '"cornell" "tableroom_a" "tworooms_a" "corridor_a" "corner2_90_a" "corner2_10_a" "cube_mixed" "room_bleed"'

do for [type in "svg png"] {
  # Matrices.
  do for [scene in "cube8 boxin"] {
    if (type eq "svg") {
      set terminal svg size 960,560 font "sans-serif,13" background "white"
    } else {
      set terminal pngcairo size 960,560 font "sans,10"
    }
    set output target . "/speed_error_" . scene . "." . type
    set rmargin 30
    set xtics autofreq
    set key outside right top Left reverse samplen 2 spacing 1.2
    if (scene eq "cube8") {
      set title "Inside of a cube, 8 x 8 patches a face, nothing blocks (cube8, N = 384)"
      set xrange [2e-11:3e-3]
    } else {
      set title "The same cube with a box of 4 x 4 patches a face in it (boxin, N = 480)"
      set xrange [1e-8:3e-3]
    }
    set xlabel "RMS error of the form factors over all pairs"
    set ylabel "seconds, one thread"
    set yrange [*:*]
    plot for [k = 1:5] table using (of(scene, k, $9)):(of(scene, k, $7)) \
           with linespoints lc rgb word(rung_colours, k) lw 2 pt int(word(rung_points, k)) ps 0.8 title word(rung_keys, k), \
         for [k = 1:4] table using (of(scene, k, $9)):(of(scene, k, $7)):(end_label(k, 1)) \
           with labels right offset -0.8,0 tc rgb word(rung_colours, k) notitle, \
         for [k = 1:4] table using (of(scene, k, $9)):(of(scene, k, $7)):(end_label(k, 2)) \
           with labels left offset 0.8,0 tc rgb word(rung_colours, k) notitle, \
         for [k = 1:4] published using (by(scene, k, $5)):(by(scene, k, $4)) \
           with points lc rgb word(program_colours, k) lw 2 pt int(word(program_points, k)) ps 1.1 \
           title word(program_keys, k), \
         published using (by(scene, 1, $5)):(by(scene, 1, $4)):(strcol(3)) \
           with labels center offset 0,-0.9 tc rgb word(program_colours, 1) notitle, \
         published using (by(scene, 2, $5)):(by(scene, 2, $4)):(strcol(3)) \
           with labels left offset 1,0.2 tc rgb word(program_colours, 2) notitle, \
         for [k = 3:4] published using (by(scene, k, $5)):(by(scene, k, $4)):(strcol(3)) \
           with labels right offset -1,0 tc rgb word(program_colours, k) notitle
    unset output
  }

  # Scenes.
  if (type eq "svg") {
    set terminal svg size 1200,640 font "sans-serif,11" background "white"
  } else {
    set terminal pngcairo size 1200,640 font "sans,8"
  }
  set output target . "/speed_error_scenes." . type
  set rmargin 2
  set multiplot layout 2,4 title "Radiosity: form factors and solver, one thread, against the solution with exact form factors on the same mesh"
  do for [scene in scenes] {
    set title scene noenhanced
    closed_form = scene eq "corner2_90_a" || scene eq "cube_mixed" || scene eq "room_bleed"
    set xtics closed_form ? 100 : 10
    if (closed_form) { set xrange [2e-11:1e-1] } else { set xrange [2e-4:2e-2] }
    if (scene eq "corner2_10_a") { set xrange [2e-4:1e-1] }
    set yrange [1e-3:10]
    set xlabel "relative error of B"
    set ylabel "seconds"
    if (scene eq "room_bleed") { set key inside right top Left reverse samplen 1.5 } else { unset key }
    plot for [k = 1:5] table using (of(scene, k, $11)):(of(scene, k, $8)) \
           with linespoints lc rgb word(rung_colours, k) lw 1.5 pt int(word(rung_points, k)) ps 0.6 title word(rungs, k), \
         for [k = 1:4] table using (of(scene, k, $11)):(of(scene, k, $8)):(end_label(k, 1)) \
           with labels right offset -0.6,0 tc rgb word(rung_colours, k) notitle, \
         for [k = 1:4] table using (of(scene, k, $11)):(of(scene, k, $8)):(end_label(k, 2)) \
           with labels left offset 0.6,0 tc rgb word(rung_colours, k) notitle
  }
  unset multiplot
  unset output
}
