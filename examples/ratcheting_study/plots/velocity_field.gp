# SPDX-License-Identifier: MIT
# Mean velocities in the section at the wall's largest inward speed; the wall is on the right.
width = 1600; height = 520
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 1, 4 margins 0.055, 0.99, 0.14, 0.86 spacing 0.05, 0
unset key
set size ratio -1
set xlabel "x  [m]"
do for [shape in shapes] {
  if (!has("velocity_field", shape)) {
    set multiplot next
    continue
  }
  stats file_of("velocity_field", shape) using (sqrt($3**2 + $4**2)) skip 1 nooutput
  fastest = STATS_max
  l = value("length", shape); h = value("height", shape)
  scale = 0.16 * l / fastest
  set xrange [0:l]
  set yrange [0:h]
  set xtics l > 0.5 ? 0.2 : 0.1
  set ytics l > 0.5 ? 0.2 : 0.1
  set ylabel (shape eq "polyhedron" ? "z  [m]" : "")
  roll = value("roll", shape)
  set title sprintf("%s\nfastest %.0f mm/s; roll %+.3f rad/s (%s), strength %+.2f", title_of(shape), mm(fastest), roll, roll < 0 ? "clockwise" : "counter-clockwise", value("roll_strength", shape)) font ",12"
  plot file_of("velocity_field", shape) using ($1 - scale * $3 / 2):($2 - scale * $4 / 2):(scale * $3):(scale * $4) skip 1 with vectors head filled size graph 0.018, 22 linecolor rgb color_of(shape)
}
unset multiplot
