# SPDX-License-Identifier: MIT
# gnuplot biaxial.gp, in the folder of biaxial.csv.
set datafile separator ","
set terminal pngcairo size 1500,760 font "sans,12"
set output "biaxial.png"
# The mean of a column over the samples of a shape and a preparation, for every row.
of(dim, round, dense, column) = sprintf("< awk -F, '$1 == %d && $2 == %d && $3 == %d {k = int($5 * 200 + 0.5); s[k] += $%d; ++n[k]} END {for (k = 1; k <= 200; ++k) if (n[k]) print k / 200 \",\" s[k] / n[k]; if (!length(n)) print \"nan,nan\"}' biaxial.csv", dim, round, dense, column)
angular = "#B5482A"
round = "#0B6E99"
set key top right samplen 2 opaque
set grid
set xrange [0:*]
set multiplot layout 2,4 title "Compression at constant lateral pressure, I = 0.001, friction 0.5, tolerance 1e-4, mean of the samples. Solid: compressed without friction (dense); dashed: with friction 0.5 (loose)"
do for [dim = 2:3] {
  name_angular = dim == 2 ? "polygons" : "polyhedra"
  name_round = dim == 2 ? "disks" : "balls"
  set xlabel "axial strain"
  set title (dim == 2 ? "plane: " : "space: ")."q/p"
  set yrange [0:(dim == 2 ? 1 : 2.5)]
  plot of(dim, 0, 1, 15) with lines lw 2 lc rgb angular title name_angular, \
       of(dim, 0, 0, 15) with lines lw 2 dt 2 lc rgb angular notitle, \
       of(dim, 0, 1, 16) with points pt 6 ps 0.6 lc rgb angular title "inside", \
       of(dim, 1, 1, 15) with lines lw 2 lc rgb round title name_round, \
       of(dim, 1, 0, 15) with lines lw 2 dt 2 lc rgb round notitle, \
       of(dim, 1, 1, 16) with points pt 6 ps 0.6 lc rgb round title "inside"
  set yrange [*:*]
  unset key
  set title "volume strain"
  plot of(dim, 0, 1, 6) with lines lw 2 lc rgb angular, \
       of(dim, 0, 0, 6) with lines lw 2 dt 2 lc rgb angular, \
       of(dim, 1, 1, 6) with lines lw 2 lc rgb round, \
       of(dim, 1, 0, 6) with lines lw 2 dt 2 lc rgb round
  set title "neighbours of a grain"
  plot of(dim, 0, 1, 17) with lines lw 2 lc rgb angular, \
       of(dim, 0, 0, 17) with lines lw 2 dt 2 lc rgb angular, \
       of(dim, 1, 1, 17) with lines lw 2 lc rgb round, \
       of(dim, 1, 0, 17) with lines lw 2 dt 2 lc rgb round
  set title "anisotropy of the contact normals"
  set yrange [0:*]
  plot of(dim, 0, 1, 18) with lines lw 2 lc rgb angular, \
       of(dim, 0, 0, 18) with lines lw 2 dt 2 lc rgb angular, \
       of(dim, 1, 1, 18) with lines lw 2 lc rgb round, \
       of(dim, 1, 0, 18) with lines lw 2 dt 2 lc rgb round
  set key top right samplen 2 opaque
}
unset multiplot
