# SPDX-License-Identifier: MIT
# Largest displacement over the largest force, 5 Hz; +: from where the falling force
# is the weight, without the creep of the blocked wall. The paper's lines: grains with corners.
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale xy
set xlabel "f_{max}  [kN]"
set ylabel "Δx_{max}  [mm]"
set key bottom left font ",12" Left reverse spacing 1.4
commands = ""
do for [shape in shapes] {
  if (has("fmax", shape)) {
    p = number("active_fmax_prefactor", shape); e = number("active_fmax_exponent", shape); all = number("dx_fmax_exponent", shape)
    name = title_of(shape).(known(all) ? sprintf(": f_{max}^{%.2f}, + f_{max}^{%.2f}", all, e) : "")
    file = file_of("fmax", shape)
    commands = commands.points_of(file, "1e-3 * $1", 2, 1e3, point_of(shape), color_of(shape), name).bars_of(file, "1e-3 * $1", 2, 3, 1e3, color_of(shape)).points_of(file, "1e-3 * $1", 11, 1e3, 1, color_of(shape), "")
    if (known(e)) { commands = commands.law_of(1e3 * p, e, "1e3 * x", color_of(shape)) }
  }
}
set xtics (0.25, 0.5, 1, 2, 3, 4, 5, 6, 8, 10)
eval "plot ".commands.papers_of("6 / x")." NaN notitle"
