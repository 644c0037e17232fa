#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs the program: ./build.sh [options of cmake, e.g. -DMOREAU=<folder>]
set -e
cd "$(dirname "$0")"
cmake -S . -B build "$@" >/dev/null
cmake --build build --parallel "$(nproc)"
build/my_program
