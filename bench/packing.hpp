// SPDX-License-Identifier: MIT
// Grains of the shapes of ballast in a box under a loaded lid, for benchmarks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "moreau/sample/random_deposition.hpp"
#include "moreau/world/simulation.hpp"

#include "ballast_grains.hpp"

namespace bench {

using namespace moreau;

constexpr double packing_step = 2e-4;  // [s]

/// @tparam Solver of the contact problem
template <class ShapeT, class Law, class Solver>
class Packing {
 public:
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using World = Simulation<ShapeT, Law, MoreauJean, CellGrid<S>, Solver>;
  static constexpr int up = S::dim - 1;

  Packing(std::size_t count, const Law& law, const Solver& solver = Solver{})
      : world(0.025, Materials<Law>(1, law), solver) {
    world.set_contact_points(contact_points<S, Law>);
    std::mt19937_64 random(1);
    const BallastGrains<ShapeT> grains(count, random);
    length_ = std::pow(grains.volume / 0.6, 1.0 / S::dim);
    const auto poses = random_deposition<S>(grains.radii, length_, random);
    double top = 0;
    for (std::size_t k = 0; k < count; ++k) {
      world.add_grain(world.add_shape(grains.shapes[k]), poses[k], density<S>);
      top = std::max(top, poses[k].position[up] + grains.radii[k]);
    }
    mass_ = density<S> * grains.volume;
    for (int axis = 0; axis < S::dim; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
    for (int axis = 0; axis < up; ++axis)
      world.add_wall(-Vector::Unit(axis), length_ * Vector::Unit(axis));
    lid_ = world.add_wall(-Vector::Unit(up), top * Vector::Unit(up));
    world.set_gravity(-9.81 * Vector::Unit(up));
  }

  /// Lowers the lid until the grains carry its force, and lets them come to rest under the force.
  void compress() {
    world.set_velocity(lid_, -1.0 * Vector::Unit(up));
    double reaction = 0;
    while (reaction < force()) {
      world.step(packing_step);
      reaction += 0.05 * (world.contact_impulse(lid_)[up] / packing_step - reaction);
    }
    world.set_velocity(lid_, Vector::Zero());
    world.set_wall_mass(lid_, mass_);
    load(1);
    for (int k = 0; k < 1500; ++k) world.step(packing_step);
  }
  /// Sets the force on the lid, relative to that of the pressure.
  void load(double share) { world.set_force(lid_, -share * force() * Vector::Unit(up)); }

  World world;

 private:
  double force() const { return pressure * depth<S> * std::pow(length_, up); }

  double length_ = 0, mass_ = 0;
  BodyId lid_;
};

}  // namespace bench
