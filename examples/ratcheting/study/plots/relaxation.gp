# SPDX-License-Identifier: MIT
# Does the frequency of the fastest compaction follow sqrt(g/d)? Raw above, scaled below.
width = 1400; height = 1100
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 columnsfirst margins 0.08, 0.98, 0.07, 0.93 spacing 0.09, 0.17
set logscale xy
set format y "10^{%L}"
set key bottom left reverse Left samplen 2
condition(k) = k == 1 ? "baseline" : k == 2 ? "g = 2.5 m/s²" : "sizes × 1.5"
do for [shape in "polyhedron polygon"] {
  if (!has("relaxation", shape)) {
    set multiplot next
    set multiplot next
    continue
  }
  set title title_of(shape) offset 0, 1
  set xlabel "ν  [Hz]"
  set ylabel "compaction rate  [1/s]"
  plot for [k = 1:3] "< sort -t, -g -k1,1 -k2,2 '".file_of("relaxation", shape)."'" using ($1 == k ? $2 : NaN):4 with linespoints pointtype 4 + k linecolor rgb word(blue." ".red." ".green, k) title condition(k)
  set title title_of(shape).", scaled"
  set xlabel "ν √(d/g)"
  set ylabel "compaction rate × √(d/g)"
  plot for [k = 1:3] "< sort -t, -g -k1,1 -k2,2 '".file_of("relaxation", shape)."'" using ($1 == k ? $3 : NaN):5 with linespoints pointtype 4 + k linecolor rgb word(blue." ".red." ".green, k) title condition(k)
}
unset multiplot
