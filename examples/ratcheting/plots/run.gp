# SPDX-License-Identifier: MIT
# The plots of a run. Call: gnuplot -e "folder='...'; name='x_t'" run.gp, with the folder of the run and the
# name of one of the plots below; writes <folder>/<name>.png.
load system("dirname '".ARG0."'")."/style.gp"
set output folder."/".name.".png"

# Displacement of the wall and force on it, over time.
if (name eq "x_t") {
  set multiplot layout 2, 1 margins 0.10, 0.97, 0.11, 0.96 spacing 0, 0.03
  set format x ""
  unset key
  set ylabel "wall displacement x  [mm]"
  set yrange [*:*]
  set offsets graph 0, 0, 0.06, 0.06
  plot wall using 1:(mm($3)) skip 1 with lines linecolor rgb blue
  set format x "%g"
  set xlabel "t  [s]"
  set ylabel "driving force f  [kN]"
  plot wall using 1:(kN($2)) skip 1 with lines linecolor rgb red
  unset multiplot
}

# One period between two maxima of the force: displacement above force, with x_j, the largest
# displacement and its delay behind the minimum of the force. Set `period` (1, 2, ...) to
# choose another period than the middle one. Without events.csv the last fifth of the run is shown without marks.
if (name eq "one_period") {
  if (has_events) {
    stats events using 1 skip 1 nooutput
    shown = exists("period") ? period : ceil((STATS_min + STATS_max) / 2)
    field(n) = real(system(sprintf("awk -F, '$1 == %d {print $%d}' '%s'", shown, n, events)))
    start = field(2); x_before = field(3); t_onset = field(4); t_min = field(5)
    t_peak = field(6); x_peak = field(7); finish = field(8); x_after = field(9)
  } else {
    stats wall using 1 skip 1 nooutput
    finish = STATS_max
    start = STATS_min + 0.8 * (STATS_max - STATS_min)
  }
  set multiplot layout 2, 1 margins 0.11, 0.97, 0.11, 0.96 spacing 0, 0.03
  set xrange [start:finish]
  set offsets 0, 0, graph 0.2, graph 0.14
  unset key
  set format x ""
  set ylabel "x  [mm]"
  if (has_events) {
    lowest = x_before < x_after ? x_before : x_after
    peak_at = mm(x_peak)
    set arrow 1 from start, mm(x_before) to finish, mm(x_before) nohead dashtype 2 linecolor rgb grey
    set arrow 2 from t_peak, mm(x_before) to t_peak, peak_at heads size graph 0.008, 20 linecolor rgb green
    set label 2 sprintf("Δx_{max} = %.3g mm", mm(x_peak - x_before)) at t_peak, peak_at center offset 0, 0.8 textcolor rgb green
    set label 1 sprintf("x_j = %.4g mm", mm(x_before)) at start, mm(x_before) offset 1, 0.8 textcolor rgb grey
    set label 3 sprintf("x_j' = %.4g mm", mm(x_after)) at finish, mm(x_after) right offset -1, -0.9 textcolor rgb grey
    set arrow 4 from t_min, graph 0 to t_min, graph 1 nohead dashtype 3 linecolor rgb orange
  }
  plot wall using 1:(mm($3)) skip 1 with lines linecolor rgb blue linewidth 1.6 notitle
  unset label
  unset arrow
  set key top center
  set format x "%g"
  set xlabel "t  [s]"
  set ylabel "f  [kN]"
  if (has_events) {
    set arrow 4 from t_min, graph 0 to t_min, graph 1 nohead dashtype 3 linecolor rgb orange
    set arrow 5 from t_peak, graph 0 to t_peak, graph 1 nohead dashtype 3 linecolor rgb orange
    set arrow 6 from t_min, graph 0.62 to t_peak, graph 0.62 heads size graph 0.008, 20 linecolor rgb orange
    set label 4 sprintf("δt_r = %.3g ms", mm(t_peak - t_min)) at 0.5 * (t_min + t_peak), graph 0.62 center offset 0, 0.8 textcolor rgb orange
    set label 5 sprintf("the wall starts to move %.3g ms %s the minimum", mm(abs(t_min - t_onset)), t_onset < t_min ? "before" : "after") at graph 0.985, graph 0.06 right textcolor rgb grey
  }
  plot wall using 1:(kN($2)) skip 1 with lines linecolor rgb red linewidth 1.6 title "driving force", \
       wall using 1:(kN($5)) skip 1 with lines linecolor rgb blue linewidth 0.7 title "force of the grains"
  unset multiplot
}

# Force of the grains on the wall over its displacement: the loop of each period.
if (name eq "f_g_x") {
  set lmargin screen 0.12
  set rmargin screen 0.85
  unset key
  set autoscale cbfix
  set xlabel "x  [mm]"
  set ylabel "f_g  [kN]"
  set cblabel "t  [s]" offset 0.5
  set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
  set offsets graph 0.03, graph 0.03, graph 0.03, 0
  start = 0
  if (has_events) {
    stats events using 2 skip 1 nooutput
    start = STATS_min  # the filling transient is left out
  }
  plot wall using ($1 >= start ? mm($3) : NaN):(kN($5)):1 skip 1 with lines linewidth 0.9 linecolor palette notitle
}

# Change of the solid fraction since the start, in the control volume and in the box, over time.
if (name eq "rho_t") {
  stats packing every ::0::0 using 2 skip 1 nooutput
  inner = STATS_min
  stats packing every ::0::0 using 3 skip 1 nooutput
  box = STATS_min
  set xlabel "t  [s]"
  set ylabel "Δρ"
  set key bottom right nobox
  set offsets 0, 0, graph 0.05, graph 0.05
  plot packing using 1:($3 - box) skip 1 with lines linecolor rgb grey linewidth 0.9 title sprintf("whole box, from %.4f", box), \
       packing using 1:($2 - inner) skip 1 with lines linecolor rgb green linewidth 1.6 title sprintf("inner control volume, from %.4f", inner)
}

# Change of the solid fraction in the control volume over the displacement of the wall.
if (name eq "rho_x") {
  # Rows of packing.csv with the x of the same time in wall.csv.
  joined = "< awk -F, 'FNR == 1 {next} FNR == NR {x[$1] = $3; next} $1 in x {print $1 \",\" x[$1] \",\" $2}' '".wall."' '".packing."'"
  stats packing every ::0::0 using 2 skip 1 nooutput
  inner = STATS_min
  start = 0
  if (has_events) {
    stats events using 2 skip 1 nooutput
    start = STATS_min  # the filling transient is left out
  }
  set lmargin screen 0.13
  set rmargin screen 0.85
  unset key
  set autoscale cbfix
  set xlabel "x  [mm]"
  set ylabel "Δρ, inner control volume"
  set cblabel "t  [s]" offset 0.5
  set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
  set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05
  plot joined using ($1 >= start ? mm($2) : NaN):($3 - inner):1 with linespoints pointtype 7 pointsize 0.35 linewidth 0.8 linecolor palette notitle
}

# Velocity of the wall over its displacement.
if (name eq "phase_portrait") {
  set lmargin screen 0.12
  set rmargin screen 0.85
  unset key
  set autoscale cbfix
  set xlabel "x  [mm]"
  set ylabel "v  [mm/s]"
  set cblabel "t  [s]" offset 0.5
  set palette defined (0 "#16335b", 0.5 "#2e7d4f", 1 "#e0a100")
  set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05
  set xzeroaxis linetype 1 linecolor rgb grey
  start = 0
  if (has_events) {
    stats events using 2 skip 1 nooutput
    start = STATS_min  # the filling transient is left out
  }
  plot wall using ($1 >= start ? mm($3) : NaN):(1e3 * $4):1 skip 1 with lines linewidth 1.1 linecolor palette notitle
}

# Cost and quality of each step: sweeps, residual, overlap.
if (name eq "solver") {
  set multiplot layout 3, 1 margins 0.11, 0.97, 0.10, 0.955 spacing 0, 0.03
  set offsets 0, 0, graph 0.05, 0
  set format x ""
  set ylabel "sweeps"
  unset key
  set yrange [0:*]
  plot solver using 1:4 skip 1 with lines linewidth 0.7 linecolor rgb blue notitle
  set yrange [*:*]
  set ylabel "residual"
  set logscale y
  set format y "10^{%L}"
  unset offsets
  plot solver using 1:($5 > 0 ? $5 : NaN) skip 1 with lines linewidth 0.7 linecolor rgb red notitle
  set ylabel "overlap  [µm]"
  set key top right
  set xlabel "step"
  set format x "%g"
  plot solver using 1:($6 > 0 ? 1e6 * $6 : NaN) skip 1 with lines linewidth 0.7 linecolor rgb orange title "largest", \
       solver using 1:($7 > 0 ? 1e6 * $7 : NaN) skip 1 with lines linewidth 0.9 linecolor rgb green title "mean"
  unset multiplot
}
