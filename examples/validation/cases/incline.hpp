// SPDX-License-Identifier: MIT
// Coulomb: C. A. de Coulomb, Theorie des machines simples (1785).
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// Motion of a cube on a floor that is tilted against gravity [rad], in the 50 ms after it has settled.
struct Slide {
  double acceleration, velocity, spin;
  int unsolved;
};
template <class ShapeT, class Law>
Slide slide(const Law& law, double tilt, double theta) {
  OnFloor<ShapeT, Law> scene(regular<ShapeT>(0.05), 0.05, law, tilt, theta);
  scene.world.set_contact_points(moreau::ContactPoints::all);
  const double h = is_rigid<ShapeT, Law> ? 1e-3 : 2e-5;
  const int steps = static_cast<int>(std::lround(0.05 / h));
  // Within a millionth of the friction angle the first steps from rest reach the cap on sweeps. On
  // springs the block sways: in the plane by exp(-363 t/s), which after 50 ms leaves up to 7e-9 m/s^2,
  // after 100 ms 2e-16 m/s^2. The acceleration is measured after that.
  const int settling = is_rigid<ShapeT, Law> ? steps : 2 * steps;
  for (int k = 0; k < settling; ++k) scene.world.step(h);
  const double start = scene.along();
  int unsolved = 0;
  for (int k = 0; k < steps; ++k) {
    const moreau::StepReport report = scene.world.step(h);
    unsolved += is_rigid<ShapeT, Law> && !report.solve.converged;
  }
  return {(scene.along() - start) / (steps * h), scene.along(), scene.spin(), unsolved};
}

}  // namespace detail

/// A block on an incline sticks iff tan(tilt) <= mu, else it slides with the acceleration g (sin -
/// mu cos). On springs the block moves a little while the springs take up its weight; it slides iff
/// it accelerates.
template <class ShapeT, class Law>
void block_on_incline(Record& record, double mu, const Law& law, double theta = 0.5) {
  using S = SpaceOf<ShapeT>;
  const double around = resolved<S>(1e-4, 1e5);
  double worst = 0, spin = 0, slip = 0;
  int unsolved = 0;
  Curve curve;
  std::vector<double> tilts;
  if (is_rigid<ShapeT, Law>) tilts = {std::atan(mu) - 0.01 * around, std::atan(mu) + 0.01 * around};
  for (int k = 1; k <= 16; ++k) tilts.push_back(0.05 * k);
  for (const double tilt : tilts) {
    const auto found = detail::slide<ShapeT>(law, tilt, theta);
    const double exact = std::max(0.0, gravity * (std::sin(tilt) - mu * std::cos(tilt)));
    worst = std::max(worst, std::abs(found.acceleration - exact));
    spin = std::max(spin, found.spin);
    unsolved += found.unsolved;
    if (exact == 0) slip = std::max(slip, std::abs(found.velocity));
    curve.rows.push_back({tilt, found.acceleration, exact});
  }
  std::sort(curve.rows.begin(), curve.rows.end());
  if (is_rigid<ShapeT, Law> && theta == 0.5)
    record.curve("incline", S{}, {"tilt", "acceleration", "exact"}).rows = curve.rows;
  const std::string name =
      with_theta(theta, with_law<Law>(with_shape<ShapeT>("block on an incline")));
  const double found = threshold(mu - around, mu + around, 12, [&](double slope) {
    return detail::slide<ShapeT>(law, std::atan(slope), theta).acceleration > resolved<S>(1e-7);
  });
  record.compare(name + ": slides from tan(tilt)", S{}, mu, found, 1e-6);
  record.vanishes(name + ": error of the acceleration [m/s^2]", S{}, worst, 1e-9);
  record.vanishes(name + ": velocity where it sticks [m/s]", S{}, slip, 1e-9);
  record.vanishes(name + ": spin [rad/s]", S{}, spin, 1e-9);
  if (is_rigid<ShapeT, Law>) record.vanishes(name + ": steps not solved", S{}, unsolved, 0);
}

template <class ShapeT>
void inclines_of(Record& record) {
  const double mu = 0.4, mass = regular<ShapeT>(0.05).mass_properties(1000).mass;
  block_on_incline<ShapeT>(record, mu, Coulomb<ShapeT>(mu));
  block_on_incline<ShapeT>(record, mu, Coulomb<ShapeT>(mu), 1);
  block_on_incline<ShapeT>(record, mu, Springs<ShapeT>(1e6 * mass, 3e5 * mass, mu, 0.2));
}

template <class T>
void incline(Record& record, Effort) {
  inclines_of<Polyhedron<T>>(record);
  inclines_of<Polygon<T>>(record);
}

}  // namespace validation
