#!/bin/bash
# SPDX-License-Identifier: MIT
# The page of the testbed: builds it and drives it in Chromium without a window (testbed.mjs). Status 77, with a
# word, where what it needs is missing. Arguments: the folder of the project [minutes of the memory test].
set -euo pipefail
top=$1 minutes=${2:-0.3}
programs=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "skipped: $1"
  exit 77
}
for program in emcc node npm; do
  command -v $program >/dev/null || skip "$program is not installed (Debian: emscripten, npm)"
done
# The program itself: Debian's wrapper shows its own messages.
chromium=""
for path in /usr/lib/chromium/chromium "$(command -v chromium || true)" "$(command -v google-chrome || true)"; do
  [ -x "$path" ] && chromium=$path && break
done
[ -n "$chromium" ] || skip "Chromium is not installed (Debian: chromium)"

work=$top/build/testbed
if ! "$top/examples/testbed/build.sh"; then
  [ -e "$work/web/node_modules/.installed" ] || skip "the packages of web/package.json could not be installed"
  exit 1
fi

# Random numbers of the C++ standard library differ between its vendors: the native program that has the same
# sample as the page is built with the library of emscripten, libc++.
native=""
for compiler in clang++-19 clang++; do
  command -v $compiler >/dev/null || continue
  echo 'int main() {}' | $compiler -stdlib=libc++ -x c++ - -o "$work/empty" 2>/dev/null || continue
  native=$work/native
  if [ ! -x "$native" ] ||
    [ -n "$(find "$top/examples/testbed" "$top/include" -name '*.[ch]pp' -newer "$native" -print -quit)" ]; then
    echo "compiling the native program with $compiler and libc++"
    $compiler -stdlib=libc++ -std=c++20 -O3 -DNDEBUG -I"$top/include" -isystem /usr/include/eigen3 \
      "$top"/examples/testbed/*.cpp -o "$native"
  fi
  break
done
[ -n "$native" ] || echo "no clang++ with libc++: positions of the wall are not compared with a native run"

cp "$programs/testbed.mjs" "$work/web/"
exec node "$work/web/testbed.mjs" "$work/page" "$chromium" "$minutes" "$native"
