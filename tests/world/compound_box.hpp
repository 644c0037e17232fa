// SPDX-License-Identifier: MIT
// Concave grains of four parts in a box, for tests.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/world/simulation.hpp"

#include "instances/compound.hpp"

namespace scenes {

/// Concave ballast that falls into a box, open above, whose first axis may be periodic.
template <class Part>
struct CompoundBox {
  using Grain = moreau::Compound<Part>;
  using S = moreau::SpaceOf<Grain>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<double>;
  static constexpr int up = S::dim - 1;

  moreau::Simulation<Grain, Law> world{0.02, moreau::Materials<Law>(1, Law(0.4))};
  std::vector<moreau::ShapeId> shapes;
  std::vector<moreau::BodyId> walls;

  explicit CompoundBox(std::size_t count, bool periodic = false) {
    std::mt19937_64 random(4);
    for (const Grain& grain : moreau::ballast_shapes<Grain>(4, random))
      shapes.push_back(world.add_shape(grain.scaled(0.01)));
    for (std::size_t k = 0; k < count; ++k) add(k);
    for (int axis = 0; axis < up; ++axis) {
      if (periodic && axis == 0) {
        world.set_periodic(0, 0, 0.08);
        continue;
      }
      walls.push_back(world.add_wall(Vector::Unit(axis), Vector::Zero()));
      walls.push_back(world.add_wall(-Vector::Unit(axis), 0.08 * Vector::Unit(axis)));
    }
    walls.push_back(world.add_wall(Vector::Unit(up), Vector::Zero()));
    world.set_gravity(-9.81 * Vector::Unit(up));
  }
  /// Adds a grain at the k-th place.
  moreau::BodyId add(std::size_t k) {
    Vector x;
    std::size_t rest = k;
    for (int axis = 0; axis < up; ++axis) {
      x[axis] = 0.016 + 0.024 * double(rest % 3);
      rest /= 3;
    }
    x[up] = 0.012 + 0.024 * double(rest);
    return world.add_grain(shapes[k % shapes.size()],
                           {x, S::exp(S::Angular::Constant(0.1 * double(k)))}, 2700);
  }
  moreau::StepReport run(int steps) {
    moreau::StepReport report;
    for (int k = 0; k < steps; ++k) report = world.step(5e-4);
    return report;
  }
};

}  // namespace scenes
