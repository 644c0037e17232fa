// SPDX-License-Identifier: MIT
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "same_bits/worlds.hpp"

using namespace same_bits;

TEST_CASE("balls: Coulomb") {
  check<Ball<>>(SignoriniCoulomb<>(0.4));
}
TEST_CASE("polyhedra in single precision: Coulomb") {
  check<Polyhedron<float>>(SignoriniCoulomb<float>(0.4f));
}
TEST_CASE("polyhedra in single precision: springs") {
  check<Polyhedron<float>>(Compliant<SignoriniCoulomb<float>>(SignoriniCoulomb<float>(0.4f), 1e6f));
}
