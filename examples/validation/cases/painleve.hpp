// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

inline bool is_sane(const moreau::StepReport& report) {
  const moreau::SolveReport& solve = report.solve;
  for (const double value :
       {report.max_overlap, report.mean_overlap, report.dissipation, solve.residual,
        solve.worst_velocity, solve.worst_cone, solve.worst_complementarity,
        solve.wrong_sign_dissipation, report.correction.work, report.correction.largest_shift})
    if (!std::isfinite(value)) return false;
  return solve.converged != solve.capped && solve.residual >= 0;
}

template <class ShapeT>
bool is_finite(const World<ShapeT>& world) {
  for (const auto& pose : world.bodies().pose)
    if (!pose.is_finite()) return false;
  for (const auto& velocity : world.bodies().velocity)
    if (!velocity.allFinite()) return false;
  return true;
}

}  // namespace detail

/// The tip of a slender rod of half length l, inertia m l^2/3, at the angle t to a floor
/// accelerates by N/m (1 + 3 cos t (cos t - mu sin t)) away from it if the rod slides with its
/// centre behind the tip. At mu = 2 and tan t = 2 that is -0.8 N/m: pushing draws the tip in, and a
/// force that holds the contact closed does not exist (P. Painleve, 1895; mu > 4/3 is needed). Over
/// one step an impulse exists, the tip sticks, and no energy comes of it.
template <class ShapeT>
void painleve(Record& record) {
  using S = SpaceOf<ShapeT>;
  const double angle = std::atan(2.0), thickness = 0.01, length = 1, h = 1e-3;
  auto half = S::Vector::Constant(thickness / 2).eval();
  half[0] = length / 2;
  int insane = 0, unsolved = 0;
  double gained = 0;
  for (const double direction : {-1.0, 1.0})
    for (const double fall : {0.0, 0.1}) {
      const double height = std::sin(angle) * length / 2 + std::cos(angle) * thickness / 2;
      OnFloor<ShapeT> scene(cuboid<ShapeT>(half), {in_plane<S>(0, height), S::exp(turn<S>(angle))},
                            Coulomb<ShapeT>(2));
      scene.world.set_solver(moreau::ColouredGaussSeidel());
      scene.world.set_velocity(scene.grain, in_plane<S>(5 * direction, -fall));
      const double start = energy(scene.world), unit = mass(scene.world) * gravity * length;
      double work = 0;
      for (int k = 0; k < 200; ++k) {
        const moreau::StepReport report = scene.world.step(h);
        insane += !detail::is_sane(report) || !detail::is_finite(scene.world);
        unsolved += !report.solve.converged;
        work += std::abs(report.correction.work);
        gained = std::max(gained, (energy(scene.world) - work - start) / unit);
      }
    }
  const std::string name = with_shape<ShapeT>("Painleve's rod") + ": ";
  record.vanishes(name + "steps with numbers that are not finite", S{}, insane, 0);
  record.vanishes(name + "steps not solved", S{}, unsolved, 0);
  // The gap of a rotating tip is linear in a step up to (w h)^2/2 of the lever, w at most some v/l:
  // an energy of m g l (v h/l)^2 per step, 2.5e-5 of m g l.
  record.vanishes(name + "energy gained over m g l", S{}, gained, 200 * 2.5e-5);
}

template <class T>
void painleve_rod(Record& record, Effort) {
  painleve<Polyhedron<T>>(record);
  painleve<Polygon<T>>(record);
}

}  // namespace validation
