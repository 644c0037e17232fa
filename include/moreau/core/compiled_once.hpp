// SPDX-License-Identifier: MIT
// Results that two ways of working must share to the last bit. With a CPU that has fused operations a
// compiler may round a b + c d in several ways: it fuses one of the products with the sum, or none. g++ decides
// anew at every place where it inlines or copies a function, in the bulk of a loop that it has vectorized and in
// what is left of it. So arithmetic that several ways of working run, as one thread and several, stands in one
// function that is compiled once.
#pragma once

#include <cstddef>

#include "moreau/core/compiler.hpp"

/// Before a function: all calls run the same machine code. It is neither inlined nor copied for arguments
/// that a caller knows.
#if defined(__clang__)
#define MOREAU_COMPILED_ONCE [[gnu::noinline]]
#elif defined(__GNUC__)
#define MOREAU_COMPILED_ONCE [[gnu::noinline, gnu::noclone]]
#else
#define MOREAU_COMPILED_ONCE
#endif

/// Before a function of files, of set-up before a long loop, or one that throws: it is compiled for size and not
/// inlined, which takes the compiler a fraction of the time.
#if defined(__GNUC__) || defined(__clang__)
#define MOREAU_COLD [[gnu::cold, gnu::noinline]]
#else
#define MOREAU_COLD
#endif

/// Before a function that is called from one place, or is about as small as a call: it is inlined. g++ does not
/// inline it by itself in code that it believes is cold, and has one more function to compile: templates and members
/// of a class may be called from other files as well.
#if defined(__GNUC__) || defined(__clang__)
#define MOREAU_INLINED [[gnu::always_inline]]
/// The same after the parameters of a lambda.
#define MOREAU_INLINED_LAMBDA __attribute__((always_inline))
#else
#define MOREAU_INLINED
#define MOREAU_INLINED_LAMBDA
#endif

namespace moreau::detail {

/// The same pointer. The compiler does not know where it points: it cannot inline or copy that function.
template <class Function>
Function* unknown(Function* function) {
#if defined(__GNUC__)
  asm volatile("" : "+r"(function));
#endif
  return function;
}

/// add(sum, i), compiled once.
template <class Add, class Sum>
MOREAU_COMPILED_ONCE void call(const Add& add, Sum& sum, std::size_t i) {
  add(sum, i);
}

}  // namespace moreau::detail
