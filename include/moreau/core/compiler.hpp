// SPDX-License-Identifier: MIT
// One line for a compiler, a language version, a flag or a second copy that cannot compile with the library, in place of
// hundreds: the file that does not exist ends the compilation. Include it before everything else.
#pragma once

#ifdef MOREAU_IS_INCLUDED  // #pragma once leaves out the same file alone
#error \
    "there are two copies of moreau: a precompiled header (.gch, .pch) of another copy, or from before a change, or two include paths. Make the precompiled header anew, or remove one path."
#include "moreau needs one copy of itself"
#endif
#define MOREAU_IS_INCLUDED

#if !defined(__GNUC__) && !defined(__clang__)
#error "moreau needs the vector extensions of g++ 12 or clang++ 14, or a later version of them."
#include "moreau needs g++ or clang++"
#elif __cplusplus < 202002L
#error "moreau needs C++20: compile with -std=c++20 or later."
#include "moreau needs C++20"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "moreau needs infinities and checks for NaN: compile without -ffast-math and -Ofast."
#include "moreau needs infinities"
#elif defined(__ASSOCIATIVE_MATH__)  // g++; clang++ does not tell
#error \
    "moreau needs sums in the order in which they stand: compile without -funsafe-math-optimizations and -fassociative-math."
#include "moreau needs sums in their order"
#elif !defined(__cpp_exceptions)
#error "moreau throws exceptions: compile without -fno-exceptions."
#include "moreau needs exceptions"
#elif defined(EIGEN_DEFAULT_TO_ROW_MAJOR)
#error "moreau needs matrices by columns: compile without EIGEN_DEFAULT_TO_ROW_MAJOR."
#include "moreau needs matrices by columns"
#endif

static_assert(
    0.1 != double(0.1f),
    "moreau needs constants in double precision: compile without -fsingle-precision-constant.");
