# SPDX-License-Identifier: MIT
# The wall's displacement over time, above the force on it.
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 4 columnsfirst margins 0.055, 0.99, 0.09, 0.94 spacing 0.055, 0.03
unset key
set xrange [0:1]
do for [shape in shapes] {
  set title title_of(shape)
  set format x ""
  unset xlabel
  set ylabel (shape eq "polyhedron" ? "wall displacement x  [mm]" : "")
  if (has("wall", shape)) {
    plot file_of("wall", shape) using 1:(mm($3)) skip 1 with lines linecolor rgb color_of(shape)
  } else {
    set multiplot next
  }
  unset title
  set format x "%g"
  set xlabel "t  [s]"
  set ylabel (shape eq "polyhedron" ? "driving force f  [kN]" : "")
  if (has("wall", shape)) {
    plot file_of("wall", shape) using 1:(kN($2)) skip 1 with lines linecolor rgb grey
  } else {
    set multiplot next
  }
}
unset multiplot
