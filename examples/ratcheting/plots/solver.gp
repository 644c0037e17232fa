# SPDX-License-Identifier: MIT
# Cost and quality of each step: sweeps, residual, overlap.
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/solver.png"
set multiplot layout 3, 1 margins 0.11, 0.97, 0.10, 0.97 spacing 0, 0.03
set offsets 0, 0, graph 0.05, graph 0.05
set format x ""
set ylabel "sweeps"
unset key
plot solver using 1:4 skip 1 with lines linewidth 0.7 linecolor rgb blue notitle
set ylabel "residual"
set logscale y
set format y "10^{%L}"
unset offsets
plot solver using 1:($5 > 0 ? $5 : NaN) skip 1 with lines linewidth 0.7 linecolor rgb red notitle
set ylabel "overlap  [µm]"
set key center right
set xlabel "step"
set format x "%g"
plot solver using 1:($6 > 0 ? 1e6 * $6 : NaN) skip 1 with lines linewidth 0.7 linecolor rgb orange title "largest", \
     solver using 1:($7 > 0 ? 1e6 * $7 : NaN) skip 1 with lines linewidth 0.9 linecolor rgb green title "mean"
unset multiplot
