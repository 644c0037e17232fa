#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian), builds the avalanche, and runs it:
#
#   run.sh --shape sphere --grains 100000 --threads 2
#
# A run that was stopped or killed continues with the same command. All options: run.sh --help
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
"$top/.ci/require" g++ libeigen3-dev libcli11-dev libpng-dev
program=$top/build/avalanche
mkdir -p "$top/build"
# Compiled again only if a source is newer. Takes two to three minutes.
if [ ! -x "$program" ] ||
  [ -n "$(find "$here" "$top/include" -name '*.[ch]pp' -newer "$program" -print -quit)" ]; then
  echo "building $program"
  g++ -std=c++20 -O3 -march=native -DNDEBUG -pthread -I"$top/include" -isystem /usr/include/eigen3 \
    "$here/main.cpp" -lpng -o "$program"
fi
"$program" "$@"
