// SPDX-License-Identifier: MIT
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"

#include "same_bits/worlds.hpp"

using namespace same_bits;

TEST_CASE("polygons: Coulomb") {
  check<Polygon<>>(SignoriniCoulomb<>(0.4, 0.2));
}
TEST_CASE("polygons: springs under an attraction of one's own") {
  check<Polygon<>>(Compliant<Decaying<double>>(Decaying<double>(0.4, 0.5, 1e-3), 1e6));
}
TEST_CASE("balls: rolling") {
  check<Ball<>>(RollingResistance<>(0.4, 0.05), 60);
}
