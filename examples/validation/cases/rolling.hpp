// SPDX-License-Identifier: MIT
// A sphere or disk that slides and spins on a floor.
#pragma once

#include <limits>

#include "scene.hpp"

namespace validation {

/// A sphere (disk) that starts with the velocity v0 without spin rolls with v0/(1 + k) after the
/// time v0 k/((1 + k) mu g), k = I/(m R^2): 5/7 (2/3) of v0. The time at which rolling begins is
/// wrong by up to h; compared is the mean over several v0.
template <class ShapeT>
void slip_to_roll_rigid(Record& record) {
  using S = SpaceOf<ShapeT>;
  const double mu = 0.3, k = gyration<S>;
  std::vector<double> steps, errors;
  double worst_share = 0, latest = 0;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    double sum = 0;
    for (int n = 0; n < 16; ++n) {
      const double v0 = 1 + 0.007 * n, exact = k / (1 + k) * v0 / (mu * gravity);
      OnFloor<ShapeT> scene(ShapeT(0.05), 0.05, Coulomb<ShapeT>(mu));
      scene.world.set_velocity(scene.grain, S::Vector::UnitX() * v0);
      double start = 0, time = 0;  // in double, unlike world.time()
      while (time < 0.2) {
        scene.world.step(h);
        time += h;
        if (std::abs(scene.along() - 0.05 * scene.spin()) > resolved<S>(1e-9)) start = time;
      }
      worst_share = std::max(worst_share, std::abs(scene.along() / v0 * (1 + k) - 1));
      latest = std::max(latest, std::abs(start - exact) / h);
      sum += std::abs(start - exact);
    }
    steps.push_back(h);
    errors.push_back(sum / 16);
  }
  const std::string name = with_shape<ShapeT>("slip to roll") + ": ";
  record.vanishes(name + "relative error of the final speed", S{}, worst_share, 1e-9);
  record.vanishes(name + "error of the start of rolling, over h", S{}, latest,
                  1 + resolved<S>(1e-9, 1000));
  record.compare(name + "order of the start of rolling", S{}, 1, order_of(steps, errors), 0.25);
}

/// The same on springs, with an overlap of `sag` radii under the weight. The overlap shortens the
/// lever of friction, and changes the speed of rolling to the same order.
template <class ShapeT, class Law>
void slip_to_roll_on_springs(Record& record, const auto& law_of_sag) {
  using S = SpaceOf<ShapeT>;
  const double radius = 0.05, k = gyration<S>;
  const double weight = ShapeT(radius).mass_properties(1000).mass * gravity;
  std::vector<double> sags, errors;
  const double least = resolved<S>(1e-5, 1e4);
  for (const double sag : {4 * least, 2 * least, least}) {
    const Law law = law_of_sag(weight, radius, sag * radius);
    OnFloor<ShapeT, Law> scene(ShapeT(radius), radius * (1 - sag), law);
    scene.world.set_velocity(scene.grain, S::Vector::UnitX());
    const double h = std::sqrt(sag * radius / gravity) / 30;  // pi sqrt(m/k)/100
    while (scene.world.time() < 0.2) scene.world.step(h);
    sags.push_back(sag);
    errors.push_back(std::abs(scene.along() * (1 + k) - 1));
  }
  const std::string name = with_law<Law>(with_shape<ShapeT>("slip to roll")) + ": ";
  record.vanishes(name + "relative error of the final speed, over the overlap over R", S{},
                  errors.back() / least, 1);
  record.compare(name + "order of the final speed in the overlap", S{}, 1, order_of(sags, errors),
                 0.1);
}

/// A sphere (disk) without spin hits a wall. It slips iff v_t/v_n >= (1 + 1/k) mu (1 + e), and then
/// v_t decreases by mu (1 + e) v_n; else v_t' = v_t/(1 + k) (W. Goldsmith, Impact, 1960). In space
/// the velocity is along neither tangential axis of the wall.
template <class ShapeT>
void oblique_impact(Record& record, double theta) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double mu = 0.3, e = 0.5, v_n = 1, k = gyration<S>, h = 1e-4;
  Vector ahead = Vector::Zero();
  for (int axis = 0; axis + 1 < S::dim; ++axis) ahead[axis] = typename S::Scalar(1 + axis);
  ahead.normalize();
  const double closed = resolved<S>(1e-13, 1);
  const std::string name = with_theta(theta, with_shape<ShapeT>("oblique impact"));
  double worst_along = 0, worst_up = 0;
  for (const double v_t : {0.3, 1.0, 1.34, 1.36, 1.57, 1.58, 4.0}) {
    // Detection happens (1 - theta) h later. The gap is then exactly closed, so the lever is the
    // radius.
    OnFloor<ShapeT> scene(ShapeT(0.05), 0.05 + v_n * h * (1 - theta) - closed,
                          Coulomb<ShapeT>(mu, e), 0, theta);
    scene.world.set_gravity(Vector::Zero());
    scene.world.set_velocity(scene.grain, v_t * ahead + in_plane<S>(0, -v_n));
    scene.world.step(h);
    const bool slips = v_t / v_n >= (1 + 1 / k) * mu * (1 + e);
    const double exact = slips ? v_t - mu * (1 + e) * v_n : v_t / (1 + k);
    const Vector error =
        scene.twist().template head<S::dim>() - in_plane<S>(0, scene.upward()) - exact * ahead;
    worst_along = std::max(worst_along, double(error.norm()) / exact);
    worst_up = std::max(worst_up, std::abs(scene.upward() / (e * v_n) - 1));
  }
  record.vanishes(name + ": relative error of v_t'", S{}, worst_along, 1e-10);
  record.vanishes(name + ": relative error of v_n'", S{}, worst_up, 1e-10);
}

/// On springs, at an angle at which the contact slides throughout: v_t decreases by mu times the
/// change of v_n.
template <class ShapeT, class Law>
void oblique_impact_on_springs(Record& record, const Law& law, double friction) {
  using S = SpaceOf<ShapeT>;
  OnFloor<ShapeT, Law> scene(ShapeT(0.05), 0.0501, law);
  scene.world.set_gravity(S::Vector::Zero());
  scene.world.set_velocity(scene.grain, in_plane<S>(4, -1));
  while (scene.upward() <= 0 || scene.pose().position[scene.up] < 0.0501) scene.world.step(2e-6);
  record.compare_relative(
      with_law<Law>(with_shape<ShapeT>("oblique impact")) + ": loss of v_t in slip [m/s]", S{},
      friction * (1 + scene.upward()), 4 - scene.along(), 1e-10);
}

template <class ShapeT>
void slips_to_roll_of(Record& record) {
  slip_to_roll_rigid<ShapeT>(record);
  slip_to_roll_on_springs<ShapeT, Springs<ShapeT>>(
      record, [](double weight, double, double overlap) {
        return Springs<ShapeT>(weight / overlap, 2. / 7 * weight / overlap, 0.3, 0.5);
      });
  slip_to_roll_on_springs<ShapeT, Hertz<ShapeT>>(
      record, [](double weight, double radius, double overlap) {
        const double young = 0.75 * weight / (std::sqrt(radius) * std::pow(overlap, 1.5));
        return Hertz<ShapeT>(young, 0.2 * young, 0.3, 0.5);
      });
}

template <class T>
void slip_to_roll(Record& record, Effort) {
  slips_to_roll_of<Ball<T>>(record);
  slips_to_roll_of<Disk<T>>(record);
}

template <class ShapeT>
void oblique_impacts_of(Record& record) {
  oblique_impact<ShapeT>(record, 0.5);
  oblique_impact<ShapeT>(record, 1);
  oblique_impact_on_springs<ShapeT>(record, Springs<ShapeT>(1e6, 2e6 / 7, 0.3, 0.5), 0.3);
  oblique_impact_on_springs<ShapeT>(record, Hertz<ShapeT>(1e7, 2e6, 0.3, 0.5), 0.3);
}

template <class T>
void oblique_impacts(Record& record, Effort) {
  oblique_impacts_of<Ball<T>>(record);
  oblique_impacts_of<Disk<T>>(record);
}

}  // namespace validation
