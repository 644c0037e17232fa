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
grep -q "^continuing from t = 0\\.[0-9]* s of $folder/packing.snapshot$" "$folder/second.log"
echo "the run went on"

# The series has one index per frame, and each index names pieces that exist; none is left of frames that were lost.
python3 - "$folder" <<'EOF'
import glob, os, re, sys
folder = sys.argv[1]
for part in ("grains", "contacts"):
    with open(f"{folder}/{part}.pvd") as file:
        frames = re.findall(r'file="([^"]*)"', file.read())
    there = {os.path.basename(name) for name in glob.glob(f"{folder}/packing_*_{part}.pvtp")}
    assert len(frames) == len(set(frames)) and set(frames) == there, (frames, there)
    for frame in frames:
        with open(f"{folder}/{frame}") as file:
            pieces = re.findall(r'Source="([^"]*)"', file.read())
        assert pieces and all(os.path.exists(f"{folder}/{piece}") for piece in pieces), frame
EOF

# refuse "part of the message" ARGUMENT...
refuse() {
  wanted=$1
  shift
  if said=$("$program" "$@" 2>&1); then
    echo "not refused: $*" && exit 1
  fi
  grep -qF -e "$wanted" <<<"$said" || { echo "$* said: $said" && exit 1; }
}
refuse "GRAINS is '20x'" 20x
refuse "STEPS is '0'" 20 0
refuse "has 60 grains, not 61" 61 1 "$folder"
refuse "$folder/none" 60 1 "$folder/other" "$folder/none"
refuse "usage" 1 1 a b c
