// SPDX-License-Identifier: MIT
// A ball that bounces on a floor.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// Time [s] after which a ball, dropped from `drop` above its position of rest, never moves faster
/// than gravity accelerates it in one step.
template <class ShapeT>
double time_to_rest(double drop, double restitution, double h, double latest, bool correct) {
  OnFloor<ShapeT> scene(ShapeT(0.05), 0.05 + drop, Coulomb<ShapeT>(0, restitution));
  moreau::OverlapCorrectionOptions correction;
  correction.enabled = correct;
  scene.world.set_correction(correction);
  double last_motion = 0;
  while (scene.world.time() < latest) {
    scene.world.step(h);
    if (scene.twist().norm() > gravity * h) last_motion = scene.world.time();
  }
  return last_motion;
}

}  // namespace detail

/// A ball with restitution e bounces infinitely often and comes to rest at the time sqrt(2 h0/g)(1
/// + e)/(1 - e). Time stepping has an error of a part of a step at each impact that it resolves.
/// The order is measured for the mean over drops between h0 and 1.1 h0, the error for the worst of
/// them.
///
/// An impact is late by up to h and its velocity is wrong by up to g h, which changes the remaining
/// time by 2 e/(1 - e) h: 3 h in all for e = 1/2. The finest step resolves about ten impacts, so
/// the error is up to 30 h. Half of it is required. The case runs with the overlap correction,
/// which lifts the ball out of its overlap, and without.
template <class ShapeT>
void time_to_rest(Record& record) {
  using S = SpaceOf<ShapeT>;
  constexpr int drops = 24;
  const double e = 0.5;
  for (const bool correct : {true, false}) {
    std::vector<double> steps, errors;
    double worst = 0;
    for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
      double sum = 0;
      for (int k = 0; k < drops; ++k) {
        const double drop = 0.1 * (1 + 0.1 * k / drops);
        const double exact = std::sqrt(2 * drop / gravity) * (1 + e) / (1 - e);
        const double error =
            std::abs(detail::time_to_rest<ShapeT>(drop, e, h, 1.2 * exact, correct) - exact);
        sum += error;
        worst = std::max(worst, error / h);
      }
      steps.push_back(h);
      errors.push_back(sum / drops);
    }
    const std::string name =
        with_shape<ShapeT>("bouncing ball") + (correct ? "" : ", overlaps not corrected");
    record.vanishes(name + ": error of the time to rest over h", S{}, worst, 15);
    record.compare(name + ": order of the time to rest", S{}, 1, order_of(steps, errors), 0.25);
  }
}

/// Without restitution a ball that lands closes its gap, for any step, and stays.
template <class ShapeT>
void landing(Record& record) {
  double gap = 0;
  for (const double h : {2e-3, 1e-3, 1e-4}) {
    OnFloor<ShapeT> scene(ShapeT(0.05), 0.06, Coulomb<ShapeT>(0.3));
    while (scene.world.time() < 0.1) scene.world.step(h);
    gap = std::max(gap, std::abs(scene.pose().position[scene.up] - 0.05));
  }
  record.vanishes(with_shape<ShapeT>("ball without restitution") + ": gap at rest [m]",
                  SpaceOf<ShapeT>{}, gap, 1e-12);
}

/// One impact on springs with dashpots and without gravity: v' = -e v for any speed. The phase of
/// the step at which the contact begins causes an error of the order of the step. Compared is the
/// mean over sixteen heights of the change with half the step. (A Hertz contact ends a little
/// early, where damping would attract: its e is smaller by 2e-4.)
template <class ShapeT, class Law>
void spring_restitution(Record& record, const Law& law, double e) {
  using S = SpaceOf<ShapeT>;
  const auto restitution = [&](double speed, double height, double h) {
    OnFloor<ShapeT, Law> scene(ShapeT(0.05), height, law);
    scene.world.set_gravity(S::Vector::Zero());
    scene.world.set_velocity(scene.grain, in_plane<S>(0, -speed));
    while (scene.upward() <= 0 || scene.pose().position[scene.up] < height) scene.world.step(h);
    return scene.upward() / speed;
  };
  const std::string name = with_law<Law>(with_shape<ShapeT>("bouncing ball")) + ": ";
  record.compare(name + "restitution at 0.1 m/s", S{}, e, restitution(0.1, 0.0501, 2e-6), 1e-3);
  record.compare(name + "restitution at 1 m/s", S{}, e, restitution(1, 0.0501, 2e-6), 1e-3);
  std::vector<double> steps, errors;
  for (const double h : {1.6e-5, 8e-6, 4e-6}) {
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
      const double height = 0.0501 + h * k / 16;
      sum += std::abs(restitution(1, height, h) - restitution(1, height, h / 2));
    }
    steps.push_back(h);
    errors.push_back(sum / 16);
  }
  record.compare(name + "order of the restitution", S{}, 1, order_of(steps, errors), 0.25);
}

template <class ShapeT>
void bounces_of(Record& record) {
  time_to_rest<ShapeT>(record);
  landing<ShapeT>(record);
  spring_restitution<ShapeT>(record, Springs<ShapeT>(1e6, 0, 0, 0.5), 0.5);
  spring_restitution<ShapeT>(record, Hertz<ShapeT>(1e7, 0, 0, 0.5), 0.5);
}

template <class T>
void bouncing_ball(Record& record, Effort) {
  bounces_of<Ball<T>>(record);
  bounces_of<Disk<T>>(record);
}

}  // namespace validation
