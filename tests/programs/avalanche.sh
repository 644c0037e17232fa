#!/bin/bash
# SPDX-License-Identifier: MIT
# The avalanche as a program: a run that is killed goes on with the same bits; wrong arguments are
# refused with status 2. Argument: the executable.
set -u
program=$1
source "$(dirname "$0")/failures.sh"

for arguments in "--shape cube --grains 500" "--shape disk --grains 5" "--shape disk --grain 500" "--shape disk --grains" \
  "--shape disk --grains many" "--shape disk --grains -5" "--shape disk --grains 300x" "--shape disk --grains 300 --minutes nan" \
  "--shape disk --grains 300 --threads 0"; do
  "$program" $arguments --output "$folder/refused" >"$folder/said" 2>&1
  [ $? = 2 ] || fail "$arguments: $(cat "$folder/said")"
done

run() { "$program" --shape "$1" --grains 300 --output "$folder/$2" "${@:3}" >>"$folder/$2.log" 2>&1; }
for shape in disk sphere; do
  run $shape "$shape-whole" || fail "$shape: $(cat "$folder/$shape-whole.log")"
  # Stopped soon, then killed in the middle, with a snapshot after every step, then to the end.
  run $shape "$shape-killed" --minutes 0.003
  [ $? = 3 ] || fail "$shape: did not stop"
  "$program" --shape "$shape" --grains 300 --output "$folder/$shape-killed" --snapshot 0.01 --threads 2 \
    >>"$folder/$shape-killed.log" 2>&1 &
  sleep 0.5
  kill -KILL $! 2>/dev/null
  wait $! 2>/dev/null
  run $shape "$shape-killed" || fail "$shape: $(cat "$folder/$shape-killed.log")"
  grep -q "continues at step" "$folder/$shape-killed.log" || fail "$shape: began anew"
  for file in avalanche.csv avalanche.snapshot; do
    cmp "$folder/$shape-whole/$file" "$folder/$shape-killed/$file" || fail "$shape: other bits in $file"
  done
done
[ "$failures" = 0 ] && echo "all passed"
exit "$failures"
