// SPDX-License-Identifier: MIT
// Grains in a periodic cell, for the tests of cells that deform.
#pragma once

#include <random>
#include <vector>

#include "boundary/grain_of_radius.hpp"
#include "world/assemblies.hpp"

namespace gas_cell {

using namespace moreau;

inline constexpr double h = 5e-4, spacing = 0.0175;
template <class S>
inline constexpr int side = S::dim == 2 ? 7 : 4;

/// Grains with random velocities and rotations, near the points of a square (cubic) lattice.
template <class ShapeT>
struct Gas {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  scenes::World<ShapeT> simulation;
  std::vector<BodyId> grains;

  /// @param place function: number of a grain, its position -> that of the image that is added [m]
  /// @param ratio size of every other grain to that of the others [-]
  explicit Gas(const auto& place, double ratio = 1)
      : simulation(0.02, Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(0.4)),
                   solver()) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> jitter(-1, 1);
    const ShapeId shape = simulation.add_shape(grain_of_radius<ShapeT>(0.008)),
                  other = simulation.add_shape(grain_of_radius<ShapeT>(0.008 * ratio));
    int count = 1;
    for (int axis = 0; axis < S::dim; ++axis) count *= side<S>;
    for (int k = 0; k < count; ++k) {
      Pose<S> pose;
      for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side<S>)
        pose.position[axis] = spacing * (rest % side<S> + 0.5) + 4e-4 * jitter(random);
      pose.position = place(k, pose.position);
      pose.rotation = S::exp(S::Angular::Constant(jitter(random)));
      Vector velocity;
      for (int axis = 0; axis < S::dim; ++axis) velocity[axis] = 0.1 * jitter(random);
      grains.push_back(simulation.add_grain(k % 2 == 0 ? shape : other, pose, 2700));
      simulation.set_velocity(grains.back(), velocity);
    }
  }
  explicit Gas(double ratio = 1) : Gas([](int, const Vector& x) { return x; }, ratio) {}
  static ColouredGaussSeidel solver() {
    ColouredOptions options;
    options.tolerance = 1e-13;
    options.max_sweeps = 2000;
    return ColouredGaussSeidel(options);
  }
  static Matrix square() { return side<S> * spacing * Matrix::Identity(); }
};

}  // namespace gas_cell
