// SPDX-License-Identifier: MIT
// Energy and momentum of rigid bodies.
#pragma once

#include <cmath>
#include <cstddef>

#include "moreau/core/components.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"

namespace moreau {

/// Mass, inertia and motion of a body, in world axes.
template <class S>
struct BodyMotion {
  typename S::Scalar mass = 0;                       ///< [kg]
  typename S::Inertia inertia = S::Inertia::Zero();  ///< about the centre of mass [kg m^2]
  typename S::Vector position = S::Vector::Zero();   ///< of the centre of mass [m]
  typename S::Twist velocity = S::Twist::Zero();     ///< (v, w) [m/s, rad/s]

  BodyMotion() = default;  ///< no mass, at rest at the origin
  /// @param m       mass [kg]
  /// @param about_x inertia, A x A, about the centre of mass [kg m^2]
  /// @param x       position of the centre of mass [m]
  /// @param v       twist (v, w) [m/s, rad/s]
  BodyMotion(typename S::Scalar m, const typename S::Inertia& about_x, const VectorArgument<S>& x,
             const Components<S::dofs, typename S::Scalar>& v)
      : mass(m), inertia(about_x), position(x), velocity(v) {}
};

/// Kinetic energy of one body or of many, >= 0.
template <class S>
struct KineticEnergy {
  typename S::Scalar translation = 0;  ///< m v^2/2 [J]
  typename S::Scalar rotation = 0;     ///< w.I w/2 [J]

  typename S::Scalar total() const { return translation + rotation; }  ///< of both [J]
};

/// Momentum of one body or of many, world axes.
template <class S>
struct Momentum {
  typename S::Vector linear = S::Vector::Zero();     ///< [kg m/s]
  typename S::Angular angular = S::Angular::Zero();  ///< about the given origin [kg m^2/s]
};

/// Kinetic energy of one body: m v^2/2 and w.I w/2 [J].
template <class S>
KineticEnergy<S> kinetic_energy(const BodyMotion<S>& body) {
  const auto v = linear<S>(body.velocity);
  const auto w = angular<S>(body.velocity);
  return {body.mass * v.squaredNorm() / 2, w.dot(body.inertia * w) / 2};
}

/// Momentum of one body: m v [kg m/s], and I w + r x m v [kg m^2/s] with r from `origin` (world
/// axes [m]) to the centre of mass.
template <class S>
Momentum<S> momentum(const BodyMotion<S>& body,
                     const VectorArgument<S>& origin = S::Vector::Zero()) {
  const typename S::Vector p = body.mass * linear<S>(body.velocity);
  return {p, body.inertia * angular<S>(body.velocity) + S::moment(body.position - origin, p)};
}

/// Kinetic energy of many bodies [J].
/// @param count     number of bodies
/// @param motion_of k -> BodyMotion<S> of body k, k < count
template <class S, class MotionOf>
KineticEnergy<S> kinetic_energy(std::size_t count, const MotionOf& motion_of) {
  KineticEnergy<S> sum;
  for (std::size_t k = 0; k < count; ++k) {
    const KineticEnergy<S> part = kinetic_energy<S>(motion_of(k));
    sum.translation += part.translation;
    sum.rotation += part.rotation;
  }
  return sum;
}

/// Momentum of many bodies; angular momentum about the origin.
/// @param count     number of bodies
/// @param motion_of k -> BodyMotion<S> of body k, k < count
/// @param origin    world axes [m]
template <class S, class MotionOf>
Momentum<S> momentum(std::size_t count, const MotionOf& motion_of,
                     const VectorArgument<S>& origin = S::Vector::Zero()) {
  Momentum<S> sum;
  for (std::size_t k = 0; k < count; ++k) {
    const Momentum<S> part = momentum<S>(motion_of(k), origin);
    sum.linear += part.linear;
    sum.angular += part.angular;
  }
  return sum;
}

}  // namespace moreau
