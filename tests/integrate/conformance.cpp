// SPDX-License-Identifier: MIT
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"

#include "conformance/integrator.hpp"
#include "own_integrator/explicit_contacts.hpp"
#include "own_integrator/symplectic_euler.hpp"

using moreau::Space;

TEST_CASE_TEMPLATE("integrators", S, Space<2>, Space<3>) {
  conformance::integrator<S>(moreau::MoreauJean());
  conformance::integrator<S>(moreau::MoreauJean(1));
  conformance::integrator<S>(moreau::VelocityVerlet());
  conformance::integrator<S>(SymplecticEuler());
  conformance::integrator<S>(ExplicitContacts());
}

TEST_CASE("Verlet errs with the square of the step") {
  // A harmonic oscillator: the load is -k x.
  double errors[2];
  for (int refine = 0; refine < 2; ++refine) {
    conformance::FreeBody<Space<2>> body(1, conformance::uneven_inertia<Space<2>>());
    body.bodies.pose[0].position.x() = 1;
    const int steps = 200 << refine;
    const auto load = [&] {
      body.loads[0].setZero();
      body.loads[0][0] = -4 * body.bodies.pose[0].position.x();
      return std::span<const Eigen::Vector3d>(body.loads);
    };
    const moreau::VelocityVerlet verlet;
    for (int k = 0; k < steps; ++k) {
      verlet.predict_configuration(body.bodies, load(), Eigen::Vector2d(0, 0), 5.0 / steps);
      verlet.advance_configuration(body.bodies, load(), Eigen::Vector2d(0, 0), 5.0 / steps);
    }
    errors[refine] = std::abs(body.bodies.pose[0].position.x() - std::cos(10.0));
  }
  CHECK(errors[0] / errors[1] == doctest::Approx(4).epsilon(0.05));
}
