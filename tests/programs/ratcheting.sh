#!/bin/bash
# SPDX-License-Identifier: MIT
# The study as a program: refuses bad values with a message and status 2, gives the same wall.csv
# twice and over a restart, leaves valid files when it is interrupted. Argument: the executable.
set -u
program=$1
source "$(dirname "$0")/failures.sh"

# run.sh answers --help with a file, without a build; the file says what the program says.
sources=$(cd "$(dirname "$0")/../../examples/ratcheting" && pwd)
diff "$sources/help.txt" <("$program" --help) || fail "help.txt is not what --help says"
diff "$sources/help.txt" <(timeout 5 "$sources/run.sh" --seed 2 --help) || fail "run.sh --help"

# refuse "part of the message" options...
refuse() {
  local wanted=$1 said status
  shift
  said=$(timeout 20 "$program" --no-plots --output "$folder/refused" "$@" 2>&1)
  status=$?
  [ "$status" = 2 ] || fail "$* ended with status $status"
  grep -qF -e "$wanted" <<<"$said" || fail "$* said: $said"
}
refuse "--density" --density -1
refuse "--density" --density nan
refuse "--step" --step 0
refuse "--step" --step inf
refuse "must not exceed --duration" --shape disk --step 0.1 --duration 0.01 --grains 200
refuse "--duration" --duration -1
refuse "--frequency" --frequency 0
refuse "--gravity" --gravity -9.81
refuse "--fmax" --fmax -5
refuse "must not exceed --fmax" --fmin 7000
refuse "--wall-mass-ratio" --wall-mass-ratio 0
refuse "--box-ratio" --box-ratio 0
refuse "--tolerance" --tolerance 0
refuse "--tolerance" --tolerance 5
refuse "--margin" --margin 0
refuse "--max-sweeps" --max-sweeps 0
refuse "--grains" --grains 2
refuse "too short for a control volume" --shape disk --grains 9
refuse "--seed" --seed -3
refuse "--shape" --shape cube
refuse "--size-reading" --size-reading diameter
refuse "--stop-test" --stop-test quad
refuse "--threads" --threads 0
refuse "no side walls" --shape disk --width-ratio 2
refuse "no side walls" --shape disk --side-walls periodic
refuse "--from-method" --from-method springs
refuse "not expected" --colour red
touch "$folder/file"
refuse "--output" --output "$folder/file/below" --grains 200
[ ! -e "$folder/refused" ] || fail "a refused run left files"

small=(--shape disk --grains 150 --no-plots)
for name in one two; do
  "$program" "${small[@]}" --duration 0.02 --output "$folder/$name" >"$folder/$name.log" 2>&1 ||
    fail "small run: $(tail -3 "$folder/$name.log")"
done
cmp "$folder/one/wall.csv" "$folder/two/wall.csv" || fail "wall.csv differs from run to run"
[ "$(head -1 "$folder/one/wall.csv")" = "t,f,x,v,f_g" ] || fail "header of wall.csv"
[ "$(wc -l <"$folder/one/wall.csv")" = 101 ] || fail "wall.csv has not a line per step"

# A run from the checkpoint of another one has its own gravity and mass of the wall.
"$program" "${small[@]}" --duration 0.06 --checkpoint-every 300 --output "$folder/start" >"$folder/start.log" 2>&1 ||
  fail "start: $(tail -3 "$folder/start.log")"
again() {
  "$program" "${small[@]}" --from "$folder/start/checkpoint.snapshot" --hold 0.02 --duration 0.04 "${@:2}" \
    --output "$folder/$1" >"$folder/$1.log" 2>&1 || fail "$1: $(tail -3 "$folder/$1.log")"
}
again usual
again heavy --wall-mass-ratio 2
again light --gravity 2
masses=$(sed -n 's/.*"wall_mass": \([0-9.]*\).*/\1/p' "$folder"/{usual,heavy}/run.json | paste -sd ' ')
awk '{exit !($2 > 3.99 * $1 && $2 < 4.01 * $1)}' <<<"$masses" || fail "masses of the wall from a checkpoint: $masses"
for name in heavy light; do
  cmp -s "$folder/usual/wall.csv" "$folder/$name/wall.csv" && fail "$name: nothing changed after --from"
done

# Killed after a checkpoint and taken up again: the same tables as without.
"$program" "${small[@]}" --duration 0.02 --checkpoint-every 7 --output "$folder/killed" \
  >"$folder/killed.log" 2>&1 &
pid=$!
for _ in $(seq 3000); do
  [ -e "$folder/killed/checkpoint.snapshot" ] && break
  sleep 0.01
done
kill -KILL "$pid" 2>/dev/null
wait "$pid" 2>/dev/null
"$program" "${small[@]}" --duration 0.02 --resume --output "$folder/killed" >"$folder/resumed.log" 2>&1 ||
  fail "resumed run: $(tail -3 "$folder/resumed.log")"
grep -q "going on after" "$folder/resumed.log" || fail "nothing was resumed"
for table in wall packing state; do
  cmp "$folder/one/$table.csv" "$folder/killed/$table.csv" || fail "$table.csv of a resumed run"
done
said=$("$program" "${small[@]}" --duration 0.02 --seed 2 --resume --output "$folder/killed" 2>&1)
[ $? = 2 ] || fail "a checkpoint of other parameters was taken up"
grep -qF "other parameters" <<<"$said" || fail "a checkpoint of other parameters: $said"

# A packing that is kept: the run that writes it and the runs that take it up say what one says
# that does not know of it, and a run that would have prepared another refuses it.
for name in writes reads; do
  "$program" "${small[@]}" --duration 0.02 --packing "$folder/packing.snapshot" \
    --output "$folder/$name" >"$folder/$name.log" 2>&1 || fail "$name: $(tail -3 "$folder/$name.log")"
  for table in wall packing state; do
    cmp "$folder/one/$table.csv" "$folder/$name/$table.csv" || fail "$table.csv of a run that $name"
  done
done
grep -q "packing of" "$folder/writes.log" && fail "the run that writes a packing did not prepare"
grep -q "packing of" "$folder/reads.log" || fail "the run that reads a packing prepared"
"$program" "${small[@]}" --duration 0.001 --frequency 20 --gravity 5 --packing "$folder/packing.snapshot" \
  --output "$folder/other" >"$folder/other.log" 2>&1 || fail "another force on a kept packing"
said=$("$program" "${small[@]}" --duration 0.02 --lid-force 20 --packing "$folder/packing.snapshot" \
  --no-plots --output "$folder/other" 2>&1)
[ $? = 2 ] || fail "a packing of other parameters was taken up"
grep -qF "other parameters" <<<"$said" || fail "a packing of other parameters: $said"

"$program" "${small[@]}" --duration 100 --output "$folder/stopped" >"$folder/stopped.log" 2>&1 &
pid=$!
for _ in $(seq 300); do
  [ "$(wc -l 2>/dev/null <"$folder/stopped/wall.csv" || echo 0)" -gt 5 ] && break
  sleep 0.1
done
kill -INT "$pid"
wait "$pid"
status=$?
[ "$status" = 130 ] || fail "an interrupted run ended with status $status"
grep -q '"interrupted": true' "$folder/stopped/run.json" || fail "run.json of an interrupted run"
[ -z "$(tail -c 1 "$folder/stopped/wall.csv")" ] || fail "wall.csv ends within a line"
awk -F, 'NF != 5 {exit 1}' "$folder/stopped/wall.csv" || fail "a broken line in wall.csv"

# Disks that touch nothing keep moving without gravity: the preparation ends all the same.
timeout 60 "$program" --shape disk --grains 100 --fmax 500 --duration 0.002 --preparation-time 0.05 \
  --no-plots --output "$folder/restless" >"$folder/restless.log" 2>&1 || fail "restless run"
grep -q '"settled": false' "$folder/restless/run.json" || fail "restless run.json"
grep -q "still moving" "$folder/restless.log" || fail "restless run says nothing"

"$program" --shape disk --grains 5000 --output "$folder/early" >"$folder/early.log" 2>&1 &
pid=$!
sleep 2
kill -INT "$pid"
wait "$pid"
status=$?
[ "$status" = 130 ] || fail "a run interrupted in the preparation ended with status $status"
grep -q "interrupted before the force started" "$folder/early.log" || fail "early interrupt"
[ -z "$(find "$folder/early" -name '*.png')" ] || fail "an early interrupt left pictures"

[ "$failures" = 0 ] && echo "all passed"
exit "$failures"
