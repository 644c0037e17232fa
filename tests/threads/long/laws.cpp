// SPDX-License-Identifier: MIT
// The number of threads has no influence on the results, under any law and for any shape.
#include <doctest/doctest.h>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "threads/same_bits.hpp"

using namespace threads_test;

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads: other shapes", ShapeT, Ball<double>,
                   Polygon<double>) {
  check_bits<ShapeT>(SignoriniCoulomb<>(0.4));
}

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads: every law", ShapeT, Disk<double>,
                   Polyhedron<double>) {
  check_bits<ShapeT>(Frictionless<>(0.2));
  check_bits<ShapeT>(SignoriniCoulomb<>(0.4, 0.1, 0.5));
  check_bits<ShapeT>(Cohesive<SignoriniCoulomb<>>(SignoriniCoulomb<>(0.4), 0.5, 1e-4));
  check_bits<ShapeT>(RollingResistance<>(0.4, 0.05));
  check_bits<ShapeT>(LinearSpringDashpot<>(1e3));
}
