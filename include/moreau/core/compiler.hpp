// SPDX-License-Identifier: MIT
// One line for a compiler, a language version or a flag that cannot compile the library, in place of
// hundreds: the file that does not exist ends the compilation. Include it before everything else.
#pragma once

#if !defined(__GNUC__) && !defined(__clang__)
#error "moreau needs the vector extensions of g++ 12 or clang++ 14, or a later version of them."
#include "moreau needs g++ or clang++"
#elif __cplusplus < 202002L
#error "moreau needs C++20: compile with -std=c++20 or later."
#include "moreau needs C++20"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "moreau needs infinities and checks for NaN: compile without -ffast-math and -Ofast."
#include "moreau needs infinities"
#endif
