# SPDX-License-Identifier: MIT
# Mean velocities in the section at the wall's largest inward speed; the wall is on the right.
width = 1600; height = 520
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 1, 4 margins 0.06, 0.99, 0.14, 0.80 spacing 0.05, 0
set label 9 "wall on the right; the paper: one clockwise roll, its wall's side not said" at screen 0.5, 0.975 center textcolor rgb grey font ",12"
unset key
set size ratio -1
set xlabel "x  [m]"
do for [shape in shapes] {
  if (!has("velocity_field", shape)) {
    set multiplot next
    continue
  }
  set xrange [*:*]  # stats leaves out what lies beyond
  set yrange [*:*]
  stats file_of("velocity_field", shape) using (sqrt($3**2 + $4**2)) skip 1 nooutput
  fastest = STATS_max
  l = number("length", shape); h = number("height", shape)
  scale = 0.13 * l / fastest
  set xrange [-0.02 * l:1.02 * l]
  set yrange [-0.02 * h:1.08 * h]
  distance = l > 0.5 ? 0.2 : 0.1
  set xtics distance
  set ytics distance
  set ylabel (shape eq "polyhedron" ? "z  [m]" : "")
  roll = number("roll", shape)
  set title sprintf("%s, longest arrow %.0f mm/s\nroll %+.3f rad/s, strength %+.2f\n%s", title_of(shape), mm(fastest), roll, number("roll_strength", shape), roll < 0 ? "clockwise" : "counter-clockwise") font ",13"
  plot file_of("velocity_field", shape) using ($1 - scale * $3 / 2):($2 - scale * $4 / 2):(scale * $3):(scale * $4) skip 1 with vectors head filled size graph 0.018, 22 linecolor rgb color_of(shape)
}
unset multiplot
