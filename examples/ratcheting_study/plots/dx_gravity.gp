# SPDX-License-Identifier: MIT
# Largest displacement over gravity, 5 Hz.
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale xy
set xrange [2:25]
set xtics (2.5, 5, 9.81, 20)
set mytics 10
set xlabel "g  [m/s²]"
set ylabel "Δx_{max}  [mm]"
set key top left
commands = ""
do for [shape in shapes] {
  if (has("gravity", shape)) {
    p = number("dx_gravity_prefactor", shape); e = number("dx_gravity_exponent", shape)
    commands = commands.sprintf("file_of('gravity', '%s') using ($1):(mm($2)):(mm(below(2, 3))):(mm(above(2, 3))) skip 1 with yerrorbars pointtype %d linecolor rgb '%s' title '%s%s', ", shape, point_of(shape), color_of(shape), title_of(shape), known(e) ? sprintf(": g^{%.2f}", e) : "")
    if (known(e)) { commands = commands.sprintf("mm(%g * (1 * x)**%g) with lines linewidth 0.8 linecolor rgb '%s' notitle, ", p, e, color_of(shape)) }
  }
}
eval "plot ".commands."4e-3 * x**2 with lines dashtype 2 linecolor rgb grey title 'paper: slope g^2'"
