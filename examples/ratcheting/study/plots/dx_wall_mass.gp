# SPDX-License-Identifier: MIT
# Way out without creep times m + m_w over that at m_w = m/2: flat where it goes as the paper's
# m/(m + m_w). Lines: 1/(m_w + beta m).
width = 900; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set logscale x
set xrange [0.08:5]
set yrange [0:2]
set xtics (0.1, 0.2, 0.5, 1, 2, 4)
set xlabel "m_w / m"
set ylabel "Δx (m + m_w), over that at m_w = m/2"
set key top right font ",12" Left reverse
commands = ""
do for [shape in shapes] {
  if (has("wall-mass", shape)) {
    file = file_of("wall-mass", shape)
    unit = real(system(sprintf("awk -F, '$1 == 0.5 {print 1.5 * $11; found = 1} END {if (!found) print \"NaN\"}' '%s'", file)))
    beta = number("active_wall_beta", shape)
    if (known(unit)) {
      commands = commands.sprintf("'%s' using 1:((1 + $1) * $11 / %g) skip 1 with points pointtype %d linecolor rgb '%s' title '%s%s', ", file, unit, point_of(shape), color_of(shape), title_of(shape), known(beta) ? sprintf(": β = %.2f", beta) : "")
      commands = commands.sprintf("'%s' using 1:((1 + $1) * ($11 - $12) / %g):(0):(2 * (1 + $1) * $12 / %g) skip 1 with vectors nohead linewidth 0.9 linecolor rgb '%s' notitle, ", file, unit, unit, color_of(shape))
      if (known(beta)) { commands = commands.sprintf("(1 + x) / 1.5 * (0.5 + %g) / (x + %g) with lines linewidth 0.8 linecolor rgb '%s' notitle, ", beta, beta, color_of(shape)) }
    }
  }
}
eval "plot ".commands."1 with lines dashtype 2 linecolor rgb grey title 'paper: β = 1'"
