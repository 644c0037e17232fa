# SPDX-License-Identifier: MIT
# Largest displacement and largest passive speed over the frequency, with fits and the paper's
# slopes; +: displacement from where the falling force is the weight.
width = 1600; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 1, 2 margins 0.06, 0.99, 0.1, 0.97 spacing 0.07, 0
set logscale xy
set xrange [0.8:75]
set autoscale yfix
set format y "10^{%L}"
set xlabel "ν  [Hz]"
set key bottom left
set ylabel "Δx_{max}  [mm]"
law(name, shape, x) = number(name."_prefactor", shape) * x**number(name."_exponent", shape)
do for [name in "dx v"] {
  column = name eq "dx" ? 2 : 4
  set ylabel (name eq "dx" ? "Δx_{max}  [mm]" : "v_{max}, passive  [mm/s]")
  commands = ""
  do for [shape in shapes] {
    if (has("frequencies", shape)) {
      p = number(name."_frequency_prefactor", shape); e = number(name."_frequency_exponent", shape)
      commands = commands.sprintf("file_of('frequencies', '%s') using 1:(mm($%d)):(mm(below(%d, %d))):(mm(above(%d, %d))) skip 1 with yerrorbars pointtype %d linecolor rgb '%s' title '%s%s', ", shape, column, column, column + 1, column, column + 1, point_of(shape), color_of(shape), title_of(shape), (known(e) ? sprintf(": ν^{%.2f}", e) : "").(name eq "dx" && known(number("active_frequency_exponent", shape)) ? sprintf(", + ν^{%.2f}", number("active_frequency_exponent", shape)) : ""))
      if (name eq "dx") { commands = commands.sprintf("file_of('frequencies', '%s') using 1:(mm($11)) skip 1 with points pointtype 1 linecolor rgb '%s' notitle, ", shape, color_of(shape)) }
      if (known(e)) { commands = commands.sprintf("mm(%g * x**%g) with lines linewidth 0.8 linecolor rgb '%s' notitle, ", p, e, color_of(shape)) }
    }
  }
  guide = name eq "dx" ? "20. * x**(-2)" : "700. * x**(-1)"
  eval "plot ".commands.guide." with lines dashtype 2 linecolor rgb grey title '".(name eq "dx" ? "+: without creep; " : "")."paper: slope ".(name eq "dx" ? "ν^{-2}" : "ν^{-1}")."'"
}
unset multiplot
