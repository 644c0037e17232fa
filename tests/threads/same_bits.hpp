// SPDX-License-Identifier: MIT
// Small simulations, whose results must not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "threads/eager_team.hpp"

namespace threads_test {

using namespace moreau;

// The thread sanitizer makes everything some fifty times slower.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define MOREAU_TEST_FEW_STEPS
#endif
#endif
#ifdef MOREAU_TEST_FEW_STEPS
inline constexpr int steps = 30;
inline constexpr int team_sizes[] = {2, 3};
#else
inline constexpr int steps = 150;
inline constexpr int team_sizes[] = {2, 3, 4, 8};
#endif

inline constexpr double grain_size = 0.02;  // of the grains [m]

/// A lattice of wide x wide x high (in the plane wide x high) cubic cells.
template <class S>
struct Lattice {
  int wide, high;
  double cell;       ///< width of a cell [m]
  double shift = 0;  ///< by which every second layer is moved along x, over the width of a cell

  double width() const { return wide * cell; }
  /// Calls use(centre, i, j, k): cell i along x, cell j along the other horizontal axis, layer k.
  template <class Use>
  void for_each(const Use& use) const {
    for (int k = 0; k < high; ++k)
      for (int i = 0; i < wide; ++i)
        for (int j = 0; j < (S::dim > 2 ? wide : 1); ++j) {
          typename S::Vector centre = S::Vector::Constant(cell * (j + 0.5));
          centre[0] = cell * (i + 0.5 + shift * (k % 2));
          centre[S::dim - 1] = cell * (k + 0.5);
          use(centre, i, j, k);
        }
  }
};

/// Appends the positions of all bodies to the results of a simulation.
void append_positions(const auto& world, std::vector<double>& results) {
  for (const auto& pose : world.bodies().pose)
    for (const double x : pose.position) results.push_back(x);
}

/// 6 x 6 x 8 (in the plane 20 x 20) grains fall into a box, which is periodic along x.
template <class ShapeT, class Law>
std::vector<double> fall(const Law& law, const Team& team) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const Lattice<S> lattice{up == 1 ? 20 : 6, up == 1 ? 20 : 8, 0.024, 0.1};
  Simulation<ShapeT, Law> world(grain_size, Materials<Law>(1, law));
  world.set_team(team);
  const ShapeId shape = world.add_shape(regular_shape<ShapeT>(grain_size));
  world.set_periodic(0, 0.0, lattice.width());
  for (int axis = 1; axis < S::dim; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
  if (up > 1) world.add_wall(-Vector::Unit(1), lattice.width() * Vector::Unit(1));
  lattice.for_each([&](const Vector& centre, int i, int, int k) {
    world.add_grain(shape, {centre, S::exp(S::Angular::Constant(0.1 * k + 0.3 * i))}, 2700);
  });
  world.set_gravity(-9.81 * Vector::Unit(up));
  std::vector<double> results;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = world.step(5e-4);
    if (step % 10 != 9) continue;
    results.push_back(report.solve.residual);
    results.push_back(report.dissipation);
    results.push_back(double(report.points));
  }
  append_positions(world, results);
  return results;
}

/// 9 x 9 x 3 (in the plane 100 x 4) grains between a floor and a lid with a mass, which a force presses
/// on them. The lid starts a twentieth of the grain size above the highest grain. It touches more than 48
/// grains: it is a hub of the contact problem.
template <class ShapeT, class Law>
std::vector<double> press(const Law& law, const Team& team) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const Lattice<S> lattice{up == 1 ? 100 : 9, up == 1 ? 4 : 3, 0.0205};
  Simulation<ShapeT, Law> world(grain_size, Materials<Law>(1, law));
  world.set_team(team);
  const BodyId floor = world.add_wall(Vector::Unit(up), Vector::Zero());
  for (int axis = 0; axis < up; ++axis) world.set_periodic(axis, 0.0, lattice.width());
  const ShapeT regular = regular_shape<ShapeT>(grain_size);
  const ShapeId shape = world.add_shape(regular);
  double mass = 0, top = 0;  // mass of the grains, height of their highest point
  lattice.for_each([&](const Vector& centre, int i, int j, int) {
    const Pose<S> pose{centre, S::exp(S::Angular::Constant(0.02 * (i % 10) + 0.01 * j))};
    const BodyId grain = world.add_grain(shape, pose, 2700);
    mass += world.bodies().grain_mass[grain.index()];
    top = std::max(top, regular.bounding_box(pose).upper[up]);
  });
  const BodyId lid = world.add_wall(-Vector::Unit(up), (top + grain_size / 20) * Vector::Unit(up));
  world.set_wall_mass(lid, mass);
  world.set_force(lid, -100 * mass * Vector::Unit(up));
  world.set_gravity(-9.81 * Vector::Unit(up));
  std::vector<double> results;
  std::size_t most = 0;  // contacts of the lid
  for (int step = 0; step < 20; ++step) {
    const StepReport report = world.step(5e-4);
    std::size_t count = 0;
    for (const auto& contact : world.contacts().points) count += contact.b == lid.index();
    most = std::max(most, count);
    results.push_back(report.solve.residual);
    results.push_back(double(report.solve.sweeps));
  }
  CHECK(most > 48);
  results.push_back(world.contact_impulse(floor)[up]);
  append_positions(world, results);
  return results;
}

/// Checks that the results of a simulation are the same for all team sizes.
template <class ShapeT, class Law>
void check_bits(const Law& law) {
  const auto fallen = fall<ShapeT>(law, Team()), pressed = press<ShapeT>(law, Team());
  for (const int threads : team_sizes) {
    CHECK(fall<ShapeT>(law, eager(threads)) == fallen);
    CHECK(press<ShapeT>(law, eager(threads)) == pressed);
  }
}

}  // namespace threads_test
