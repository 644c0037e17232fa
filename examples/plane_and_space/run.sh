#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the program, runs it and plots the result:
#
#   run.sh [folder] [grains in the plane] [grains in space] [samples]
#
# Writes plane_and_space.csv and plane_and_space.png into the folder (plane_and_space-output). A run
# that was stopped continues with the first sample that is not finished. With the default sizes it
# takes seven minutes of CPU time, after building.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
if [[ ${1:-} == -* ]]; then
  echo "usage: run.sh [folder] [grains in the plane] [grains in space] [samples]" >&2
  exit 2
fi
folder=${1:-plane_and_space-output} plane=${2:-120} space=${3:-480} samples=${4:-3}
"$top/.ci/require" g++ libeigen3-dev
command -v gnuplot >/dev/null || "$top/.ci/require" gnuplot-nox
program=$top/build/plane_and_space
mkdir -p "$top/build" "$folder"
echo "building $program"
# Compiled again only if a source is newer.
if [ ! -x "$program" ] ||
  [ -n "$(find "$here" "$top/include" -name '*.[ch]pp' -newer "$program" -print -quit)" ]; then
  g++ -std=c++20 -O3 -march=native -DNDEBUG -I"$top/include" -isystem /usr/include/eigen3 \
    "$here/plane_and_space.cpp" -o "$program"
fi
"$program" "$folder" "$plane" "$space" "$samples"
cd "$folder"
gnuplot "$here/plane_and_space.gp"
echo "plotted $folder/plane_and_space.png"
