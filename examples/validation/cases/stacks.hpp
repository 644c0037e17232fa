// SPDX-License-Identifier: MIT
// Bodies on top of each other.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// `count` bodies of half height 0.05 on each other and on a floor tilted by `tilt`.
template <class ShapeT>
World<ShapeT> column(int count, double tilt) {
  using S = SpaceOf<ShapeT>;
  World<ShapeT> world = world_of<ShapeT, Coulomb>(0.1, Coulomb(0.4));
  const auto id = world.add_shape(regular<ShapeT>(0.05));
  for (int k = 0; k < count; ++k) world.add_grain(id, {in_plane<S>(0, 0.05 + 0.1 * k)}, 1000);
  world.add_wall(S::Vector::Unit(S::dim - 1), S::Vector::Zero());
  world.set_gravity(tilted_gravity<S>(tilt));
  return world;
}

}  // namespace detail

/// Contact k of a column of N, counted from the floor, carries (N - k) m g h. Where the impulses
/// are unique, with one point per contact, those of the step before solve a step at rest: the
/// solver's first check, after 20 sweeps, says so.
template <class ShapeT>
void column(Record& record, int count) {
  const double h = 1e-3;
  auto world = detail::column<ShapeT>(count, 0);
  // From rest without a guess a step takes some 7.5 N^2 sweeps and more.
  for (int k = 0; k < 20; ++k) world.step(h);
  int unsolved = 0, sweeps = 0;
  for (int k = 0; k < 9; ++k) {
    const moreau::SolveReport solve = world.step(h).solve;
    unsolved += !solve.converged;
    sweeps = std::max(sweeps, solve.sweeps);
  }
  const double weight = world.bodies().weight[0] * gravity;
  double worst = 0;
  for (int k = 0; k < count; ++k) {
    double carried = 0;
    for (std::size_t c = 0; c < world.contacts().size(); ++c) {
      const auto& contact = world.contacts().points[c];
      const bool below = int(contact.a) == k - 1 && int(contact.b) == k;
      if (below || (k == 0 && int(contact.b) == count)) carried += world.contacts().impulses[c][0];
    }
    worst = std::max(worst, std::abs(carried / ((count - k) * weight * h) - 1));
  }
  const std::string name = with_shape<ShapeT>("column of " + std::to_string(count));
  record.vanishes(name + ": relative error of the impulses", SpaceOf<ShapeT>::dim, worst, 1e-8);
  record.vanishes(name + ": steps not solved", SpaceOf<ShapeT>::dim, unsolved, 0);
  if constexpr (is_round<ShapeT>)
    record.vanishes(name + ": sweeps of a step at rest", SpaceOf<ShapeT>::dim, sweeps, 20);
}

/// Three boxes on a floor tilted to half the friction angle: ten seconds without creep.
template <class ShapeT>
void stack(Record& record) {
  constexpr int count = 3, dim = SpaceOf<ShapeT>::dim;
  auto world = detail::column<ShapeT>(count, 0.2);
  for (int k = 0; k < 2000; ++k) world.step(5e-3);
  double drift = 0, velocity = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto start = in_plane<SpaceOf<ShapeT>>(0, 0.05 + 0.1 * double(k));
    drift = std::max(drift, (world.bodies().pose[k].position - start).norm());
    velocity = std::max(velocity, world.bodies().velocity[k].norm());
  }
  const std::string name = with_shape<ShapeT>("stack of 3 boxes, 10 s") + ": ";
  record.vanishes(name + "drift over side", dim, drift / 0.1, 1e-4);
  record.vanishes(name + "velocity [m/s]", dim, velocity, 1e-8);
}

inline void column_of_bodies(Record& record, Effort effort) {
  const int count = effort == Effort::quick ? 6 : 12;
  column<Polyhedron>(record, count);
  column<Polygon>(record, count);
  column<Ball>(record, count);
  column<Disk>(record, count);
}

inline void stack_of_boxes(Record& record, Effort) {
  stack<Polyhedron>(record);
  stack<Polygon>(record);
}

}  // namespace validation
