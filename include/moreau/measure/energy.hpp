// SPDX-License-Identifier: MIT
// Kinetic energy, linear and angular momentum of rigid bodies.
#pragma once

#include <cstddef>

#include "moreau/core/components.hpp"
#include "moreau/core/double_sum.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/core/value.hpp"

namespace moreau {

/// Mass, inertia and motion of a body, in world axes.
template <class S>
struct BodyMotion {
  typename S::Scalar mass = 0;                       ///< [kg]
  typename S::Inertia inertia = S::Inertia::Zero();  ///< about the centre of mass [kg m^2]
  typename S::Vector position = S::Vector::Zero();   ///< position of the centre of mass [m]
  typename S::Twist velocity = S::Twist::Zero();     ///< twist (v, w) of the centre of mass [m/s,
                                                     ///< rad/s]

  BodyMotion() = default;  ///< mass 0, at rest at the origin
  /// @param m       mass [kg]
  /// @param about_x inertia tensor about the centre of mass, A x A, world axes [kg m^2]
  /// @param x       position of the centre of mass [m]
  /// @param v       twist (v, w) [m/s, rad/s]
  BodyMotion(typename S::Scalar m, const typename S::Inertia& about_x, const VectorArgument<S>& x,
             const Components<S::dofs, typename S::Scalar>& v)
      : mass(m), inertia(about_x), position(x), velocity(v) {}
};

/// Kinetic energy of one body or the sum over many bodies, >= 0.
template <class S>
struct KineticEnergy {
  typename S::Scalar translation = 0;  ///< m v^2/2 of the centre of mass [J]
  typename S::Scalar rotation = 0;     ///< w.I w/2 [J]

  typename S::Scalar total() const { return translation + rotation; }  ///< sum of both parts [J]
};

/// Linear and angular momentum of one body or the sum over many bodies, world axes.
template <class S>
struct Momentum {
  Value<typename S::Vector> linear = S::Vector::Zero();     ///< m v [kg m/s]
  Value<typename S::Angular> angular = S::Angular::Zero();  ///< about the given origin [kg m^2/s]
};

/// Kinetic energy of one body: m v^2/2 of the translation and w.I w/2 of the rotation [J].
template <class S>
KineticEnergy<S> kinetic_energy(const BodyMotion<S>& body) {
  const auto v = linear<S>(body.velocity);
  const auto w = angular<S>(body.velocity);
  return {body.mass * v.squaredNorm() / 2, w.dot(body.inertia * w) / 2};
}

/// Momentum of one body: linear momentum m v [kg m/s] and angular momentum I w + r x m v about
/// `origin` [kg m^2/s]. r is the vector from `origin` (world axes [m]) to the centre of mass.
template <class S>
Momentum<S> momentum(const BodyMotion<S>& body,
                     const VectorArgument<S>& origin = S::Vector::Zero()) {
  const typename S::Vector p = body.mass * linear<S>(body.velocity);
  return {p, body.inertia * angular<S>(body.velocity) + S::moment(body.position - origin, p)};
}

/// Kinetic energy of many bodies [J].
/// @param count     number of bodies
/// @param motion_of function: k -> BodyMotion of body k, for k < count
template <class S, class MotionOf>
KineticEnergy<S> kinetic_energy(std::size_t count, const MotionOf& motion_of) {
  double translation = 0, rotation = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const KineticEnergy<S> part = kinetic_energy<S>(motion_of(k));
    translation += double(part.translation);
    rotation += double(part.rotation);
  }
  using Scalar = typename S::Scalar;
  return {Scalar(translation), Scalar(rotation)};
}

namespace detail {

/// Mass, inertia, position and velocity of grain k of a simulation.
template <class Simulation>
BodyMotion<typename Simulation::S> motion_of_grain(const Simulation& simulation, std::size_t k) {
  const auto& bodies = simulation.bodies();
  const std::size_t i = simulation.grain(k).index();
  return {bodies.grain_mass[i], bodies.inertia(i, bodies.pose[i].rotation), bodies.pose[i].position,
          bodies.velocity[i]};
}

}  // namespace detail

/// Kinetic energy of all grains of a simulation [J]. Grains whose motion is prescribed count too. In a cell that deforms, of
/// the velocities relative to the cell.
/// @param simulation a Simulation
template <class Simulation>
KineticEnergy<typename Simulation::S> kinetic_energy(const Simulation& simulation) {
  return kinetic_energy<typename Simulation::S>(simulation.grain_count(), [&](std::size_t k) {
    return detail::motion_of_grain(simulation, k);
  });
}

/// Sum of the momenta of many bodies.
/// @param count     number of bodies
/// @param motion_of function: k -> BodyMotion of body k, for k < count
/// @param origin    the point about which the angular momentum is taken, world axes [m]
template <class S, class MotionOf>
Momentum<S> momentum(std::size_t count, const MotionOf& motion_of,
                     const VectorArgument<S>& origin = S::Vector::Zero()) {
  detail::DoubleSum<typename S::Vector> linear;
  detail::DoubleSum<typename S::Angular> angular;
  for (std::size_t k = 0; k < count; ++k) {
    const Momentum<S> part = momentum<S>(motion_of(k), origin);
    linear += part.linear;
    angular += part.angular;
  }
  return {linear.value(), angular.value()};
}

/// Momentum of all grains of a simulation. Grains whose motion is prescribed count too.
/// @param simulation a Simulation
/// @param origin     the point about which the angular momentum is taken, world axes [m]. In a periodic cell the angular
///                   momentum depends on the images of the grains, which are those of their poses
template <class Simulation>
Momentum<typename Simulation::S> momentum(
    const Simulation& simulation,
    const VectorArgument<typename Simulation::S>& origin = Simulation::S::Vector::Zero()) {
  return momentum<typename Simulation::S>(
      simulation.grain_count(),
      [&](std::size_t k) { return detail::motion_of_grain(simulation, k); }, origin);
}

}  // namespace moreau
