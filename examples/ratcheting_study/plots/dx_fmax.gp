# SPDX-License-Identifier: MIT
# Largest displacement over the largest force, 5 Hz.
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale xy
set xrange [1.6:13]
set xtics (2, 3, 4, 5, 6, 8, 10)
set mytics 10
set xlabel "f_{max}  [kN]"
set ylabel "Δx_{max}  [mm]"
set key bottom left
commands = ""
do for [shape in shapes] {
  if (has("fmax", shape)) {
    p = number("dx_fmax_prefactor", shape); e = number("dx_fmax_exponent", shape)
    commands = commands.sprintf("file_of('fmax', '%s') using (1e-3 * $1):(mm($2)):(mm(below(2, 3))):(mm(above(2, 3))) skip 1 with yerrorbars pointtype %d linecolor rgb '%s' title '%s%s', ", shape, point_of(shape), color_of(shape), title_of(shape), known(e) ? sprintf(": f_{max}^{%.2f}", e) : "")
    if (known(e)) { commands = commands.sprintf("mm(%g * (1e3 * x)**%g) with lines linewidth 0.8 linecolor rgb '%s' notitle, ", p, e, color_of(shape)) }
  }
}
eval "plot ".commands."2.5 * x**(-1) with lines dashtype 2 linecolor rgb grey title 'paper: slope f_{max}^{-1}'"
