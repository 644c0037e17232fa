// SPDX-License-Identifier: MIT
// Bodies on top of each other.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// `count` bodies of half height 0.05 on top of each other on a floor that is tilted by `tilt`.
template <class ShapeT, class Law>
World<ShapeT, Law> column(int count, const Law& law, double tilt, double theta = 0.5) {
  using S = SpaceOf<ShapeT>;
  auto world = world_of<ShapeT>(0.1, law, tight(), {}, theta);
  // Few points carry the same load as all points, but their springs are less stiff.
  if (!is_rigid<ShapeT, Law>) world.set_contact_points(moreau::ContactPoints::all);
  const auto id = world.add_shape(regular<ShapeT>(0.05));
  for (int k = 0; k < count; ++k) world.add_grain(id, {in_plane<S>(0, 0.05 + 0.1 * k)}, 1000);
  world.add_wall(S::Vector::Unit(S::dim - 1), S::Vector::Zero());
  world.set_gravity(tilted_gravity<S>(tilt));
  return world;
}

}  // namespace detail

/// Contact k of a column of N, counted from the floor, carries (N - k) m g h. If the impulses are
/// unique (one point per contact), the impulses of the last step solve a step at rest, and the
/// first check of the solver passes. On springs the forces are compared after the
/// column has come to rest.
template <class ShapeT, class Law>
void column(Record& record, int count, const Law& law, double theta = 0.5) {
  constexpr bool rigid = is_rigid<ShapeT, Law>;
  const double h = rigid ? 1e-3 : 1e-5;
  auto world = detail::column<ShapeT>(count, law, 0, theta);
  // From rest without a warm start a step takes 7.5 N^2 sweeps and more. Springs oscillate for N^2
  // times the duration of one contact.
  const int before = rigid ? 20 : 1500 * count * count;
  for (int k = 0; k < before; ++k) world.step(h);
  int unsolved = 0, sweeps = 0;
  for (int k = 0; k < 9; ++k) {
    const moreau::SolveReport solve = world.step(h).solve;
    unsolved += rigid && !solve.converged;
    sweeps = std::max(sweeps, solve.sweeps);
  }
  const double weight = world.bodies().grain_mass[0] * gravity;
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
  const std::string name =
      with_theta(theta, with_law<Law>(with_shape<ShapeT>("column of " + std::to_string(count))));
  record.vanishes(name + ": relative error of the impulses", SpaceOf<ShapeT>{}, worst, 1e-8);
  if (!rigid) return;
  record.vanishes(name + ": steps not solved", SpaceOf<ShapeT>{}, unsolved, 0);
  if (is_round<ShapeT>)
    record.vanishes(name + ": sweeps of a step at rest", SpaceOf<ShapeT>{}, sweeps, 20);
}

/// Three boxes on a floor that is tilted by half the friction angle do not drift in ten seconds.
/// (On springs, one second: with four dashpots per face they need a short step.)
template <class ShapeT, class Law>
void stack(Record& record, const Law& law) {
  using S = SpaceOf<ShapeT>;
  constexpr int count = 3;
  auto world = detail::column<ShapeT>(count, law, 0.2);
  constexpr bool rigid = is_rigid<ShapeT, Law>;
  const double h = rigid ? 5e-3 : 1e-5;
  const int steps = rigid ? 2000 : 100000;
  for (int k = 0; k < steps; ++k) world.step(h);
  double drift = 0, velocity = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto start = in_plane<S>(0, 0.05 + 0.1 * double(k));
    drift = std::max(drift, double((world.bodies().pose[k].position - start).norm()));
    velocity = std::max(velocity, double(world.bodies().velocity[k].norm()));
  }
  const std::string name = with_law<Law>(with_shape<ShapeT>(rigid ? "stack of 3 boxes, 10 s"
                                                                  : "stack of 3 boxes, 1 s")) +
                           ": ";
  record.vanishes(name + "drift over side", S{}, drift / 0.1, 1e-4);
  record.vanishes(name + "velocity [m/s]", S{}, velocity, 1e-8);
}

template <class ShapeT>
void columns_of(Record& record, int count) {
  column<ShapeT>(record, count, Coulomb<ShapeT>(0.4));
  column<ShapeT>(record, count, Coulomb<ShapeT>(0.4), 1);
  // Round bodies on springs fall off each other within two seconds, and they take twelve seconds to
  // come to rest.
  const double mass = regular<ShapeT>(0.05).mass_properties(1000).mass;
  column<ShapeT>(record, 6, Springs<ShapeT>(4e6 * mass, 1e6 * mass, 0.4, 0.2));
  if constexpr (is_round<ShapeT>)
    column<ShapeT>(record, 6, Hertz<ShapeT>(4e9 * mass, 8e8 * mass, 0.4, 0.2));
}

template <class T>
void column_of_bodies(Record& record, Effort effort) {
  const int count = effort == Effort::quick || std::is_same_v<T, float> ? 6 : 12;
  columns_of<Polyhedron<T>>(record, count);
  columns_of<Polygon<T>>(record, count);
  columns_of<Ball<T>>(record, count);
  columns_of<Disk<T>>(record, count);
}

template <class ShapeT>
void stacks_of(Record& record) {
  stack<ShapeT>(record, Coulomb<ShapeT>(0.4));
  const double mass = regular<ShapeT>(0.05).mass_properties(1000).mass;
  stack<ShapeT>(record, Springs<ShapeT>(2e7 * mass, 6e6 * mass, 0.4, 0.2));
}

template <class T>
void stack_of_boxes(Record& record, Effort) {
  stacks_of<Polyhedron<T>>(record);
  stacks_of<Polygon<T>>(record);
}

}  // namespace validation
