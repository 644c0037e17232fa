// SPDX-License-Identifier: MIT
#include "moreau/motion/moreau_jean.hpp"

#include <cmath>
#include <doctest/doctest.h>

#include "conformance/integrator.hpp"

using conformance::FreeBody;
using moreau::MoreauJean;
using moreau::Space;

static_assert(moreau::TimeIntegrator<MoreauJean, Space<2>>);
static_assert(moreau::TimeIntegrator<MoreauJean, Space<3, float>>);

TEST_CASE_TEMPLATE("free fall: v exact, x exact at theta = 1/2", S, Space<2>, Space<3>) {
  FreeBody<S> body(2, S::Inertia::Identity());
  typename S::Vector gravity = S::Vector::Zero();
  gravity[S::dim - 1] = -9.81;
  const double h = 1e-3;
  for (int k = 0; k < 1000; ++k) body.step(MoreauJean(), gravity, h);
  CHECK(body.bodies.velocity[0][S::dim - 1] == doctest::Approx(-9.81).epsilon(1e-12));
  CHECK(body.bodies.pose[0].position[S::dim - 1] == doctest::Approx(-9.81 / 2).epsilon(1e-12));
}

TEST_CASE("a free asymmetric top keeps its angular momentum; energy errs with h squared") {
  const Eigen::Vector3d moments(1, 2, 3);
  double errors[2];
  for (int refine = 0; refine < 2; ++refine) {
    FreeBody<Space<3>> body(1, moments.asDiagonal());
    body.bodies.velocity[0].tail<3>() << 1.0, 2.0, 0.5;
    const Eigen::Vector3d momentum = body.angular_momentum();
    const double energy = body.rotation_energy();
    const int steps = 2000 << refine;
    double worst = 0;
    for (int k = 0; k < steps; ++k) {
      body.step(MoreauJean(), Eigen::Vector3d::Zero(), 10.0 / steps);
      worst = std::max(worst, std::abs(body.rotation_energy() - energy));
    }
    CHECK((body.angular_momentum() - momentum).norm() < 1e-10 * momentum.norm());
    errors[refine] = worst;
  }
  CHECK(errors[0] / errors[1] == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("rotation about the middle axis is unstable at the rate of Euler's equations") {
  const double i1 = 1, i2 = 2, i3 = 3, spin = 1;
  FreeBody<Space<3>> body(1, Eigen::Vector3d(i1, i2, i3).asDiagonal());
  const double rate = spin * std::sqrt((i2 - i1) * (i3 - i2) / (i1 * i3));
  // The growing mode of the linearized equations of motion, in body axes.
  body.bodies.velocity[0].tail<3>() << 1e-6, spin,
      -1e-6 * std::sqrt(i1 * (i2 - i1) / (i3 * (i3 - i2)));
  const auto aside = [&] {
    const Eigen::Vector3d w =
        body.bodies.pose[0].rotation.inverse() * Eigen::Vector3d(body.bodies.velocity[0].tail<3>());
    return std::hypot(w[0], w[2]);
  };
  const double start = aside();
  for (int k = 0; k < 6000; ++k) body.step(MoreauJean(), Eigen::Vector3d::Zero(), 1e-3);
  CHECK(std::log(aside() / start) / 6 == doctest::Approx(rate).epsilon(1e-3));
}

TEST_CASE("fast spin: Newton converges where a fixed point would not") {
  FreeBody<Space<3>> body(1, Eigen::Vector3d(1, 2, 3).asDiagonal());
  body.bodies.velocity[0].tail<3>() << 3.0, 0.2, 4.0;
  const Eigen::Vector3d momentum = body.angular_momentum();
  for (int k = 0; k < 1000; ++k) body.step(MoreauJean(), Eigen::Vector3d::Zero(), 0.1);
  CHECK((body.angular_momentum() - momentum).norm() < 1e-10 * momentum.norm());
}

TEST_CASE("theta out of range is named") {
  CHECK_THROWS_WITH_AS(MoreauJean(0.2), "MoreauJean: theta = 0.2 must lie in [0.5, 1]",
                       std::invalid_argument);
}
