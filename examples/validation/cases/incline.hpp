// SPDX-License-Identifier: MIT
// Coulomb: C. A. de Coulomb, Theorie des machines simples (1785).
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// A cube on a floor tilted against gravity [rad]: what it does behind the first 50 steps.
struct Slide {
  double acceleration, velocity, spin;
  int unsolved;
};
template <class ShapeT>
Slide slide(double friction, double tilt) {
  OnFloor<ShapeT> scene(regular<ShapeT>(0.05), 0.05, Coulomb(friction), tilt);
  const double h = 1e-3;
  // Within a millionth of the friction angle the first steps from rest run into the cap on sweeps
  // (and say so); the acceleration is taken behind them.
  for (int k = 0; k < 50; ++k) scene.world.step(h);
  const double start = scene.along();
  int unsolved = 0;
  for (int k = 0; k < 50; ++k) unsolved += !scene.world.step(h).solve.converged;
  return {(scene.along() - start) / (50 * h), scene.along(), scene.spin(), unsolved};
}

}  // namespace detail

/// A block on an incline sticks iff tan(tilt) <= mu, else slides at g (sin - mu cos).
template <class ShapeT>
void block_on_incline(Record& record) {
  constexpr int dim = SpaceOf<ShapeT>::dim;
  const double mu = 0.4;
  double worst = 0, spin = 0, creep = 0;
  int unsolved = 0;
  Curve& curve =
      record.curve("incline_" + std::to_string(dim) + "d", {"tilt", "acceleration", "exact"});
  std::vector<double> tilts{std::atan(mu) - 1e-6, std::atan(mu) + 1e-6};
  for (int k = 1; k <= 16; ++k) tilts.push_back(0.05 * k);
  for (const double tilt : tilts) {
    const auto found = detail::slide<ShapeT>(mu, tilt);
    const double exact = std::max(0.0, gravity * (std::sin(tilt) - mu * std::cos(tilt)));
    worst = std::max(worst, std::abs(found.acceleration - exact));
    spin = std::max(spin, found.spin);
    unsolved += found.unsolved;
    if (exact == 0) creep = std::max(creep, std::abs(found.velocity));
    curve.rows.push_back({tilt, found.acceleration, exact});
  }
  std::sort(curve.rows.begin(), curve.rows.end());
  const std::string name = with_shape<ShapeT>("block on an incline");
  const double found = threshold(mu - 1e-4, mu + 1e-4, 12, [&](double slope) {
    return detail::slide<ShapeT>(mu, std::atan(slope)).velocity > 1e-8;
  });
  record.compare(name + ": slides from tan(tilt)", dim, mu, found, 1e-6);
  record.vanishes(name + ": error of the acceleration [m/s^2]", dim, worst, 1e-9);
  record.vanishes(name + ": velocity where it sticks [m/s]", dim, creep, 1e-9);
  record.vanishes(name + ": spin [rad/s]", dim, spin, 1e-9);
  record.vanishes(name + ": steps not solved", dim, unsolved, 0);
}

inline void incline(Record& record, Effort) {
  block_on_incline<Polyhedron>(record);
  block_on_incline<Polygon>(record);
}

}  // namespace validation
