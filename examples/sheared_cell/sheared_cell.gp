# SPDX-License-Identifier: MIT
# gnuplot sheared_cell.gp, in the folder of the tables.
set terminal pngcairo size 1300,900 font "sans,12"
set output "sheared_cell.png"
shapes = "disks polygons spheres polyhedra"
colours = "#0B6E99 #B5482A #0B6E99 #B5482A"
set grid
set multiplot layout 2,3
do for [dim = 2:3] {
  first = dim == 2 ? 1 : 3
  space = dim == 2 ? "plane: " : "space: "
  set key top left opaque samplen 2
  set title space."friction in steady flow"
  set xlabel "I"
  set logscale x
  set xrange [0.002:0.5]
  set yrange [0:1]
  if (dim == 2) {
    plot for [k = first:first + 1] word(shapes, k)."_flow.txt" using 1:2 with points pt 7 ps 1.2 lc rgb word(colours, k) title word(shapes, k), \
         0.25 + 1.1 * x with lines lw 2 dt 2 lc rgb "#444444" title "disks, da Cruz et al. 2005"
  } else {
    plot for [k = first:first + 1] word(shapes, k)."_flow.txt" using 1:2 with points pt 7 ps 1.2 lc rgb word(colours, k) title word(shapes, k), \
         0.38 + 0.26 / (0.279 / x + 1) with lines lw 2 dt 2 lc rgb "#444444" title "glass beads, Jop et al. 2006"
  }
  set title space."solid fraction in steady flow"
  set key bottom left
  set yrange [dim == 2 ? 0.65 : 0.45:dim == 2 ? 0.85 : 0.65]
  if (dim == 2) {
    plot for [k = first:first + 1] word(shapes, k)."_flow.txt" using 1:3 with points pt 7 ps 1.2 lc rgb word(colours, k) title word(shapes, k), \
         0.81 - 0.3 * x with lines lw 2 dt 2 lc rgb "#444444" title "disks, da Cruz et al. 2005"
  } else {
    plot for [k = first:first + 1] word(shapes, k)."_flow.txt" using 1:3 with points pt 7 ps 1.2 lc rgb word(colours, k) title word(shapes, k)
  }
  unset logscale x
  set title space."dense (solid), loose (dashed), I = 0.01"
  set xlabel "shear strain"
  set key bottom right
  set xrange [0:2]
  set ylabel "solid fraction"
  set yrange [*:*]
  plot for [k = first:first + 1] word(shapes, k)."_start.txt" using 1:3 every ::0::39 with lines lw 2 lc rgb word(colours, k) title word(shapes, k), \
       for [k = first:first + 1] word(shapes, k)."_start.txt" using 1:3 every ::40::79 with lines lw 2 dt 2 lc rgb word(colours, k) notitle
  unset ylabel
}
unset multiplot
