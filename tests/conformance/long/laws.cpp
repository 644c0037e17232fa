// SPDX-License-Identifier: MIT
// Simulations under pairs of a wrapper and a law (tests/static/laws.cpp) that the suites of every shape in space
// (tests/matrix) and of the cell (cell.cpp) leave out; in the plane tests/matrix/plane_pairs.cpp has every shape under them.
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/ball.hpp"

#include "conformance/world.hpp"

using namespace moreau;

namespace {

using Smooth = Frictionless<>;
using Rolling = RollingResistance<>;
using Water = CapillaryBridge<>;
using Linear = LinearCohesion<>;

const Rolling rolling(0.4, 0.1);
const Water water(1e-12);
const Linear falling(1e-4, 1e-4);
const Disk<> disk(0.005);
const Ball<> ball(0.005);
constexpr double size = 0.01, stiffness = 1e6;  // [m], [N/m]

template <class Law>
Compliant<Law> with_springs(const Law& law) {
  return Compliant<Law>(law, stiffness, stiffness / 2);
}

}  // namespace

TEST_CASE("bridges of grains without friction") {
  conformance::world(disk, Bridged<Linear, Smooth>(falling), size);
}
TEST_CASE("bridges of grains that resist rolling") {
  conformance::world(ball, Bridged<Water, Rolling>(water, rolling), size);
}
TEST_CASE("springs and cohesion of grains without friction") {
  conformance::world(ball, with_springs(Cohesive<Smooth>(Smooth(), 1e-3)), size);
}
TEST_CASE("springs and cohesion of grains that resist rolling") {
  conformance::world(disk, with_springs(Cohesive<Rolling>(rolling, 1e-3)), size);
}
TEST_CASE("springs and bridges of grains without friction") {
  conformance::world(disk, with_springs(Bridged<Water, Smooth>(water)), size);
}
