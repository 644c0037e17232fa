// SPDX-License-Identifier: MIT
// Springs of rising stiffness come to the packing of contact dynamics: the wall, the solid fraction
// and the distribution of forces, each closer than with springs a tenth as stiff.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

#include "contact_dynamics_vs_springs/press.hpp"

namespace {

/// Largest distance between two cumulated distributions (Kolmogorov's).
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

TEST_CASE("springs tend to contact dynamics as they stiffen") {
  const press::State packing = press::packed(100, 1);
  const press::Outcome rigid = settle(packing, press::Coulomb(press::friction), 1e-3);
  double wall = 1, solid = 1, forces = 1;
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8}) {
    const auto [law, step] = press::springs_of(stiffness);
    const press::Outcome soft = settle(packing, law, step);
    CAPTURE(stiffness);
    CHECK(std::abs(soft.lid - rigid.lid) < wall);
    CHECK(std::abs(soft.solid - rigid.solid) < solid);
    CHECK(distance(soft.forces, rigid.forces) < forces);
    forces = distance(soft.forces, rigid.forces);
    wall = std::abs(soft.lid - rigid.lid);
    solid = std::abs(soft.solid - rigid.solid);
    MESSAGE(stiffness << " N/m: lid off by " << 1e3 * wall << " mm, solid fraction by " << solid
                      << ", forces by " << forces);
    if (stiffness == 1e8) {
      CHECK(wall < 1e-2 * press::size);
      CHECK(solid < 1e-3);
      CHECK(forces < 0.1);
    }
  }
}
