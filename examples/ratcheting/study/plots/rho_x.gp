# SPDX-License-Identifier: MIT
# The change of the inner solid fraction over the wall's displacement, from the first jam on.
width = 1400; height = 1000
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.10, 0.90, 0.07, 0.95 spacing 0.22, 0.14
unset key
set xlabel "x  [mm]"
set ylabel "Δρ, inner volume" offset 1, 0
set cblabel "t  [s]" offset -1, 0
set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05
do for [shape in shapes] {
  if (!has("packing", shape)) {
    set multiplot next
    continue
  }
  # Rows of both tables at the same times: the state's is written with the packing's.
  joined = sprintf("< paste -d, '%s' '%s'", file_of("packing", shape), file_of("state", shape))
  stats file_of("packing", shape) every ::0::0 using 2 skip 1 nooutput
  inner = STATS_min
  set title title_of(shape)
  plot joined using ($1 >= 0.15 ? mm($5) : NaN):($2 - inner):1 skip 1 with linespoints pointtype 7 pointsize 0.3 linewidth 0.8 linecolor palette
}
unset multiplot
