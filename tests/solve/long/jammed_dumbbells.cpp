// SPDX-License-Identifier: MIT
// Dumbbells that jam in a box while they come to rest, under laws with a tangential restitution. The lifts of the direct
// method (solve/island_newton.hpp) change there by a factor of 0.9 to 1.2 per proximal step, and sweeps that meet their
// tolerance are too far from the solution: the method fails until further sweeps have led nearer to it.
#include <doctest/doctest.h>
#include <type_traits>

#include "moreau/law/bridges.hpp"
#include "moreau/law/tangential_restitution.hpp"

#include "conformance/world.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<2>;
using Impacts = moreau::TangentialRestitution<>;

/// Steps that are not solved, of 750 for each of eight values of the friction.
int count_unsolved(const auto& law_of) {
  int unsolved = 0;
  matrix::dumbbells<S>([&](const auto& shapes, double size) {
    using Shape = typename std::decay_t<decltype(shapes)>::value_type;
    for (int k = 0; k < 8; ++k) {
      const auto law = law_of(Impacts(0.3 + 0.02 * k, 0.8, 0.4));
      conformance::Assembly<conformance::Defaults, Shape, std::decay_t<decltype(law)>> grains(
          shapes, law, size);
      grains.add_box();
      for (int step = 0; step < 750; ++step)
        unsolved += !grains.simulation.step(2e-4).solve.converged;
    }
  });
  return unsolved;
}

constexpr int steps = 6000, most = steps / 1000;

}  // namespace

TEST_CASE("dumbbells that jam are solved in all but one step of a thousand") {
  CHECK(count_unsolved([](const Impacts& law) { return law; }) <= most);
}
TEST_CASE(
    "dumbbells that jam and attract each other are solved in all but one step of a thousand") {
  using Bridge = moreau::LinearCohesion<>;
  CHECK(count_unsolved([](const Impacts& law) {
          return moreau::Bridged<Bridge, Impacts>(Bridge(1e-4, 1e-4), law);
        }) <= most);
}
