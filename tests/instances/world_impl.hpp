// SPDX-License-Identifier: MIT
// The part of world/assemblies.hpp that takes long to compile. It is included by one source file
// per shape.
#pragma once

#include <random>

#include "moreau/sample/ballast.hpp"

#include "world/assemblies.hpp"

namespace scenes {

template <class ShapeT>
moreau::StepReport World<ShapeT>::step(typename moreau::SpaceOf<ShapeT>::Scalar step) {
  return moreau::Simulation<ShapeT, LawOf<ShapeT>>::step(step);
}

template <class ShapeT>
BoxOfGrains<ShapeT>::BoxOfGrains(std::size_t count, const moreau::ColouredOptions& options,
                                 T friction, std::uint64_t seed)
    : simulation(T(0.02), moreau::Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(friction)),
                 moreau::ColouredGaussSeidel(options)) {
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

}  // namespace scenes
