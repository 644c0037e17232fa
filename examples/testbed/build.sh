#!/bin/bash
# SPDX-License-Identifier: MIT
# Builds the page of the testbed into a folder (default: build/testbed/page) that any file server serves:
#
#   examples/testbed/build.sh [folder]
#
# Installs what is missing (Debian: emscripten, libeigen3-dev; npm: what web/package.json pins). Takes about
# five minutes the first time. CXXFLAGS are added to those of the compiler.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) && top=$(cd "$here/../.." && pwd)
work=$top/build/testbed
page=$(mkdir -p "${1:-$work/page}" && cd "${1:-$work/page}" && pwd)
command -v emcc >/dev/null || "$top/.ci/require" emscripten libeigen3-dev
[ -d /usr/include/eigen3 ] || "$top/.ci/require" libeigen3-dev
command -v npm >/dev/null || "$top/.ci/require" npm

# WebAssembly without the JavaScript of emscripten: web/program.js has the few functions that it imports.
flags=(-std=c++20 -O3 -fwasm-exceptions -DNDEBUG -I"$top/include" -isystem /usr/include/eigen3)
read -ra more <<<"${CXXFLAGS:-}"
flags+=("${more[@]}")
mkdir -p "$work/objects"
objects=()
if [ "$(cat "$work/objects/flags" 2>/dev/null)" != "${flags[*]}" ]; then rm -f "$work"/objects/*; fi
echo "${flags[*]}" >"$work/objects/flags"
for source in "$here"/{make_scene,scenes_in_plane,scenes_in_space,web/exports}.cpp; do
  object=$work/objects/$(basename "$source" .cpp).o
  objects+=("$object")
  # Compiled again only if a source is newer.
  if [ ! -e "$object" ] || [ -n "$(find "$here" "$top/include" -name '*.[ch]pp' -newer "$object" -print -quit)" ]; then
    echo "compiling $(basename "$source")"
    emcc "${flags[@]}" -c "$source" -o "$object"
  fi
done
emcc "${flags[@]}" "${objects[@]}" --no-entry -sSTANDALONE_WASM -sINITIAL_MEMORY=64MB -sALLOW_MEMORY_GROWTH \
  -sMAXIMUM_MEMORY=1GB -sTOTAL_STACK=1MB -o "$page/testbed.wasm"

# The packages live outside the sources. Without network, an earlier installation is used.
mkdir -p "$work/web"
cp "$here"/web/*.{js,mjs,html,css,json} "$work/web/"
cd "$work/web"
cmp -s package.json node_modules/.installed || {
  echo "installing the packages of web/package.json"
  npm install --no-package-lock --no-audit --no-fund --loglevel=error
  cp package.json node_modules/.installed
}
npx esbuild main.js worker.js --bundle --minify --format=esm --outdir="$page" --log-level=warning
cp index.html "$page/"
# States from which the scenes in space begin. They belong to this testbed.wasm; one process for each shape.
if [ "$page/testbed.wasm" -nt "$page/packed/box-ball.state" ]; then
  echo "letting the scenes in space settle"
  printf '%s\n' {box,column,drum}-{polyhedron,ball} |
    xargs -P "$(nproc)" -n 1 node pack.mjs "$page/testbed.wasm" "$page/packed"
fi
du -bc "$page"/testbed.wasm "$page"/*.{js,css,html} "$page"/packed/* | awk '{ printf "%8.0f kB %s\n", $1 / 1000, $2 }'
echo "built $page; examples/testbed/serve.sh serves it"
