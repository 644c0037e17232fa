// SPDX-License-Identifier: MIT
// A ball that rolls off another one.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

struct Departure {
  double cosine;  ///< of the angle to the vertical where it leaves
  double gain;    ///< of energy over m g R, at most
};

/// A ball on a fixed one, which is a million million times as heavy and weightless: from rest at
/// `angle` [rad] off the top until they part. Units: radii, mass of the upper ball, gravity.
template <class ShapeT, class Law>
Departure roll_off(const Law& law, double angle, double h) {
  using S = SpaceOf<ShapeT>;
  constexpr int up = S::dim - 1;
  const double heavy = 1e12, mass = ShapeT(1).mass_properties(1).mass;
  World<ShapeT, Law> world = world_of<ShapeT, Law>(2, law);
  const auto ball = world.add_shape(ShapeT(1));
  world.add_grain(ball, {}, heavy);
  const BodyId rolling =
      world.add_grain(ball, {in_plane<S>(2 * std::sin(angle), 2 * std::cos(angle))}, 1);
  world.set_force(rolling, -mass * S::Vector::Unit(up));
  const auto& x = world.bodies().pose[rolling.index()].position;
  const auto energy_of_ball = [&] { return kinetic_energy(world) / mass + x[up]; };
  double gain = 0, least = energy_of_ball();
  while (world.time() < 60) {
    const double cosine = x[up] / x.norm();
    world.step(h);
    gain = std::max(gain, energy_of_ball() - least);
    least = std::min(least, energy_of_ball());
    if (world.contacts().size() == 0 || world.contacts().impulses[0][0] == 0)
      return {(cosine + x[up] / x.norm()) / 2, gain};
  }
  return {std::nan(""), gain};
}

}  // namespace detail

/// A ball that starts at rest at the angle a leaves where (3 + k) cos = 2 cos a, with k = I/(m R^2)
/// if it rolls (10/17 of spheres, 4/7 of disks that start on top) and k = 0 without friction
/// (2/3); in a step of h within h. On a contact that turns, the velocity before a step points out
/// of the frame after it, by v h/R, and the scheme gains energy, to second order in h.
template <class ShapeT, class Law>
void roll_off_ball(Record& record, const Law& law, double k, const std::string& how) {
  constexpr int dim = SpaceOf<ShapeT>::dim;
  const double angle = 0.2, exact = 2 * std::cos(angle) / (3 + k);
  double cosine = 0;
  std::vector<double> steps, gains;
  for (const double h : {8e-3, 4e-3, 2e-3, 1e-3}) {
    const auto found = detail::roll_off<ShapeT>(law, angle, h);
    steps.push_back(h);
    cosine = found.cosine;
    gains.push_back(found.gain);
  }
  const std::string name = with_shape<ShapeT>(how + " off a ball") + ": ";
  record.compare(name + "cosine where it leaves", dim, exact, cosine, steps.back());
  record.compare(name + "order of the gain of energy", dim, 2, order_of(steps, gains), 0.1);
}

inline void off_a_ball(Record& record, Effort) {
  roll_off_ball<Ball>(record, Frictionless(), 0, "sliding");
  roll_off_ball<Disk>(record, Frictionless(), 0, "sliding");
  roll_off_ball<Ball>(record, Coulomb(100), gyration<moreau::Space<3>>, "rolling");
  roll_off_ball<Disk>(record, Coulomb(100), gyration<moreau::Space<2>>, "rolling");
}

}  // namespace validation
