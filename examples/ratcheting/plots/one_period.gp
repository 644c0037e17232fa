# SPDX-License-Identifier: MIT
# One period between two maxima of the force: displacement above force, with x_j, the largest
# displacement and its delay behind the minimum of the force. Set `period` (1, 2, ...) for another
# than the middle one. Without events.csv the last fifth of the run is shown without marks.
load system("dirname '".ARG0."'")."/style.gp"
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
set output folder."/one_period.png"
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
  set label 5 sprintf("starts %.3g ms %s the minimum", mm(abs(t_min - t_onset)), t_onset < t_min ? "before" : "after") at t_min, graph 0.06 right offset -1, 0 textcolor rgb grey
}
plot wall using 1:(kN($2)) skip 1 with lines linecolor rgb red linewidth 1.6 title "driving force", \
     wall using 1:(kN($5)) skip 1 with lines linecolor rgb blue linewidth 0.7 title "force of the grains"
unset multiplot
