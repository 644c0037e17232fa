# SPDX-License-Identifier: MIT
# Largest displacement and largest passive speed over the frequency. +: displacement from where the
# falling force is the weight, without creep, and its law. The paper's lines: C for grains with
# corners; of the speed its slope alone.
width = 1600; height = 750
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 1, 2 margins 0.06, 0.99, 0.1, 0.97 spacing 0.07, 0
set logscale xy
set xrange [0.8:75]
set autoscale yfix
set format y "10^{%L}"
set xlabel "ν  [Hz]"
set key bottom left font ",12" Left reverse spacing 1.4
do for [name in "dx v"] {
  is_way = name eq "dx"
  column = is_way ? 2 : 4
  set ylabel (is_way ? "Δx_{max}  [mm]" : "v_{max}, passive  [mm/s]")
  commands = ""
  do for [shape in shapes] {
    if (has("frequencies", shape)) {
      law = is_way ? "active" : "v"
      p = number(law."_frequency_prefactor", shape); e = number(law."_frequency_exponent", shape); all = number("dx_frequency_exponent", shape)
      title = title_of(shape).(!known(e) ? "" : is_way ? sprintf(": ν^{%.2f}, + ν^{%.2f}", all, e) : sprintf(": ν^{%.2f}", e))
      file = file_of("frequencies", shape)
      commands = commands.points_of(file, "$1", column, 1e3, point_of(shape), color_of(shape), title).bars_of(file, "$1", column, column + 1, 1e3, color_of(shape))
      if (is_way) { commands = commands.points_of(file, "$1", 11, 1e3, 1, color_of(shape), "") }
      if (known(e)) { commands = commands.law_of(1e3 * p, e, "x", color_of(shape)) }
    }
  }
  eval "plot ".commands.(is_way ? papers_of("(5 / x)**2") : "700. / x with lines dashtype 2 linecolor rgb grey title 'paper: slope ν^{-1}', ")." NaN notitle"
}
unset multiplot
