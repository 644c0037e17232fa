# SPDX-License-Identifier: MIT
# Mean loops in the phase plane at two frequencies, raw above and scaled below.
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 4 columnsfirst margins 0.06, 0.99, 0.09, 0.9 spacing 0.06, 0.18
set xzeroaxis linetype 1 linecolor rgb grey
do for [shape in shapes] {
  if (!has("loop5", shape)) {
    set multiplot next
    set multiplot next
    continue
  }
  set title title_of(shape)
  set key above horizontal maxrows 1
  set xrange [*:*]
  set yrange [*:*]
  stats file_of("loop5", shape) using 1 skip 1 nooutput
  set xtics tics_over(mm(STATS_max - STATS_min))
  set xlabel "x − x_j  [mm]"
  set ylabel (shape eq "polyhedron" ? "v  [mm/s]" : "")
  plot file_of("loop5", shape) using (mm($1)):(mm($2)) skip 1 with lines linecolor rgb blue title "5 Hz", \
       file_of("loop10", shape) using (mm($1)):(mm($2)) skip 1 with lines linecolor rgb red title "10 Hz"
  distance = number("loop_distance", shape)
  set title (known(distance) ? sprintf("largest distance %.0f %%", 100 * distance) : "") font ",13"
  unset key
  set xtics tics_over(25 * mm(STATS_max - STATS_min))
  set xlabel "(x − x_j) ν²  [mm/s²]"
  set ylabel (shape eq "polyhedron" ? "v ν  [mm/s²]" : "")
  plot file_of("loop5", shape) using (mm($3)):(mm($4)) skip 1 with lines linecolor rgb blue, \
       file_of("loop10", shape) using (mm($3)):(mm($4)) skip 1 with lines linecolor rgb red
}
unset multiplot
