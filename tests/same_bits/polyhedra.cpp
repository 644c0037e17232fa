// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"

#include "same_bits/worlds.hpp"

using namespace same_bits;

TEST_CASE("polyhedra: Coulomb") {
  check<Polyhedron<>>(SignoriniCoulomb<>(0.4));
}
TEST_CASE("polyhedra: springs") {
  check<Polyhedron<>>(Compliant<>(SignoriniCoulomb<>(0.4, 0.3), 1e6));
}
TEST_CASE("polyhedra: an attraction of one's own") {
  check<Polyhedron<>>(Decaying<double>(0.4, 0.5, 1e-3));
}
