# SPDX-License-Identifier: MIT
# Every run at the baseline box: displacement over scaled load. Lines: C of the fit and of the
# paper; crosses: the closed form with thrust and carried mass of each run's flights, and with each
# run's mean force and one beta.
width = 1500; height = 1150
load system("dirname '".ARG0."'")."/style.gp"
set multiplot layout 2, 2 margins 0.07, 0.98, 0.075, 0.92 spacing 0.08, 0.13
set label 9 "△ frequency   ○ force   □ gravity   ◇ wall mass   + without creep   × (black) closed form, F and β of each flight   × (grey) closed form, one β" at screen 0.5, 0.975 center font ",14"
set logscale xy
set format "10^{%L}"
set xlabel "(mg)^2 / [(m + m_w) f_{max} ν^2]  [mm]"
set ylabel "Δx_{max}  [mm]"
set key bottom right font ",12" Left reverse
do for [shape in shapes] {
  if (!has("master", shape)) {
    set multiplot next
    continue
  }
  set title title_of(shape)
  c = number("active_C", shape); all = number("C", shape); beta = number("beta", shape)
  commands = ""
  do for [k = 1:4] {
    symbol = word("8 6 4 12", k) + 0
    commands = commands.sprintf("file_of('master', '%s') using ($1 == %d ? mm($2) : NaN):(mm($3)) skip 1 with points pointtype %d linecolor rgb '%s' notitle, ", shape, k, symbol, color_of(shape))
  }
  commands = commands.sprintf("file_of('master', '%s') using (mm($2)):(mm($6)) skip 1 with points pointtype 1 linecolor rgb '%s' notitle, ", shape, color_of(shape))
  if (known(beta)) { commands = commands.sprintf("file_of('master', '%s') using (mm($2)):(mm($5)) skip 1 with points pointtype 2 pointsize 0.6 linecolor rgb grey notitle, ", shape) }
  commands = commands.sprintf("file_of('master', '%s') using (mm($2)):(mm($7)) skip 1 with points pointtype 2 pointsize 0.8 linecolor rgb 'black' notitle, ", shape)
  if (known(c)) { commands = commands.sprintf("%g * x with lines linecolor rgb '%s' title 'C = %.3f without creep, %.3f with it', ", c, color_of(shape), c, all) }
  paper = shape eq "polyhedron" || shape eq "sphere" ? 0.01 : 0.05
  eval "plot ".commands.sprintf("%g * x with lines dashtype 2 linecolor rgb grey title 'paper: C = %g'", paper, paper)
  unset label 9
}
unset multiplot
