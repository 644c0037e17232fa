// SPDX-License-Identifier: MIT
// The conformance suite of the library's policies, applied to the policies of the examples.
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"

#include "../../../examples/own_integrator/symplectic_euler.hpp"
#include "../../../examples/own_law/greased.hpp"
#include "../../../examples/own_law/rubber.hpp"
#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

TEST_CASE("the greased faces of own_law") {
  conformance::world(scenes::cuboid<Polygon<>>({0.003, 0.0025}), Greased{1e-3}, 0.009);
}
TEST_CASE("the rubber of own_law") {
  // The springs are stiff enough for a drop of a centimetre. The mass is 2e-3 kg for a ball and
  // 0.08 kg/m for a disk.
  conformance::world(moreau::Ball<>(0.005), Rubber{2e4, 1e-4, 0.5, 1, 0.4}, 0.01);
  conformance::world(Disk<double>(0.005), Rubber{3e6, 1e-4, 100, 50, 0.4}, 0.01);
}
TEST_CASE("symplectic Euler of own_integrator") {
  using Choice = conformance::With<SymplecticEuler>;
  conformance::world<Choice>(Disk<double>(0.005), conformance::stiff_springs(0.08), 0.01);
  conformance::world<Choice>(moreau::Ball<>(0.005), conformance::stiff_springs(5e-4), 0.01);
}
