// SPDX-License-Identifier: MIT
// Static friction, adhesion and rolling resistance in addition to Coulomb's law.
#pragma once

#include "scene.hpp"

namespace validation {

/// On a floor with acceleration a, a ball that is pressed on the floor by N rolls without slip iff
/// a <= (1 + 1/k) mu_s N/m, k = I/(m R^2). A ball that slips has the acceleration mu N/m. (tests/physics/static_friction.hpp
/// has blocks.)
/// @param press N relative to the weight; an adhesion contributes to N
template <class ShapeT, class Law>
void static_friction_of(Record& record, const std::string& name, const Law& law, double press) {
  using S = SpaceOf<ShapeT>;
  const double h = 1e-3, radius = 0.05, unit = (1 + 1 / gyration<S>)*gravity * press;
  const double mu = law.friction(), resting = law.static_friction();
  const double around = resolved<S>(1e-4, 1e5);
  struct Ride {
    double slip, acceleration;
  };
  const auto ride = [&](double share) -> Ride {
    OnFloor<ShapeT, Law> scene(ShapeT(radius), radius, law);
    const BodyId floor = scene.world.walls()[0];
    double start = 0;
    for (int k = 1; k <= 100; ++k) {
      scene.world.set_velocity(floor, share * unit * h * k * S::Vector::UnitX());
      scene.world.step(h);
      if (k == 50) start = scene.along();
    }
    const double slip = share * unit * h * 100 - scene.along() - radius * scene.spin();
    return {slip, (scene.along() - start) / (50 * h)};
  };
  record.compare(
      name + "slips on a floor that speeds up by so many (1 + 1/k) N/m", S{}, resting,
      threshold(resting - around, resting + around, 12,
                [&](double share) { return ride(share).slip > resolved<S>(1e-8, 1000); }),
      1e-6);
  record.compare(name + "acceleration in slip [m/s^2]", S{}, mu * gravity * press,
                 ride(2 * resting).acceleration, 1e-9);
}

template <class ShapeT>
void static_friction(Record& record) {
  const Coulomb<ShapeT> law(0.3, 0, 0.4);
  const std::string name = with_shape<ShapeT>("static friction");
  static_friction_of<ShapeT>(record, name + ": ", law, 1);
  const double weight = gravity * ShapeT(0.05).mass_properties(1000).mass;
  static_friction_of<ShapeT>(record, name + " under adhesion: ", Sticky<ShapeT>(law, weight, 1e-3),
                             2);
}

/// A ball under a ceiling falls iff its weight exceeds the adhesion. On a floor without gravity the
/// adhesion N alone presses a sliding ball, which rolls with v0/(1 + k) after the time v0 k/((1 +
/// k) mu N/m).
template <class ShapeT>
void adhesion(Record& record) {
  using S = SpaceOf<ShapeT>;
  using Law = Sticky<ShapeT>;
  const double radius = 0.05, range = 1e-6, mu = 0.3, k = gyration<S>;
  const double around = resolved<S>(1e-4, 1e5);
  const double mass = ShapeT(radius).mass_properties(1000).mass;
  const std::string name = with_shape<ShapeT>("adhesion") + ": ";
  const auto falls = [&](double share) {
    OnFloor<ShapeT, Law> scene(ShapeT(radius), radius,
                               Law(Coulomb<ShapeT>(mu), mass * gravity / share, range));
    scene.world.set_gravity(gravity * S::Vector::Unit(S::dim - 1));
    for (int step = 0; step < 50; ++step) scene.world.step(1e-3);
    return scene.upward() > resolved<S>(1e-8);
  };
  record.compare(name + "a ball falls from the ceiling at weight over adhesion", S{}, 1,
                 threshold(1 - around, 1 + around, 12, falls), 1e-6);

  const double pull = 5;
  double slip = 0, speed = 0, latest = 0;
  std::vector<double> steps, errors;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    double sum = 0;
    for (int n = 0; n < 16; ++n) {
      const double v0 = 1 + 0.007 * n, exact = k / (1 + k) * v0 / (mu * pull);
      OnFloor<ShapeT, Law> scene(ShapeT(radius), radius,
                                 Law(Coulomb<ShapeT>(mu), mass * pull, range));
      scene.world.set_gravity(S::Vector::Zero());
      scene.world.set_velocity(scene.grain, v0 * S::Vector::UnitX());
      double start = 0, time = 0;  // in double, unlike world.time()
      while (time < 0.4) {
        scene.world.step(h);
        time += h;
        if (std::abs(scene.along() - radius * scene.spin()) > resolved<S>(1e-9)) start = time;
        if (time < 0.5 * exact)
          slip = std::max(slip, std::abs(scene.along() - v0 + mu * pull * time));
      }
      speed = std::max(speed, std::abs(scene.along() / v0 * (1 + k) - 1));
      latest = std::max(latest, std::abs(start - exact) / h);
      sum += std::abs(start - exact) / 16;
    }
    steps.push_back(h);
    errors.push_back(sum);
  }
  record.vanishes(name + "error of v in slip [m/s]", S{}, slip, 1e-9);
  record.vanishes(name + "error of the start of rolling, over h", S{}, latest,
                  1 + resolved<S>(1e-9, 1000));
  record.compare(name + "order of the start of rolling", S{}, 1, order_of(steps, errors), 0.25);
  record.vanishes(name + "relative error of the speed of rolling", S{}, speed, 1e-9);
}

/// A ball on an incline stays iff tan(tilt) <= eta, else it rolls with the acceleration g (sin -
/// eta cos)/(1 + k): the couple of rolling resistance is at most eta R N (K. Iwashita and M. Oda,
/// J. Eng. Mech. 124 (1998) 285).
template <class ShapeT>
void rolling_resistance(Record& record) {
  using S = SpaceOf<ShapeT>;
  const double radius = 0.05, eta = 0.1, h = 1e-3, around = resolved<S>(1e-4, 1e5);
  const auto roll = [&](double slope) {
    OnFloor<ShapeT, Rolling<ShapeT>> scene(ShapeT(radius), radius, Rolling<ShapeT>(0.5, eta),
                                           std::atan(slope));
    for (int k = 0; k < 50; ++k) scene.world.step(h);
    const double start = scene.along();
    for (int k = 0; k < 50; ++k) scene.world.step(h);
    return std::pair(scene.along(), (scene.along() - start) / (50 * h));
  };
  const std::string name = with_shape<ShapeT>("rolling resistance") + ": ";
  record.compare(name + "a ball rolls from tan(tilt)", S{}, eta,
                 threshold(eta - around, eta + around, 12,
                           [&](double slope) { return roll(slope).first > resolved<S>(1e-8); }),
                 1e-6);
  const double tilt = std::atan(0.3);
  record.compare(name + "acceleration [m/s^2]", S{},
                 gravity * (std::sin(tilt) - eta * std::cos(tilt)) / (1 + gyration<S>),
                 roll(0.3).second, 1e-9);
}

template <class ShapeT>
void laws_of(Record& record) {
  static_friction<ShapeT>(record);
  adhesion<ShapeT>(record);
  rolling_resistance<ShapeT>(record);
}

template <class T>
void other_laws(Record& record, Effort) {
  laws_of<Ball<T>>(record);
  laws_of<Disk<T>>(record);
}

}  // namespace validation
