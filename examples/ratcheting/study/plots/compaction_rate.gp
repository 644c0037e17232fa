# SPDX-License-Identifier: MIT
# Compaction rate over the frequency with the two forms of the paper, and in space the paper's own
# curve; small: of the whole box over the first second, one window for all frequencies.
width = 1500; height = 1200
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.07, 0.98, 0.06, 0.96 spacing 0.08, 0.12
set logscale xy
set xrange [0.8:75]
set yrange [2e-4:1]
set format y "10^{%L}"
set xlabel "ν  [Hz]"
set ylabel "compaction rate  [1/s]"
set key top left font ",12" Left reverse spacing 1.4
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
  file = file_of("frequencies", shape)
  commands = points_of(file, "$1", 6, 1, 7, color_of(shape), "inner volume, whole run").bars_of(file, "$1", 6, 7, 1, color_of(shape))
  commands = commands.sprintf("'%s' using 1:13 skip 1 with points pointtype 6 pointsize 0.8 linecolor rgb '#444444' title 'whole box, first second', ", file)
  if (known(a)) { commands = commands.sprintf("branches(x, %g, %g) with lines linecolor rgb '%s' title 'two branches: %.4f, ν_c = %.1f Hz', ", a, c, color_of(shape), a, c) }
  if (known(as)) { commands = commands.sprintf("single(x, %g, %g) with lines dashtype 4 linecolor rgb '%s' title 'single form: %.4f, ν_c = %.1f Hz', ", as, cs, color_of(shape), as, cs) }
  if (shape eq "polyhedron" || shape eq "sphere") { commands = commands."branches(x, 0.005, 10.) with lines dashtype 2 linecolor rgb grey title 'paper: 0.005, 10 Hz', " }
  eval "plot ".commands." NaN notitle"
}
unset multiplot
