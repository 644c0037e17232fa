// SPDX-License-Identifier: MIT
// Shared by several cases, written once for plane and space.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "moreau/measure/energy.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "record.hpp"
#include "world.hpp"

namespace validation {

using moreau::BodyId;
using moreau::cuboid;
using moreau::Materials;
using moreau::Pose;
using moreau::SpaceOf;

constexpr double gravity = 9.81;  ///< [m/s^2]

/// Options of the solver for answers that are exact.
inline moreau::ColouredOptions tight(double tolerance = 1e-12) {
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 20000;
  return options;
}

/// A bound that is at least some roundings of the scalar.
template <class S>
double resolved(double fine, double roundings = 100) {
  return std::max(fine, roundings * double(std::numeric_limits<typename S::Scalar>::epsilon()));
}

/// The solver; the default is the one that goes with the law.
template <class ShapeT, class Law, class Solver = moreau::DefaultSolver<Law, SpaceOf<ShapeT>>>
Solver solver_of(const moreau::ColouredOptions& options) {
  typename Solver::Options own;
  own.tolerance = resolved<SpaceOf<ShapeT>>(options.tolerance);
  own.max_sweeps = options.max_sweeps;
  return Solver(own);
}

/// Whether the law is set-valued, so that theta and the solver have an effect.
template <class ShapeT, class Law>
constexpr bool is_rigid = moreau::SetValuedLaw<Law, SpaceOf<ShapeT>>;

/// @param theta of the integrator, for a set-valued law
template <class ShapeT, class Law, class Solver = moreau::DefaultSolver<Law, SpaceOf<ShapeT>>>
World<ShapeT, Law, Solver> world_of(double size, const Law& law,
                                    const moreau::ColouredOptions& options = tight(),
                                    const moreau::Tolerances& tolerances = {}, double theta = 0.5) {
  const Materials<Law> materials(1, law);
  if constexpr (is_rigid<ShapeT, Law>)
    return World<ShapeT, Law, Solver>(size, materials, solver_of<ShapeT, Law, Solver>(options),
                                      tolerances, {}, moreau::MoreauJean(theta));
  else
    return World<ShapeT, Law>(size, materials, tolerances);
}

/// Turns off the overlap correction. Its ten sweeps do not converge, depend on the order of the
/// bodies, and move bodies independently of their velocities.
template <class ShapeT, class Law, class Solver>
void without_correction(World<ShapeT, Law, Solver>& world) {
  if constexpr (is_rigid<ShapeT, Law>) {
    moreau::OverlapCorrectionOptions off;
    off.enabled = false;
    world.set_correction(off);
  }
}

template <class ShapeT>
constexpr bool is_round = std::is_constructible_v<ShapeT, double>;

/// A ball, or a cube around it.
template <class ShapeT>
ShapeT regular(double radius) {
  if constexpr (is_round<ShapeT>)
    return ShapeT(radius);
  else
    return cuboid<ShapeT>(SpaceOf<ShapeT>::Vector::Constant(radius));
}

/// The name of a case with the shape appended, such as "silo, polygon".
template <class ShapeT>
std::string with_shape(const std::string& name) {
  constexpr bool plane = SpaceOf<ShapeT>::dim == 2;
  return name + (is_round<ShapeT> ? (plane ? ", disk" : ", sphere")
                                  : (plane ? ", polygon" : ", polyhedron"));
}
/// The name of a case with the regularized law appended, such as "silo, linear springs".
template <class Law>
std::string with_law(const std::string& name) {
  if constexpr (requires(const Law& law) { law.stiffness(); }) return name + ", linear springs";
  if constexpr (requires(const Law& law) { law.young(); }) return name + ", Hertz-Mindlin";
  return name;
}
/// The name of a case, with ", theta = 1" appended if theta is 1.
inline std::string with_theta(double theta, const std::string& name) {
  return theta == 1 ? name + ", theta = 1" : name;
}

/// A vector in the plane of the first and the last axis.
template <class S>
typename S::Vector in_plane(double across, double height) {
  typename S::Vector x = S::Vector::Zero();
  x[0] = across;
  x[S::dim - 1] = height;
  return x;
}
/// An angular quantity of that plane, positive from the first axis towards the last.
template <class S>
typename S::Angular turn(double angle) {
  return S::moment(in_plane<S>(1, 0), in_plane<S>(0, angle));
}
/// Gravity relative to a floor that is tilted towards +x [m/s^2].
template <class S>
typename S::Vector tilted_gravity(double tilt) {
  return gravity * in_plane<S>(std::sin(tilt), -std::cos(tilt));
}

template <class ShapeT, class Law>
moreau::BodyMotion<SpaceOf<ShapeT>> motion_of(const World<ShapeT, Law>& world, std::size_t grain) {
  const std::size_t i = world.grain(grain).index();
  const auto& bodies = world.bodies();
  return {bodies.grain_mass[i], bodies.inertia(i, bodies.pose[i].rotation), bodies.pose[i].position,
          bodies.velocity[i]};
}
/// Kinetic energy of all grains [J].
template <class ShapeT, class Law>
double kinetic_energy(const World<ShapeT, Law>& world) {
  return moreau::kinetic_energy(world).total();
}
/// Kinetic and potential energy of all grains [J].
template <class ShapeT, class Law>
double energy(const World<ShapeT, Law>& world) {
  double sum = kinetic_energy(world);
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const std::size_t i = world.grain(k).index();
    sum -= world.bodies().grain_mass[i] * world.gravity().dot(world.bodies().pose[i].position);
  }
  return sum;
}
template <class ShapeT, class Law>
moreau::Momentum<SpaceOf<ShapeT>> momentum(const World<ShapeT, Law>& world) {
  return moreau::momentum<SpaceOf<ShapeT>>(world.grain_count(),
                                           [&](std::size_t k) { return motion_of(world, k); });
}
/// Mass of all grains [kg].
template <class ShapeT, class Law>
double mass(const World<ShapeT, Law>& world) {
  double sum = 0;
  for (const double weight : world.bodies().grain_mass) sum += weight;
  return sum;
}

/// One grain above a floor through the origin; gravity is tilted by an angle towards +x.
template <class ShapeT, class Law = Coulomb<ShapeT>>
struct OnFloor {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  World<ShapeT, Law> world;
  BodyId grain;

  OnFloor(const ShapeT& shape, const Pose<S>& pose, const Law& law, double tilt = 0,
          double theta = 0.5)
      : world(world_of<ShapeT, Law>(0.1, law, tight(), {}, theta)) {
    grain = world.add_grain(world.add_shape(shape), pose, 1000);
    world.add_wall(Vector::Unit(up), Vector::Zero());
    world.set_gravity(tilted_gravity<S>(tilt));
  }
  OnFloor(const ShapeT& shape, double height, const Law& law, double tilt = 0, double theta = 0.5)
      : OnFloor(shape, Pose<S>{in_plane<S>(0, height)}, law, tilt, theta) {}

  const Pose<S>& pose() const { return world.pose(grain); }
  const typename S::Twist& twist() const { return world.bodies().velocity[grain.index()]; }
  double along() const { return twist()[0]; }    ///< velocity [m/s]
  double upward() const { return twist()[up]; }  ///< velocity [m/s]
  double spin() const { return twist().template tail<S::angular_dim>().norm(); }  ///< [rad/s]
};

/// 2/(D + 2), the ratio I/(m R^2) of a sphere and a disk.
template <class S>
constexpr double gyration = 2.0 / (S::dim + 2);

}  // namespace validation
