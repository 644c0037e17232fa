#!/bin/sh
# SPDX-License-Identifier: MIT
# refused_flags.sh COMPILER INCLUDE EIGEN: language versions, flags and macros that the library cannot do with end in one
# line of error, which names the reason, and a file that is not found. Prints what differs.
compiler=$1 include=$2 eigen=$3 failed=0
preprocess() { echo '#include <moreau/moreau.hpp>' | "$compiler" $1 -E -o /dev/null "-I$include" -isystem "$eigen" -x c++ - 2>&1; }
refused() { # flag, part of the reason
  output=$(preprocess "$1") && echo "$1 is taken" && failed=1
  echo "$output" | grep -q "error.*$2" || { echo "$1: not said: $2"; failed=1; }
  lines=$(echo "$output" | grep -c 'error: ')
  [ "$lines" -le 2 ] || { echo "$1: $lines lines of error"; failed=1; }
}
preprocess -std=c++20 >/dev/null || { echo "-std=c++20 is refused"; failed=1; }
refused -std=c++17 "moreau needs C++20"
refused "-std=c++20 -ffast-math" "without -ffast-math"
refused "-std=c++20 -ffinite-math-only" "moreau needs infinities"
refused "-std=c++20 -fno-exceptions" "without -fno-exceptions"
refused "-std=c++20 -DEIGEN_DEFAULT_TO_ROW_MAJOR" "without EIGEN_DEFAULT_TO_ROW_MAJOR"
# clang++ has no macro for it.
if ! "$compiler" --version | grep -q clang; then
  refused "-std=c++20 -funsafe-math-optimizations" "without -funsafe-math-optimizations"
  echo '#include <moreau/core/compiler.hpp>' |
    "$compiler" -std=c++20 -fsingle-precision-constant -fsyntax-only "-I$include" -x c++ - 2>&1 |
    grep -q "error.*constants in double precision" || { echo "-fsingle-precision-constant: not said"; failed=1; }
  refused "-std=c++20 -fassociative-math -fno-signed-zeros -fno-trapping-math" "moreau needs sums in the order"
fi
# A second copy of the library, as that of a precompiled header.
copy=$(mktemp -d)
mkdir -p "$copy/moreau/core" && cp "$include/moreau/core/compiler.hpp" "$copy/moreau/core" && touch -d 2020-01-01 "$copy/moreau/core/compiler.hpp"
output=$(printf '#include "%s/moreau/core/compiler.hpp"\n#include <moreau/moreau.hpp>\n' "$copy" |
  "$compiler" -std=c++20 -E -o /dev/null "-I$include" -isystem "$eigen" -x c++ - 2>&1) && echo "a second copy is taken" && failed=1
echo "$output" | grep -q "error.*there are two copies of moreau" || { echo "a second copy: not said"; failed=1; }
[ "$(echo "$output" | grep -c 'error: ')" -le 2 ] || { echo "a second copy: lines of error"; failed=1; }
rm -r "$copy"
exit $failed
