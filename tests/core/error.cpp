// SPDX-License-Identifier: MIT
#include "moreau/core/error.hpp"

#include <Eigen/Core>

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

template <class Value>
std::string message_of(const Value& value) {
  try {
    moreau::require(false, "Polyhedron", "vertices[3]", value, "must be finite");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST_CASE("require names function, argument, value and expectation") {
  CHECK(message_of(-2.5) == "Polyhedron: vertices[3] = -2.5 must be finite");
  CHECK(message_of(7) == "Polyhedron: vertices[3] = 7 must be finite");
  CHECK(message_of(std::string("ball")) == "Polyhedron: vertices[3] = ball must be finite");
  CHECK(message_of(std::nan("")) == "Polyhedron: vertices[3] = nan must be finite");
}

TEST_CASE("a vector is printed on one line, whichever way it stands") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(message_of(Eigen::Vector3d(1, inf, 3)) ==
        "Polyhedron: vertices[3] = (1, inf, 3) must be finite");
  CHECK(message_of(Eigen::RowVector2f(0.5F, -1)) ==
        "Polyhedron: vertices[3] = (0.5, -1) must be finite");
}

TEST_CASE("nine digits tell apart what a float can hold") {
  CHECK(message_of(0.123456789) == "Polyhedron: vertices[3] = 0.123456789 must be finite");
  CHECK(message_of(1e-12) == "Polyhedron: vertices[3] = 1e-12 must be finite");
}

TEST_CASE("a condition that holds does not throw") {
  CHECK_NOTHROW(moreau::require(true, "Ball", "radius", 1.0, "must be positive"));
}

}  // namespace
