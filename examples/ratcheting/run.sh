#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the study and runs it. Without arguments a small case: 120
# polyhedra, the wall's force scaled with the sample's weight. With arguments they alone go to the
# program, whose defaults are the full case.
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
packages=(g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev gnuplot-nox)
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  root=$([ "$(id -u)" -eq 0 ] || echo sudo)
  $root apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $root apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi
# Only the shapes that were asked for, now or before: the others would double the time.
shapes=$(printf '%s\n' "$@" | sed -n 's/^--shape=//p; /^--shape$/{n;p}' | tail -n 1)
known=$(sed -n 's/^RATCHETING_SHAPES:[^=]*=//p' "$top/build/study/CMakeCache.txt" 2>/dev/null || true)
shapes=$(printf '%s\n' ${known//;/ } "${shapes:-polyhedron}" | sort -u | paste -sd ';')
cmake -S "$top" -B "$top/build/study" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF "-DRATCHETING_SHAPES=$shapes" >/dev/null
echo "building the study in $top/build/study"
cmake --build "$top/build/study" --target ratcheting
[ $# -gt 0 ] || set -- --grains 120 --fmax 600
echo "ratcheting $*"
exec "$top/build/study/examples/ratcheting" "$@"
