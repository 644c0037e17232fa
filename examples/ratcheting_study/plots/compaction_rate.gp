# SPDX-License-Identifier: MIT
# Compaction rate over the frequency with the two forms of the paper, and the paper's own curve.
width = 1500; height = 1150
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.07, 0.98, 0.07, 0.95 spacing 0.08, 0.14
set logscale xy
set xrange [0.8:75]
set format y "10^{%L}"
set xlabel "ν  [Hz]"
set ylabel "compaction rate  [1/s]"
set key bottom left
branches(nu, a, c) = nu < c ? a * nu : a * c * c / nu
single(nu, a, c) = a * nu * (1 + exp(-(nu / c - 1)**2)) / (1 + (nu / c)**2)
do for [shape in shapes] {
  if (!has("frequencies", shape)) {
    set multiplot next
    continue
  }
  set title title_of(shape)
  a = number("rate_prefactor", shape); c = number("nu_c", shape)
  as = number("single_prefactor", shape); cs = number("single_nu_c", shape)
  commands = sprintf("file_of('frequencies', '%s') using 1:6:(error($7)) skip 1 with yerrorbars pointtype 7 linecolor rgb '%s' title 'measured', ", shape, color_of(shape))
  if (known(a)) { commands = commands.sprintf("branches(x, %g, %g) with lines linecolor rgb '%s' title 'two branches: %.4f, ν_c = %.1f Hz', ", a, c, color_of(shape), a, c) }
  if (known(as)) { commands = commands.sprintf("single(x, %g, %g) with lines dashtype 4 linecolor rgb '%s' title 'single form: %.4f, ν_c = %.1f Hz', ", as, cs, color_of(shape), as, cs) }
  eval "plot ".commands."branches(x, 0.005, 10.) with lines dashtype 2 linecolor rgb grey title 'paper, 3D: 0.005, 10 Hz'"
}
unset multiplot
