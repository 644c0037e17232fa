// SPDX-License-Identifier: MIT
// Small scenes that several tests use, written once for all shapes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace scenes {

using moreau::BodyId;
using moreau::cuboid;
using moreau::Pose;

template <class ShapeT>
using LawOf = moreau::SignoriniCoulomb<typename moreau::SpaceOf<ShapeT>::Scalar>;

/// A simulation whose step is compiled once for each shape, in tests/instances, and not in every test
/// that uses it.
template <class ShapeT>
struct World : moreau::Simulation<ShapeT, LawOf<ShapeT>> {
  using moreau::Simulation<ShapeT, LawOf<ShapeT>>::Simulation;
  moreau::StepReport step(typename moreau::SpaceOf<ShapeT>::Scalar step);
};

/// Ballast grains with a circumradius of 1 cm that fall into an open box with a width of 8 cm.
/// Gravity acts along the last axis.
template <class ShapeT>
struct BoxOfGrains {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  World<ShapeT> simulation;
  std::vector<BodyId> grains, walls;

  explicit BoxOfGrains(std::size_t count, const moreau::ColouredOptions& options = {},
                       T friction = T(0.4), std::uint64_t seed = 1);

  Vector momentum() const {
    Vector sum = Vector::Zero();
    for (const BodyId grain : grains)
      sum += simulation.bodies().grain_mass[grain.index()] * simulation.velocity(grain);
    return sum;
  }
};

/// Steps two simulations. Returns whether their velocities then have the same bits.
template <class ShapeT>
bool have_same_bits_after(int steps, World<ShapeT>& one, World<ShapeT>& two) {
  using S = moreau::SpaceOf<ShapeT>;
  for (int k = 0; k < steps; ++k) {
    one.step(typename S::Scalar(5e-4));
    two.step(typename S::Scalar(5e-4));
  }
  const auto& a = one.bodies().velocity;
  const auto& b = two.bodies().velocity;
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(typename S::Twist)) == 0;
}

}  // namespace scenes
