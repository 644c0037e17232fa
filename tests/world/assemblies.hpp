// SPDX-License-Identifier: MIT
// Small scenes that several tests use, written once for all shapes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

namespace scenes {

using moreau::BodyId;
using moreau::Pose;

template <class ShapeT>
using LawOf = moreau::SignoriniCoulomb<typename moreau::SpaceOf<ShapeT>::Scalar>;

/// A simulation whose step is compiled once for each shape, in tests/worlds, and not in every test
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
      sum += simulation.bodies().weight[grain.index()] *
             simulation.bodies().velocity[grain.index()].template head<S::dim>();
    return sum;
  }
};

/// A cuboid (in the plane a rectangle) with the given half lengths.
template <class ShapeT>
ShapeT cuboid(const typename moreau::SpaceOf<ShapeT>::Vector& half) {
  using S = moreau::SpaceOf<ShapeT>;
  std::vector<typename S::Vector> corners;
  for (int corner = 0; corner < (1 << S::dim); ++corner) {
    typename S::Vector x = half;
    for (int axis = 0; axis < S::dim; ++axis)
      if ((corner >> axis & 1) != 0) x[axis] = -x[axis];
    corners.push_back(x);
  }
  return ShapeT(corners);
}

}  // namespace scenes
