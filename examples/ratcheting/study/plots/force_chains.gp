# SPDX-License-Identifier: MIT
# Normal forces as lines between centres, as wide as the force against the mean of its picture; the
# middle quarter of the box in 3D. The driven wall is on the right.
width = 1600; height = 950
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 4 columnsfirst margins 0.01, 0.99, 0.035, 0.92 spacing 0.01, 0.08
set label 9 "widths are relative to the mean force of each panel: the stresses above tell how much more the jammed grains bear; the driven wall is on the right" at screen 0.5, 0.015 center textcolor rgb grey font ",12"
unset key
unset tics
unset grid
set size ratio -1
do for [shape in shapes] {
  do for [state in "jammed active"] {
    name = "chains_".state
    if (!has(name, shape)) {
      set multiplot next
      continue
    }
    set xrange [*:*]  # stats leaves out what lies beyond
    set yrange [*:*]
    stats file_of(name, shape) using 5 skip 1 nooutput
    unit = STATS_mean
    l = number("length", shape); h = number("height", shape)
    set xrange [-0.01 * l:1.01 * l]
    set yrange [-0.01 * h:1.01 * h]
    set title sprintf("%s, %s\nσ_{xx} = %.3g kPa, σ_{zz} = %.3g kPa", title_of(shape), state, 1e-3 * number(state."_xx", shape), 1e-3 * number(state."_zz", shape)) font ",13"
    plot for [k = 1:9] file_of(name, shape) using ($5 > 0.5 * k * unit && ($5 <= 0.5 * (k + 1) * unit || k == 9) ? $1 : NaN):2:($3 - $1):($4 - $2) skip 1 with vectors nohead linewidth 0.6 * k linecolor rgb color_of(shape)
  }
}
unset multiplot
