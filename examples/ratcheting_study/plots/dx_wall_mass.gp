# SPDX-License-Identifier: MIT
# Largest displacement over the wall's mass, as a share of the one at m_w = m/2: the paper's
# m/(m + m_w), and 1/(m_w + beta m).
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale xy
set xrange [0.08:5]
set xtics (0.1, 0.2, 0.5, 1, 2, 4)
set xlabel "m_w / m"
set ylabel "Δx_{max} / Δx_{max}(m_w = m/2)"
set key bottom left
commands = ""
do for [shape in shapes] {
  if (has("wall-mass", shape)) {
    unit = real(system(sprintf("awk -F, '$1 == 0.5 {print $2; found = 1} END {if (!found) print \"NaN\"}' '%s'", file_of("wall-mass", shape))))
    beta = number("wall_beta", shape)
    if (known(unit)) { commands = commands.sprintf("file_of('wall-mass', '%s') using 1:($2 / %g):(error($3) / %g) skip 1 with yerrorbars pointtype %d linecolor rgb '%s' title '%s%s', ", shape, unit, unit, point_of(shape), color_of(shape), title_of(shape), known(beta) ? sprintf(": β = %.2f", beta) : "") }
    if (known(unit) && known(beta)) { commands = commands.sprintf("(0.5 + %g) / (x + %g) with lines linewidth 0.8 linecolor rgb '%s' notitle, ", beta, beta, color_of(shape)) }
  }
}
eval "plot ".commands."1.5 / (x + 1) with lines dashtype 2 linecolor rgb grey title 'paper: β = 1'"
