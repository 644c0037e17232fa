// SPDX-License-Identifier: MIT
// Grains of the shapes of ballast in a box under a loaded lid, for benchmarks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/world/simulation.hpp"

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
    std::mt19937_64 random(1);
    std::vector<ShapeT> shapes;
    std::vector<double> radii;
    double volume = 0;
    for (const double diameter : SizeDistribution::azema2008().sample(count, random)) {
      shapes.push_back(Ballast<ShapeT>::draw(random).scaled(diameter / 2));
      radii.push_back(diameter / 2);
      volume += shapes.back().volume();
    }
    length_ = std::pow(volume / 0.6, 1.0 / S::dim);
    const auto poses = random_deposition<S>(radii, length_, random);
    double top = 0;
    for (std::size_t k = 0; k < count; ++k) {
      world.add_grain(world.add_shape(shapes[k]), poses[k], density() * depth());
      top = std::max(top, poses[k].position[up] + radii[k]);
    }
    mass_ = density() * depth() * volume;
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
  static constexpr double density() { return 2700; }    // of the grains [kg/m^3]
  static constexpr double pressure() { return 1e4; }    // on the lid [Pa]
  static constexpr double thickness() { return 0.05; }  // of the plane [m]
  static constexpr double depth() { return std::is_same_v<S, Space<2>> ? thickness() : 1; }
  double force() const { return pressure() * depth() * std::pow(length_, up); }

  double length_ = 0, mass_ = 0;
  BodyId lid_;
};

}  // namespace bench
