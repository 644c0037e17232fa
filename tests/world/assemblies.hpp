// SPDX-License-Identifier: MIT
// Small scenes that several tests share, written once for every shape.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/sphere.hpp"
#include "moreau/world/simulation.hpp"

namespace scenes {

using moreau::BodyId;
using moreau::Pose;

template <class ShapeT>
using LawOf = moreau::SignoriniCoulomb<typename moreau::SpaceOf<ShapeT>::Scalar>;

/// Ballast of circumradius 1 cm falling into an open box 8 cm wide, gravity along the last axis.
template <class ShapeT>
struct BoxOfGrains {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  moreau::Simulation<ShapeT, LawOf<ShapeT>> simulation;
  std::vector<BodyId> grains, walls;

  explicit BoxOfGrains(std::size_t count, const moreau::GaussSeidelOptions& options = {},
                       T friction = T(0.4), std::uint64_t seed = 1)
      : simulation(T(0.02), moreau::Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(friction)),
                   moreau::NonlinearGaussSeidel(options)) {
    std::mt19937_64 random(seed);
    const std::vector<ShapeT> shapes = moreau::ballast_shapes<ShapeT>(8, random);
    std::uniform_real_distribution<T> jitter(T(-1e-3), T(1e-3));
    constexpr std::size_t per_side = 3;
    for (std::size_t k = 0; k < count; ++k) {
      Pose<S> pose;
      std::size_t rest = k;
      for (int axis = 0; axis < up; ++axis) {
        pose.position[axis] = T(0.016) + T(0.024) * T(rest % per_side) + jitter(random);
        rest /= per_side;
      }
      pose.position[up] = T(0.012) + T(0.024) * T(rest);
      pose.rotation = S::exp(S::Angular::Constant(T(100) * jitter(random)));
      const auto shape = simulation.add_shape(shapes[k % shapes.size()].scaled(T(0.01)));
      grains.push_back(simulation.add_grain(shape, pose, T(2700)));
    }
    for (int axis = 0; axis < up; ++axis) {
      const Vector n = Vector::Unit(axis);
      walls.push_back(simulation.add_wall(n, Vector::Zero()));
      walls.push_back(simulation.add_wall(-n, T(0.08) * n));
    }
    walls.push_back(simulation.add_wall(Vector::Unit(up), Vector::Zero()));
    simulation.set_gravity(T(-9.81) * Vector::Unit(up));
  }

  Vector momentum() const {
    Vector sum = Vector::Zero();
    for (const BodyId grain : grains)
      sum += simulation.bodies().weight[grain.index()] *
             simulation.bodies().velocity[grain.index()].template head<S::dim>();
    return sum;
  }
};

/// A cuboid (rectangle) with these half extents.
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
