#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program and runs it. Without arguments it runs a small
# case: 120 polyhedra, with the wall's force scaled to the weight of the sample. Arguments replace
# those of the small case; the program's defaults are the full case. --help builds nothing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
case " $* " in *" --help "* | *" -h "*) exec cat "$here/help.txt" ;; esac
"$top/.ci/require" g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev libpng-dev
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
# Builds only the shapes and methods that were asked for, now or before: each takes as long again.
# wanted OPTION DEFAULT VARIABLE ARGUMENTS: the values of the option, with those of the last build
wanted() {
  local option=$1 default=$2 variable=$3 value known && shift 3
  value=$(printf '%s\n' "$@" | sed -n "s/^$option=//p; /^$option\$/{n;p}" | tail -n 1)
  known=$(sed -n "s/^$variable:[^=]*=//p" "$top/build/study/CMakeCache.txt" 2>/dev/null || true)
  printf '%s\n' ${known//;/ } "${value:-$default}" | tr - _ | sort -u | paste -sd ';'
}
shapes=$(wanted --shape polyhedron RATCHETING_SHAPES "$@")
methods=$(wanted --method contact-dynamics RATCHETING_METHODS "$@")
cmake -S "$top" -B "$top/build/study" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOREAU_NATIVE=ON \
  -DMOREAU_BUILD_TESTS=OFF -DMOREAU_BUILD_BENCHES=OFF "-DRATCHETING_SHAPES=$shapes" "-DRATCHETING_METHODS=$methods" >/dev/null
echo "building ratcheting in $top/build/study"
cmake --build "$top/build/study" --target ratcheting
[ $# -gt 0 ] || set -- --grains 120 --fmax 600
echo "ratcheting $*"
exec "$top/build/study/examples/ratcheting" "$@"
