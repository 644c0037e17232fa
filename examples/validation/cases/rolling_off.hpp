// SPDX-License-Identifier: MIT
// A ball that rolls off another ball.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

struct Departure {
  double cosine;  ///< cosine of the angle to the vertical at separation
  double gain;    ///< largest gain of energy / m g R
};

/// A ball on a fixed ball (1e12 times its mass, without weight): from rest at `angle` [rad] from
/// the top, with the initial overlap `overlap`, until the balls separate. Units: radius, mass of
/// the upper ball, gravity.
template <class ShapeT, class Law>
Departure roll_off(const Law& law, double angle, double h, double overlap = 0) {
  using S = SpaceOf<ShapeT>;
  constexpr int up = S::dim - 1;
  const double heavy = 1e12, mass = ShapeT(1).mass_properties(1).mass;
  World<ShapeT, Law> world = world_of<ShapeT, Law>(2, law);
  const auto ball = world.add_shape(ShapeT(1));
  world.add_grain(ball, {}, heavy);
  const double arm = 2 - overlap;
  const BodyId rolling =
      world.add_grain(ball, {in_plane<S>(arm * std::sin(angle), arm * std::cos(angle))}, 1);
  world.set_force(rolling, -mass * S::Vector::Unit(up));
  const auto& x = world.pose(rolling).position;
  const auto energy_of_ball = [&] { return kinetic_energy(world) / mass + x[up]; };
  double gain = 0, least = energy_of_ball();
  while (world.time() < 60) {
    const double cosine = x[up] / x.norm();
    world.step(h);
    gain = std::max(gain, energy_of_ball() - least);
    least = std::min(least, energy_of_ball());
    if (world.contacts().size() == 0 || world.contacts().impulses[0][0] <= 0)
      return {(cosine + x[up] / x.norm()) / 2, gain};
  }
  return {std::nan(""), gain};
}

}  // namespace detail

/// A ball that starts at rest at the angle a separates where (3 + k) cos = 2 cos a. k = I/(m R^2)
/// if it rolls (cos = 10/17 for spheres and 4/7 for disks that start on top), and k = 0 without
/// friction (2/3). The angle is exact to h; compared is the mean over sixteen angles. On a contact
/// that rotates, the velocity before a step points out of the contact frame after it, by v h/R. The
/// scheme therefore gains energy, of second order in h.
template <class ShapeT, class Law>
void roll_off_ball(Record& record, const Law& law, double k, const std::string& how) {
  using S = SpaceOf<ShapeT>;
  const double angle = 0.2;
  double worst = 0;
  std::vector<double> steps, errors, gains;
  for (const double h : {16e-3, 8e-3, 4e-3, 2e-3, 1e-3}) {
    double sum = 0;
    for (int n = 0; n < 16; ++n) {
      const double from = angle + 0.01 * n, exact = 2 * std::cos(from) / (3 + k);
      const auto found = detail::roll_off<ShapeT>(law, from, h);
      sum += std::abs(found.cosine - exact) / 16;
      worst = std::max(worst, std::abs(found.cosine - exact) / h);
      if (n == 0) gains.push_back(found.gain);
    }
    steps.push_back(h);
    errors.push_back(sum);
  }
  const std::string name = with_shape<ShapeT>(how + " off a ball") + ": ";
  record.vanishes(name + "error of the cosine where it leaves, over h", S{}, worst, 1);
  record.compare(name + "order of the cosine where it leaves", S{}, 1, order_of(steps, errors),
                 0.25);
  if (std::is_same_v<ScalarOf<ShapeT>, float>) return;  // the gain is smaller than its rounding
  record.compare(name + "order of the gain of energy", S{}, 2, order_of(steps, gains), 0.1);
}

/// The same on springs with an overlap of 1e-6 under the weight, to a thousandth.
template <class ShapeT, class Law>
void roll_off_springs(Record& record, const Law& law, double k, double overlap,
                      const std::string& how) {
  const double angle = 0.2, exact = 2 * std::cos(angle) / (3 + k);
  record.compare(
      with_law<Law>(with_shape<ShapeT>(how + " off a ball")) + ": cosine where it leaves",
      SpaceOf<ShapeT>{}, exact,
      detail::roll_off<ShapeT>(law, angle, 1e-4, overlap * std::cos(angle)).cosine, 1e-3);
}

template <class ShapeT>
void departures_of(Record& record) {
  const double k = gyration<SpaceOf<ShapeT>>, mass = ShapeT(1).mass_properties(1).mass;
  const double sag = resolved<SpaceOf<ShapeT>>(1e-6, 1000), stiffness = mass / sag;
  roll_off_ball<ShapeT>(record, Frictionless<ShapeT>(), 0, "sliding");
  roll_off_ball<ShapeT>(record, Coulomb<ShapeT>(100), k, "rolling");
  roll_off_springs<ShapeT>(record, Springs<ShapeT>(stiffness, 0, 0, 0.2), 0, sag, "sliding");
  roll_off_springs<ShapeT>(record, Springs<ShapeT>(stiffness, 2 * stiffness / 7, 100, 0.2), k, sag,
                           "rolling");
}

template <class T>
void off_a_ball(Record& record, Effort) {
  departures_of<Ball<T>>(record);
  departures_of<Disk<T>>(record);
}

}  // namespace validation
