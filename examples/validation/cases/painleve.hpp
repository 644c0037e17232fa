// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "is_sane.hpp"
#include "scene.hpp"

namespace validation {

/// A rod as a cuboid whose long axis, of length `length`, stands at an angle to the floor. In space
/// it touches the floor with its lowest edge, at two points, or with a corner if it is rotated
/// about its axis.
template <class ShapeT>
struct Rod {
  using S = SpaceOf<ShapeT>;
  static constexpr double angle = 1.1071487177940904;  ///< atan 2
  static constexpr double length = 1, thickness = 0.01, friction = 2;

  double half_width, height;
  OnFloor<ShapeT> scene;
  // Of the lowest point: the vector from the centre of mass, and the Delassus block of t and n
  // times the mass.
  double x, z, inertia = (length * length + thickness * thickness) / 12, w_nn, w_tt, w_nt;

  explicit Rod(bool on_corner = false)
      : half_width(thickness / 2 * (on_corner ? std::sqrt(S::dim - 1.0) : 1)),
        height(std::sin(angle) * length / 2 + std::cos(angle) * half_width),
        scene(cuboid<ShapeT>(half()),
              {in_plane<S>(0, height), S::exp(turn<S>(angle)) * about_itself(on_corner)},
              Coulomb<ShapeT>(friction)),
        x(-std::cos(angle) * length / 2 + std::sin(angle) * half_width),
        z(-height),
        w_nn(1 + x * x / inertia),
        w_tt(1 + z * z / inertia),
        w_nt(-x * z / inertia) {}

  static typename S::Rotation about_itself([[maybe_unused]] bool on_corner) {
    if constexpr (S::dim == 3)
      if (on_corner) return S::exp(std::numbers::pi / 4 * S::Angular::UnitX());
    return S::identity();
  }
  static typename S::Vector half() {
    typename S::Vector half = S::Vector::Constant(thickness / 2);
    half[0] = length / 2;
    return half;
  }
};

/// One step from the velocity `speed` along the floor. If the tip slips, r_t = -+ mu r_n with r_n =
/// g h / (W_nn -+ mu W_nt). If this r_n is negative (Painleve's paradox), the tip sticks and W r =
/// -u. In space the rod stands on a corner: with two points the paradox has several solutions, and
/// the solver finds one in which one point slips.
template <class ShapeT>
void painleve_step(Record& record, double speed) {
  Rod<ShapeT> rod(true);
  using S = typename Rod<ShapeT>::S;
  const double h = 1e-3, sign = speed > 0 ? 1 : -1;
  auto& scene = rod.scene;
  scene.world.set_velocity(scene.grain, in_plane<S>(speed, 0));
  const moreau::StepReport report = scene.world.step(h);
  const double slipping = rod.w_nn - sign * Rod<ShapeT>::friction * rod.w_nt;
  const bool sticks = slipping < 0;
  const double spin = double(scene.twist().template tail<S::angular_dim>().dot(turn<S>(1)));
  const double slip = scene.along() - spin * rod.z, push = scene.upward() + gravity * h;
  const double det = rod.w_nn * rod.w_tt - rod.w_nt * rod.w_nt;
  const double expected =
      sticks ? (rod.w_tt * gravity * h + rod.w_nt * speed) / det : gravity * h / slipping;
  const std::string name = with_shape<ShapeT>("Painleve's rod") +
                           (sign > 0 ? ", pulled" : ", pushed") + " in the first step: ";
  record.vanishes(name + "a force would close the tip, 1 + 3 cos t (cos t - mu sin t) < 0", S{},
                  sticks != (sign < 0), 0);
  record.compare_relative(name + "impulse over the mass [m/s]", S{}, expected, push, 1e-6);
  if (sticks) record.vanishes(name + "slip of the tip [m/s]", S{}, slip, 1e-6);
  record.vanishes(name + "not solved", S{}, !report.solve.converged, 0);
}

/// A slender rod with half length l and inertia m l^2/3 stands at the angle t to a floor and slides
/// with its centre behind the tip. Its tip has the acceleration N/m (1 + 3 cos t (cos t - mu sin
/// t)) away from the floor. For mu = 2 and tan t = 2 this is -0.8 N/m: a normal force N pulls the
/// tip into the floor, so no force keeps the contact closed (P. Painleve, 1895; this needs mu >
/// 4/3). Over one step an impulse exists, the tip sticks, and the energy does not grow.
template <class ShapeT>
void painleve(Record& record) {
  using S = SpaceOf<ShapeT>;
  const double h = 1e-3, length = Rod<ShapeT>::length;
  int insane = 0, unsolved = 0;
  double gained = 0;
  for (const double direction : {-1.0, 1.0})
    for (const double fall : {0.0, 0.1}) {
      Rod<ShapeT> rod;
      auto& scene = rod.scene;
      scene.world.set_solver(moreau::ColouredGaussSeidel());
      scene.world.set_velocity(scene.grain, in_plane<S>(5 * direction, -fall));
      const double start = energy(scene.world), unit = mass(scene.world) * gravity * length;
      double work = 0;
      for (int k = 0; k < 200; ++k) {
        const moreau::StepReport report = scene.world.step(h);
        insane += !is_sane(report) || !is_finite(scene.world.bodies());
        unsolved += !report.solve.converged;
        work += std::abs(report.correction.work);
        gained = std::max(gained, (energy(scene.world) - work - start) / unit);
      }
    }
  for (const double speed : {-5.0, 5.0}) painleve_step<ShapeT>(record, speed);
  const std::string name = with_shape<ShapeT>("Painleve's rod") + ": ";
  record.vanishes(name + "steps with numbers that are not finite", S{}, insane, 0);
  record.vanishes(name + "steps not solved", S{}, unsolved, 0);
  // The gap of a rotating tip is linear in a step up to (w h)^2/2 of the lever, with w about v/l at
  // most: an energy of m g l (v h/l)^2 per step, 2.5e-5 of m g l.
  record.vanishes(name + "energy gained over m g l", S{}, gained, 200 * 2.5e-5);
}

template <class T>
void painleve_rod(Record& record, Effort) {
  painleve<Polyhedron<T>>(record);
  painleve<Polygon<T>>(record);
}

}  // namespace validation
