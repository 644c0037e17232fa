# SPDX-License-Identifier: MIT
# The third period, or the last, between two maxima of the force: a, where the wall starts, b, its largest
# displacement, c, where it jams again.
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 4 columnsfirst margins 0.065, 0.99, 0.09, 0.94 spacing 0.055, 0.03
field(shape, n) = real(system(sprintf("awk -F, '$1 <= 3 {last = $%d} END {print last}' '%s'", n, file_of("events", shape))))
do for [shape in shapes] {
  if (!has("events", shape)) {
    set multiplot next
    set multiplot next
    continue
  }
  start = field(shape, 2); x_before = field(shape, 3); t_a = field(shape, 4); t_min = field(shape, 5)
  t_b = field(shape, 6); x_b = field(shape, 7); finish = field(shape, 8); x_after = field(shape, 9)
  set xrange [start:finish]
  set xtics 0.05
  set title title_of(shape)
  unset key
  set format x ""
  unset xlabel
  set ylabel (shape eq "polyhedron" ? "x  [mm]" : "")
  set offsets 0, 0, graph 0.2, graph 0.16
  set arrow 1 from start, mm(x_before) to finish, mm(x_before) nohead dashtype 2 linecolor rgb grey
  set arrow 2 from t_b, mm(x_before) to t_b, mm(x_b) heads size graph 0.01, 20 linecolor rgb green
  set label 1 sprintf("x_j = %.2f mm", mm(x_before)) at start, mm(x_before) offset 0.3, -0.8 textcolor rgb grey font ",13"
  set label 2 sprintf("b: Δx_{max} = %.2f mm", mm(x_b - x_before)) at t_b, mm(x_b) center offset 0, 0.7 textcolor rgb green
  set label 3 sprintf("c: x_j' = %.2f mm", mm(x_after)) at finish, mm(x_after) right offset -0.5, -0.8 textcolor rgb grey
  set label 4 "a" at t_a, mm(x_before) right offset -0.3, 1.2 textcolor rgb green
  plot file_of("wall", shape) using 1:(mm($3)) skip 1 with lines linecolor rgb color_of(shape) linewidth 1.6
  unset title
  unset label
  unset arrow
  set offsets 0, 0, graph 0.04, 0
  set format x "%g"
  set xlabel "t  [s]"
  set ylabel (shape eq "polyhedron" ? "force  [kN]" : "")
  if (shape eq "polyhedron") { set key top center } else { unset key }
  set arrow 4 from t_min, graph 0 to t_min, graph 1 nohead dashtype 3 linecolor rgb orange
  set arrow 5 from t_b, graph 0 to t_b, graph 1 nohead dashtype 3 linecolor rgb orange
  set label 5 sprintf("δt_r = %.1f ms", mm(t_b - t_min)) at t_b, graph 0.66 center textcolor rgb orange
  plot file_of("wall", shape) using 1:(kN($2)) skip 1 with lines linecolor rgb grey linewidth 1.6 title "f", \
       file_of("wall", shape) using 1:(kN($5)) skip 1 with lines linecolor rgb color_of(shape) linewidth 0.8 title "f_g"
  unset label
  unset arrow
}
unset multiplot
