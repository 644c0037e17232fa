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
  set title title_of(shape) font ",15"
  set key above horizontal maxrows 1
  set xrange [*:*]
  set yrange [*:*]
  stats file_of("loop5", shape) using 1 skip 1 nooutput
  set xtics 2 * tics_over(mm(STATS_max - STATS_min))
  set xlabel "x − x_j  [mm]"
  set ylabel (shape eq "polyhedron" ? "v  [mm/s]" : "")
  loops = has("loop10", shape) ? "5 10" : "5"
  plot for [nu in loops] file_of("loop".nu, shape) using (mm($1)):(mm($2)) skip 1 with lines linecolor rgb (nu eq "5" ? blue : red) title nu." Hz"
  distance = number("loop_distance", shape)
  set title (known(distance) ? sprintf("largest distance %.0f %%", 100 * distance) : "") font ",13"
  unset key
  set xtics 2 * tics_over(25 * mm(STATS_max - STATS_min))
  set xlabel "(x − x_j) ν²  [mm/s²]"
  set ylabel (shape eq "polyhedron" ? "v ν  [mm/s²]" : "")
  plot for [nu in loops] file_of("loop".nu, shape) using (mm($3)):(mm($4)) skip 1 with lines linecolor rgb (nu eq "5" ? blue : red)
}
unset multiplot
