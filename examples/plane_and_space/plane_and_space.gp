# SPDX-License-Identifier: MIT
# gnuplot plane_and_space.gp, in the folder of plane_and_space.csv. Columns: dimension, grains,
# aspect, run-out, standard error, samples, duration, length, 1 for disks and balls.
set datafile separator ","
set terminal pngcairo size 900,560 font "sans,13"
set output "plane_and_space.png"
# Four blocks of four lines: polygons, disks, polyhedra, balls.
block(k) = sprintf("< tail -n +%d plane_and_space.csv | head -n 4", 2 + 4 * k)
stats block(0) using 2:6 nooutput prefix "plane"
stats block(2) using 2:6 nooutput prefix "space"
set title sprintf("Collapse of a column: N = %d grains in the plane, %d in space,\n%d samples each (bars: standard error), friction 0.4, tolerance 1e-4", plane_max_x, space_max_x, plane_max_y)
set xlabel "aspect ratio a = H / L_0"
set ylabel "run-out (L - L_0) / L_0"
set logscale xy
set xrange [0.4:5]
set yrange [0.2:30]
set xtics (0.5, 1, 2, 4)
set ytics (0.2, 0.5, 1, 2, 5, 10, 20)
set key outside right center Left reverse spacing 1.5 samplen 2
set grid
plot block(3) using 3:4:5 with yerrorlines pt 6 lc rgb "#E8935B" title "balls, after 1.5 s", \
     block(1) using 3:4:5 with yerrorlines pt 4 lc rgb "#4FB3D9" title "disks, after 1.5 s", \
     block(0) using 3:4:5 with yerrorlines pt 5 lc rgb "#0B6E99" title "polygons, at rest", \
     block(2) using 3:4:5 with yerrorlines pt 7 lc rgb "#B5482A" title "polyhedra, at rest"
