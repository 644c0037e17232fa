#!/bin/bash
# SPDX-License-Identifier: MIT
# killed.sh PROGRAM MPIEXEC...: kills one process of the example in the middle of a run. What it had written
# is whole, and the run goes on from there with another number of processes.
set -euo pipefail
program=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$@" -n 2 "$program" 60 100000 "$folder" >"$folder/first.log" 2>&1 &
run=$!
for ((k = 0; k < 600; ++k)); do
  [[ $(wc -l <"$folder/first.log") -ge 3 ]] && break
  sleep 0.1
done
# The processes of the program are children of the launcher.
victim=$(pgrep -P "$run" | tail -n 1)
kill -KILL "$victim"
if wait "$run"; then
  echo "the run ended well although a process was killed"
  exit 1
fi

"$@" -n 3 "$program" 60 100 "$folder" >"$folder/second.log"
cat "$folder/second.log"
# At least two hundred steps were made before, one hundred since.
awk '/^t = / { if ($3 >= 0.06 - 1e-9) good = 1 } END { exit !good }' "$folder/second.log"
echo "the run went on"
