// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <vector>

#include "contact_dynamics_vs_springs/press.hpp"

namespace {

/// The Kolmogorov distance: the largest difference of two cumulative distributions.
double distance(const moreau::ForceDistribution<double>& a,
                const moreau::ForceDistribution<double>& b) {
  double sum = 0, most = 0;
  for (std::size_t k = 0; k < a.density.size(); ++k) {
    sum += a.width * (a.density[k] - b.density[k]);
    most = std::max(most, std::abs(sum));
  }
  return most;
}

}  // namespace

// With increasing stiffness, a packing of grains on springs tends to the packing of contact
// dynamics. The position of the wall, the solid fraction away from the walls and the force
// distribution are compared, as means over several packings. A single packing may end in another
// state than the rigid packing, because rigid grains with friction have many states of equilibrium.
TEST_CASE("springs tend to contact dynamics as they stiffen") {
  constexpr int samples = 4;
  std::vector<double> wall, solid, forces;
  std::vector<press::State> packings;
  std::vector<press::Outcome> rigid;
  for (int sample = 1; sample <= samples; ++sample) {
    packings.push_back(press::packed(100, 1, std::uint64_t(sample)));
    rigid.push_back(settle(packings.back(), press::Coulomb(press::friction), 1e-3));
  }
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8}) {
    const auto [law, step] = press::springs_of(stiffness);
    double w = 0, s = 0, f = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      const press::Outcome soft = settle(packings[k], law, step);
      w += std::abs(soft.lid - rigid[k].lid) / press::size / samples;
      s += std::abs(soft.solid - rigid[k].solid) / samples;
      f += distance(soft.forces, rigid[k].forces) / samples;
    }
    MESSAGE(stiffness << " N/m: lid off by " << w << " d, solid fraction by " << s << ", forces by "
                      << f);
    wall.push_back(w);
    solid.push_back(s);
    forces.push_back(f);
  }
  // Each factor of ten in the stiffness reduces the differences, until they are those between two
  // states of equilibrium.
  for (std::size_t k = 1; k < 3; ++k) {
    CHECK(wall[k] < 0.5 * wall[k - 1]);
    CHECK(solid[k] < 0.5 * solid[k - 1]);
    CHECK(forces[k] < forces[k - 1]);
  }
  CHECK(wall[3] < 0.03);
  CHECK(solid[3] < 3e-3);
  CHECK(forces[3] < 0.1);
}
