// SPDX-License-Identifier: MIT
// Errors. If a public function gets a bad argument, it throws an exception that names the function,
// the argument and its value. Kernels use assertions (MOREAU_ASSERT). If a solver does not
// converge, no exception is thrown; the solver's report says so.
#pragma once

#include <Eigen/Core>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "moreau/core/compiler.hpp"

/// Assertion in a kernel. It is checked only in builds without NDEBUG. If the macro is defined
/// before the first include, that definition is used.
#ifndef MOREAU_ASSERT
#define MOREAU_ASSERT(condition) assert(condition)
#endif

namespace moreau {

namespace detail {

template <class Value>
void print(std::ostream& out, const Value& value) {
  out << value;
}

/// Prints an Eigen vector, or an object of a class derived from one.
template <class Matrix>
requires requires {
  typename Matrix::PlainMatrix;
}
void print(std::ostream& out, const Matrix& value) {
  const auto& plain = value.eval();
  for (Eigen::Index row = 0; row < plain.rows(); ++row)
    for (Eigen::Index column = 0; column < plain.cols(); ++column)
      out << (row + column > 0 ? ", " : "(") << plain(row, column);
  out << (plain.size() > 0 ? ")" : "()");
}

/// Prints a quaternion.
template <class Quaternion>
requires requires(const Quaternion& q) {
  q.vec();
  q.w();
}
void print(std::ostream& out, const Quaternion& q) {
  out << "(w " << q.w() << ", x " << q.x() << ", y " << q.y() << ", z " << q.z() << ')';
}

/// Prints a rotation of the plane.
template <class Rotation>
requires requires(const Rotation& rotation) {
  rotation.smallestPositiveAngle();
}
void print(std::ostream& out, const Rotation& rotation) {
  out << rotation.angle() << " rad";
}

}  // namespace detail

/// Throws the exception for a bad argument of a public function. Matrices are printed as one row of
/// numbers.
/// @param expectation the requirement on the argument, e.g. "must be finite"
/// @throws std::invalid_argument "function: argument = value must ...", always
template <class Value>
[[noreturn, gnu::cold]] void throw_invalid(std::string_view function, std::string_view argument,
                                           const Value& value, std::string_view expectation) {
  std::ostringstream message;
  message.precision(9);
  message << function << ": " << argument << " = ";
  detail::print(message, value);
  message << ' ' << expectation;
  throw std::invalid_argument(message.str());
}

/// Throws the exception for a velocity or position that is not finite.
/// @param what  the quantity, e.g. "velocity of body"
/// @param index index of the body
/// @throws std::runtime_error "function: what index = value is not finite", always
template <class Value>
[[noreturn, gnu::cold]] void throw_not_finite(std::string_view function, std::string_view what,
                                              std::size_t index, const Value& value) {
  std::ostringstream message;
  message.precision(9);
  message << function << ": " << what << ' ' << index << " = ";
  detail::print(message, value);
  message << " is not finite";
  throw std::runtime_error(message.str());
}

/// Checks an argument of a public function.
/// @param condition   the condition that must hold
/// @param function    the public function that the caller of the library called, e.g. "Polyhedron"
/// @param argument    name of the argument, e.g. "vertices[3]"
/// @param value       value of the argument; formatted only on failure
/// @param expectation the requirement on the argument, e.g. "must be finite"
/// @throws std::invalid_argument with all of these if the condition does not hold
template <class Value>
void require(bool condition, std::string_view function, std::string_view argument,
             const Value& value, std::string_view expectation) {
  if (!condition) throw_invalid(function, argument, value, expectation);
}

/// Checks that a number of a public function is finite and > 0; arguments as of require().
/// @throws std::invalid_argument "function: argument = value must be finite and > 0"
template <class T>
void require_positive(T value, std::string_view function, std::string_view argument) {
  require(std::isfinite(value) && value > T(0), function, argument, value,
          "must be finite and > 0");
}

}  // namespace moreau
