# SPDX-License-Identifier: MIT
# gnuplot plane_and_space.gp, in the folder of plane_and_space.csv
set datafile separator ","
set terminal pngcairo size 760,560 font "sans,13"
set output "plane_and_space.png"
set title "Collapse of a column: 400 grains in the plane, 800 in space,\n3 samples each, friction 0.4, tolerance 1e-4"
set xlabel "aspect ratio a = H / L_0"
set ylabel "run-out (L - L_0) / L_0"
set logscale xy
set xrange [0.4:5]
set xtics (0.5, 1, 2, 4)
set key left top
set grid
# Four blocks of four lines: polygons, disks, polyhedra, balls.
block(k) = sprintf("< tail -n +%d plane_and_space.csv | head -n 4", 2 + 4 * k)
plot block(0) using 2:3:4 with yerrorlines pt 5 lc rgb "#0B6E99" title "polygons", \
     block(1) using 2:3:4 with yerrorlines pt 4 lc rgb "#4FB3D9" title "disks", \
     block(2) using 2:3:4 with yerrorlines pt 7 lc rgb "#B5482A" title "polyhedra", \
     block(3) using 2:3:4 with yerrorlines pt 6 lc rgb "#E8935B" title "balls"
