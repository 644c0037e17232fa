// SPDX-License-Identifier: MIT
// Errors of the public functions: a bad argument throws an exception that names the function, the
// argument and its value. Kernels assert (MOREAU_ASSERT). A solver that does not converge throws
// nothing: its report says so.
#pragma once

#include <Eigen/Core>

#include <cassert>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

/// Check in a kernel, in builds without NDEBUG. A definition of this macro before the first include
/// replaces it.
#ifndef MOREAU_ASSERT
#define MOREAU_ASSERT(condition) assert(condition)
#endif

namespace moreau {

namespace detail {

template <class Value>
void print(std::ostream& out, const Value& value) {
  out << value;
}

/// An Eigen vector, or a class derived from one.
template <class Matrix>
requires requires {
  typename Matrix::PlainMatrix;
}
void print(std::ostream& out, const Matrix& value) {
  static const Eigen::IOFormat row(9, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  out << value.format(row);
}

}  // namespace detail

/// Throws for a bad argument of a public function. Matrices are printed as one row of their
/// numbers.
/// @param expectation what it must be, e.g. "must be finite"
/// @throws std::invalid_argument "function: argument = value must ...", always
template <class Value>
[[noreturn]] void throw_invalid(std::string_view function, std::string_view argument,
                                const Value& value, std::string_view expectation) {
  std::ostringstream message;
  message.precision(9);
  message << function << ": " << argument << " = ";
  detail::print(message, value);
  message << ' ' << expectation;
  throw std::invalid_argument(message.str());
}

/// Reports a velocity or a position that is not finite.
/// @param what  e.g. "velocity of body"
/// @param index of the body
/// @throws std::runtime_error "function: what index = value is not finite", always
template <class Value>
[[noreturn]] void throw_not_finite(std::string_view function, std::string_view what,
                                   std::size_t index, const Value& value) {
  std::ostringstream message;
  message.precision(9);
  message << function << ": " << what << ' ' << index << " = ";
  detail::print(message, value);
  message << " is not finite";
  throw std::runtime_error(message.str());
}

/// Checks an argument of a public function.
/// @param condition   what has to hold
/// @param function    the public name the caller used, e.g. "Polyhedron"
/// @param argument    the name of the argument, e.g. "vertices[3]"
/// @param value       its value; formatted only on failure
/// @param expectation what it must be, e.g. "must be finite"
/// @throws std::invalid_argument naming all of them if the condition does not hold
template <class Value>
void require(bool condition, std::string_view function, std::string_view argument,
             const Value& value, std::string_view expectation) {
  if (!condition) throw_invalid(function, argument, value, expectation);
}

}  // namespace moreau
