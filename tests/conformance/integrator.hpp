// SPDX-License-Identifier: MIT
// The requirements on every integrator, tested with free bodies. A new integrator is tested by one
// line:
//
//   TEST_CASE("mine") { conformance::integrator<moreau::Space<3>>(MyIntegrator()); }
#pragma once

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <span>
#include <vector>

#include "moreau/motion/concepts.hpp"

namespace conformance {

/// One body without contacts, for integrators of impulses and of forces.
template <class S>
struct FreeBody {
  using T = typename S::Scalar;
  moreau::Bodies<S> bodies;
  std::vector<typename S::Angular> momenta{1};
  std::vector<typename S::Twist> free{1}, loads{S::Twist::Zero()};

  FreeBody(T mass, const typename S::Inertia& inertia) {
    bodies.pose.emplace_back();
    bodies.velocity.push_back(S::Twist::Zero());
    bodies.force.push_back(S::Twist::Zero());
    bodies.inverse_mass.push_back(S::Vector::Constant(1 / mass));
    bodies.inertia_body.push_back(inertia);
    bodies.inverse_inertia_root_body.push_back(moreau::inverse_root<S>(inertia));
    bodies.grain_mass.push_back(mass);
    bodies.material.push_back(moreau::MaterialId(0));
    bodies.id.emplace_back();
  }
  template <class Integrator>
  void step(const Integrator& integrator, const typename S::Vector& gravity, T h) {
    if constexpr (moreau::ImpulseIntegrator<Integrator, S>) {
      integrator.predict_configuration(bodies, std::span(momenta), h);
      integrator.free_velocity(bodies, gravity, std::span(momenta), std::span(free), h);
      integrator.advance_configuration(bodies, std::span<const typename S::Twist>(free), h);
    } else {
      const std::span<const typename S::Twist> no_contacts(loads);
      integrator.predict_configuration(bodies, no_contacts, gravity, h);
      integrator.advance_configuration(bodies, no_contacts, gravity, h);
    }
  }
  auto spin() { return bodies.velocity[0].template tail<S::angular_dim>(); }
  typename S::Angular angular_momentum() {
    return bodies.inertia(0, bodies.pose[0].rotation) * spin();
  }
  double rotation_energy() { return double(spin().dot(angular_momentum())) / 2; }
};

/// Different principal moments of inertia in space; in the plane the only moment.
template <class S>
typename S::Inertia uneven_inertia() {
  typename S::Inertia inertia = S::Inertia::Zero();
  for (int k = 0; k < S::angular_dim; ++k) inertia(k, k) = typename S::Scalar(1 + k);
  return inertia;
}

/// Applies a constant force and torque to a body for one second and checks the change of its linear
/// and angular momentum in each component. The same is checked for contact loads, if the integrator
/// takes loads, and for a body that can move only along one oblique axis.
template <class S, class Integrator>
void check_forces(const Integrator& integrator, int steps, double rounding) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const T h = T(1) / T(steps);
  typename S::Twist force;
  for (int k = 0; k < S::dofs; ++k) force[k] = T(0.5) + T(0.25) * T(k);
  const auto torque = force.template tail<S::angular_dim>().eval();
  const auto push = force.template head<S::dim>().eval();
  constexpr bool has_loads = moreau::ForceIntegrator<Integrator, S>;
  for (const bool as_load : {false, has_loads}) {
    FreeBody<S> body(2, uneven_inertia<S>());
    (as_load ? body.loads[0] : body.bodies.force[0]) = force;
    for (int k = 0; k < steps; ++k) body.step(integrator, Vector::Zero(), h);
    const Vector v = body.bodies.velocity[0].template head<S::dim>();
    CHECK(double((2 * v - push).norm()) < steps * rounding * double(push.norm()));
    CHECK(double((body.angular_momentum() - torque).norm()) <
          steps * rounding * double(torque.norm()));
    CHECK(double((body.bodies.pose[0].position - push / 4).norm()) < double(h * push.norm()));
  }

  // A wall with a mass along its normal only.
  FreeBody<S> wall(1, uneven_inertia<S>());
  wall.bodies.inertia_body[0].setZero();
  wall.bodies.inverse_inertia_root_body[0].setZero();
  wall.bodies.grain_mass[0] = 0;
  wall.bodies.inverse_mass[0] = Vector::UnitX() / 2;
  const Vector normal = (Vector::Unit(0) + 2 * Vector::Unit(1)).normalized();
  wall.bodies.pose[0].rotation = S::normalized(typename S::Rotation(S::contact_frame(normal)));
  wall.bodies.force[0] = force;
  for (int k = 0; k < steps; ++k) wall.step(integrator, Vector::Unit(S::dim - 1), h);
  const Vector along = normal * normal.dot(push) / 2;
  CHECK(double((wall.bodies.velocity[0].template head<S::dim>() - along).norm()) <
        steps * rounding * double(push.norm()));
  CHECK(wall.spin().isZero(0));

  // A wall with a prescribed rotation.
  FreeBody<S> drum(1, uneven_inertia<S>());
  drum.bodies.inertia_body[0].setZero();
  drum.bodies.inverse_inertia_root_body[0].setZero();
  drum.spin() = torque;
  drum.bodies.force[0].template tail<S::angular_dim>() = torque;
  for (int k = 0; k < steps; ++k) drum.step(integrator, Vector::Zero(), h);
  CHECK(drum.spin() == torque);
  const typename S::Rotation turned = S::exp(torque);
  CHECK(
      double((drum.bodies.pose[0].rotation.toRotationMatrix() - turned.toRotationMatrix()).norm()) <
      steps * rounding);
}

/// Checks that in a fall the velocity is exact and the position accurate to first order in the
/// step; that a top without torques keeps its angular momentum, and its energy to 1 %; that forces
/// and torques have the right effect; and that a body whose motion is prescribed keeps its velocity.
template <class S, class Integrator>
requires moreau::TimeIntegrator<Integrator, S>
void integrator(const Integrator& integrator) {
  using T = typename S::Scalar;
  const double rounding = 100 * double(std::numeric_limits<T>::epsilon());
  const int steps = 1000;
  const T h = T(1) / steps;
  const typename S::Vector gravity = T(-9.81) * S::Vector::Unit(S::dim - 1);

  FreeBody<S> fall(2, uneven_inertia<S>());
  for (int k = 0; k < steps; ++k) fall.step(integrator, gravity, h);
  const double way = double(fall.bodies.pose[0].position[S::dim - 1]);
  CHECK(std::abs(double(fall.bodies.velocity[0][S::dim - 1]) + 9.81) < steps * rounding);
  CHECK(std::abs(way + 4.905) < 9.81 * double(h));

  FreeBody<S> top(1, uneven_inertia<S>());
  for (int k = 0; k < S::angular_dim; ++k) top.spin()[k] = T(1 + k % 2);
  const typename S::Angular momentum = top.angular_momentum();
  const double energy = top.rotation_energy();
  for (int k = 0; k < steps; ++k) top.step(integrator, S::Vector::Zero(), h);
  CHECK(double((top.angular_momentum() - momentum).norm()) <
        steps * rounding * double(momentum.norm()));
  CHECK(std::abs(top.rotation_energy() - energy) < 0.01 * energy);

  check_forces<S>(integrator, steps, rounding);

  FreeBody<S> driven(1, uneven_inertia<S>());
  driven.bodies.inverse_mass[0].setZero();
  driven.bodies.velocity[0][0] = 2;
  driven.bodies.force[0][0] = 5;
  for (int k = 0; k < steps; ++k) driven.step(integrator, gravity, h);
  CHECK(driven.bodies.velocity[0][0] == T(2));
  CHECK(std::abs(double(driven.bodies.pose[0].position[0]) - 2) < steps * rounding);
  CHECK(driven.bodies.pose[0].position[S::dim - 1] == T(0));
}

}  // namespace conformance
