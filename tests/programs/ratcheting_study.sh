#!/bin/bash
# SPDX-License-Identifier: MIT
# The study as a program, with few grains: a killed case is told and run again, what is done is
# skipped, and after kill -9 and a new start all tables are the same bytes; they are the same without the
# folders of the runs, too. Argument: the executable.
set -u
program=$1
source "$(dirname "$0")/failures.sh"
children_of() { cat "/proc/$1/task/$1/children" 2>/dev/null; }
has_child() { [ -n "$(children_of "$1")" ]; }
study() { "$program" --plan small --jobs 2 "$@"; }
# wait_for seconds command...: until it succeeds
wait_for() {
  local left=$(($1 * 20))
  shift
  until "$@" >/dev/null 2>&1; do
    [ $((left -= 1)) -gt 0 ] || return 1
    sleep 0.05
  done
}

# run.sh answers --help with a file, without a build; the file says what the program says.
sources=$(cd "$(dirname "$0")/../../examples/ratcheting" && pwd)
diff "$sources/study/help.txt" <("$program" --help) || fail "help.txt is not what --help says"
diff "$sources/study/help.txt" <(timeout 5 "$sources/study/run.sh" --help) || fail "run.sh --help"

for wrong in "--plan large" "--set nothing" "--case 999" "--shape cube" "--jobs 0"; do
  # shellcheck disable=SC2086
  "$program" $wrong --output "$folder/wrong" --list >/dev/null 2>&1
  [ $? = 2 ] || fail "$wrong was not refused"
done
study --list --output "$folder/a" >"$folder/list" || fail "list"
cases=$(wc -l <"$folder/list")

# One case of a killed process: said, left out, run by the next start.
"$program" --plan small --case 1 --output "$folder/a" >"$folder/killed.log" 2>&1 &
pid=$!
wait_for 20 has_child "$pid" || fail "no case was started"
# shellcheck disable=SC2046
kill -9 $(children_of "$pid")
wait "$pid"
[ $? = 1 ] || fail "a killed case did not end with status 1"
grep -q "killed by signal 9" "$folder/killed.log" || fail "a killed case is not told"
grep -q done <(study --list --output "$folder/a") && fail "a killed case counts as done"

# The study itself killed: its processes end, what it had done stays.
"$program" --plan small --jobs 2 --output "$folder/a" >"$folder/first.log" 2>&1 &
pid=$!
wait_for 60 grep -q "done in" "$folder/first.log" || fail "nothing was done"
children=$(children_of "$pid")
kill -9 "$pid"
wait "$pid" 2>/dev/null
for child in $children; do
  wait_for 5 bash -c "! kill -0 $child" || fail "process $child outlived its study"
done
study --output "$folder/a" >"$folder/second.log" 2>&1 || fail "second start: $(tail -3 "$folder/second.log")"
grep -q " 0 failed" "$folder/second.log" || fail "second start"
grep -q " 0 were done before" "$folder/second.log" && fail "the second start skipped nothing"
[ "$(grep -c ' done ' <(study --list --output "$folder/a"))" = "$cases" ] || fail "not all is done"

study --output "$folder/b" --report-only >/dev/null 2>&1 || fail "report of nothing"
# The same without a kill, by the tasks of a job array.
for task in $(seq "$cases"); do
  study --case "$task" --output "$folder/b" >>"$folder/array.log" 2>&1 || fail "task $task"
done
[ -e "$folder/b/results/wall_clock.csv" ] || fail "no wall clock"
study --output "$folder/b" --report-only >/dev/null || fail "report"
diff -r --brief --exclude 'wall_clock.*' --exclude '*.svg' --exclude '*.png' \
  "$folder/a/results" "$folder/b/results" ||
  fail "tables differ after kill -9"
grep -q '^{"name":"polygon-s1-5Hz",' "$folder/a/results/runs.jsonl" || fail "a run is not in the table"
for table in cases.csv runs.jsonl; do
  [ -s "$folder/a/results/$table" ] || fail "no $table"
done
if command -v gnuplot >/dev/null && command -v python3 >/dev/null; then
  for name in x_t one_period velocity_field f_g_x force_chains rho_t rho_x phase_portrait \
    dx_v_frequency dx_loads master compaction_rate; do
    [ -s "$folder/a/results/figures/$name.png" ] || fail "no figure $name"
  done
  [ -e "$folder/a/results/figures/long_course.png" ] && fail "a figure of runs that the plan has not"
fi

# A damaged run is named and its line in the table stays as it is; without the line it is not done.
run=$folder/b/cases/polygon-s1-5Hz
cp -r "$run" "$folder/intact"
cp -r "$folder/b/results" "$folder/reported"
for damage in 'head -c 20000 wall.csv >x; mv x wall.csv' 'sed -i "9s/.*/a,b/" wall.csv' 'rm wall.csv' \
  'sed -i "\$d" wall.csv' 'sed -i "20,\$d" packing.csv' 'sed -i "9s/^[^,]*/0/" state.csv' \
  'printf 1,2 >>chains_active.csv' 'sed -i "9s/,[^,]*/,nan/" wall.csv'; do
  rm -r "$run"
  cp -r "$folder/intact" "$run"
  (cd "$run" && eval "$damage")
  study --no-figures --output "$folder/b" --report-only >"$folder/damaged.log" 2>&1
  [ $? = 1 ] || fail "$damage: no failure"
  grep -qF "$run is damaged" "$folder/damaged.log" || fail "$damage: $(cat "$folder/damaged.log")"
  cmp "$folder/reported/runs.jsonl" "$folder/b/results/runs.jsonl" || fail "$damage: another result is kept"
  diff --brief "$folder/reported/cases.csv" "$folder/b/results/cases.csv" || fail "$damage: another table"
done
sed -i '/^{"name":"polygon-s1-5Hz",/d' "$folder/b/results/runs.jsonl"
study --list --output "$folder/b" 2>/dev/null | grep -q "done polygon-s1-5Hz " && fail "a damaged run counts as done"
study --shape polygon --output "$folder/b" >"$folder/again.log" 2>&1 || fail "start with a damaged run"
grep -q "^1 ran" "$folder/again.log" || fail "a damaged run did not run again"
diff -r --brief --exclude 'wall_clock.*' "$folder/reported" "$folder/b/results" || fail "another report after a damaged run"
study --seed 1 --report-only --output "$folder/b" >/dev/null 2>&1
[ $? = 2 ] || fail "a report of one sample was promised"

# The table of the runs is enough: without their folders nothing runs, and all is the same bytes.
cp -r "$folder/a/results" "$folder/kept"
rm -r "$folder/a/cases" "$folder/a/results/figures"
rm "$folder"/a/results/{cases.csv,wall_clock.md}
study --output "$folder/a" --report-only >/dev/null || fail "report without folders"
diff -r --brief "$folder/kept" "$folder/a/results" || fail "another report without folders"
study --output "$folder/a" >"$folder/third.log" 2>&1 || fail "start without folders"
grep -q "^0 ran, $cases were done before" "$folder/third.log" || fail "a case that is kept ran again"
diff -r --brief "$folder/kept" "$folder/a/results" || fail "another report after a start without folders"

# A line of a run with other parameters does not count; what is no such line is named.
table=$folder/a/results/runs.jsonl
spoil() { sed "/^{\"name\":\"disk-s1-20Hz\",/{$1}" "$folder/kept/runs.jsonl" >"$table"; }
spoil 's/"friction":0.4/"friction":0.3/'
study --list --output "$folder/a" | grep -q "done disk-s1-20Hz " && fail "other parameters count as done"
for spoilt in 's/"C":[^,]*/"C":1x/' 's/"thrust"/"trust"/' 's/"dx_max":/"dx_max":"x" \/\/ /' \
  's/"t_peak":\[[^,]*,/"t_peak":[/' 's/.*//' 's/^{/[/;s/}$/]/'; do
  spoil "$spoilt"
  cmp -s "$folder/kept/runs.jsonl" "$table" && fail "$spoilt spoils nothing"
  study --output "$folder/a" --report-only >"$folder/spoilt.log" 2>&1
  [ $? = 1 ] || fail "$spoilt was read"
  grep -qF "$table, line " "$folder/spoilt.log" || fail "$spoilt: $(cat "$folder/spoilt.log")"
done
# Such a case runs again, and all is as it was; its seconds are others.
study --output "$folder/a" >"$folder/mended.log" 2>&1 || fail "start with a spoilt line"
grep -q "^1 ran" "$folder/mended.log" || fail "a case with a spoilt line did not run again"
diff -r --brief --exclude 'wall_clock.*' "$folder/kept" "$folder/a/results" ||
  fail "another report after a spoilt line"
rm -r "$folder/a/cases"
spoil 's/"thrust":[^,]*/"thrust":null/'
study --no-figures --output "$folder/a" --report-only >/dev/null || fail "a result that is not a number was refused"
grep -q "^6,disk-s1-20Hz,.*,nan," "$folder/a/results/cases.csv" || fail "nan was lost"

# Stopped by a signal: what was done is kept, and in the report on demand.
for signal in TERM INT; do
  "$program" --plan small --jobs 2 --output "$folder/$signal" >"$folder/$signal.log" 2>&1 &
  pid=$!
  wait_for 60 grep -q "done in" "$folder/$signal.log" || fail "nothing was done"
  kill "-$signal" "$pid"
  wait "$pid"
  [ $? = 130 ] || fail "SIG$signal did not end with status 130"
  grep -q "^interrupted: .* will run again" "$folder/$signal.log" || fail "SIG$signal is not told"
  study --no-figures --output "$folder/$signal" --report-only >"$folder/$signal.report" ||
    fail "report after SIG$signal"
  ended=$(grep -c "done in" "$folder/$signal.log")
  grep -q "^$ended of $cases cases are done" "$folder/$signal.report" || fail "report after SIG$signal"
  [ "$(wc -l <"$folder/$signal/results/runs.jsonl")" = "$ended" ] || fail "kept after SIG$signal"
done

# A stiffness that is the default of springs is told to compliant contacts, which have another one.
printf '#!/bin/bash\necho "$*" >"%s"\nexit 1\n' "$folder/told" >"$folder/stub"
chmod +x "$folder/stub"
mkdir -p "$folder/k/cases/disk-s31-5Hz-T0.35s-compliant"
touch "$folder/k/cases/disk-s31-5Hz-T0.35s-compliant/checkpoint.snapshot"
number=$("$program" --plan controls --list --output "$folder/k" | awk '/ disk-s31-60Hz-k1e\+07-/ {print $1}')
"$program" --plan controls --case "$number" --program "$folder/stub" --output "$folder/k" >"$folder/k.log" 2>&1
grep -q -e "--stiffness 1e+07" "$folder/told" || fail "stiffness of a case: $(cat "$folder/told" "$folder/k.log")"

# The results of the repository are those of its table; the report is compared in tests/study/report.py.
results=$sources/results
mkdir -p "$folder/study"
cp "$results"/{runs.jsonl,wall_clock.csv} "$folder/study"
"$program" --plan paper --report-only --no-figures --output "$folder/none" --results "$folder/study" \
  >"$folder/study.log" 2>&1 || fail "tables of the repository's runs: $(tail -3 "$folder/study.log")"
grep "^not read" "$folder/study.log" && fail "a line of the repository's table does not count"
for file in runs.jsonl wall_clock.csv wall_clock.md remaining-{paper,settled,controls}.md; do
  cmp "$results/$file" "$folder/study/$file" || fail "$file is not what the table gives"
done
[ "$failures" = 0 ] && echo "all passed"
exit "$failures"
