// SPDX-License-Identifier: MIT
// One line for a compiler or a language version that cannot compile the library, in place of
// hundreds. Include it before everything else.
#pragma once

#if !defined(__GNUC__) && !defined(__clang__)
#error "moreau needs the vector extensions of g++ 12 or clang++ 14, or a later version of them."
#elif __cplusplus < 202002L
#error "moreau needs C++20: compile with -std=c++20 or later."
#endif
