# SPDX-License-Identifier: MIT
# Largest displacement over gravity, 5 Hz; +: from where the falling force
# is the weight, without the creep of the blocked wall. The paper's lines: grains with corners.
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale xy
set xlabel "g  [m/s²]"
set ylabel "Δx_{max}  [mm]"
set key top left font ",12" Left reverse spacing 1.4
commands = ""
do for [shape in shapes] {
  if (has("gravity", shape)) {
    p = number("active_gravity_prefactor", shape); e = number("active_gravity_exponent", shape); all = number("dx_gravity_exponent", shape)
    name = title_of(shape).(known(all) ? sprintf(": g^{%.2f}, + g^{%.2f}", all, e) : "")
    file = file_of("gravity", shape)
    commands = commands.points_of(file, "$1", 2, 1e3, point_of(shape), color_of(shape), name).bars_of(file, "$1", 2, 3, 1e3, color_of(shape)).points_of(file, "$1", 11, 1e3, 1, color_of(shape), "")
    if (known(e)) { commands = commands.law_of(1e3 * p, e, "x", color_of(shape)) }
  }
}
set xrange [2:25]
set xtics (2.5, 5, 9.81, 20)
eval "plot ".commands.papers_of("(x / 9.81)**2")." NaN notitle"
