// SPDX-License-Identifier: MIT
#include "moreau/integrate/moreau_jean.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/integrate/concepts.hpp"

using moreau::Bodies;
using moreau::MoreauJean;
using moreau::Space;

static_assert(moreau::TimeIntegrator<MoreauJean, Space<2>>);
static_assert(moreau::TimeIntegrator<MoreauJean, Space<3, float>>);

namespace {

/// One free body.
template <class S>
struct FreeBody {
  Bodies<S> bodies;
  std::vector<typename S::Angular> momentum{1};
  std::vector<typename S::Twist> free{1};

  FreeBody(double mass, const typename S::Inertia& inertia) {
    bodies.pose.emplace_back();
    bodies.velocity.push_back(S::Twist::Zero());
    bodies.force.push_back(S::Twist::Zero());
    bodies.inverse_mass.push_back(S::Vector::Constant(1 / mass));
    bodies.inertia_body.push_back(inertia);
    bodies.inverse_inertia_root_body.push_back(moreau::inverse_root<S>(inertia));
    bodies.weight.push_back(mass);
    bodies.material.push_back(moreau::MaterialId(0));
  }
  void step(const MoreauJean& integrator, const typename S::Vector& gravity, double h) {
    integrator.predict_configuration(bodies, std::span(momentum), h);
    integrator.free_velocity(bodies, gravity, std::span(momentum), std::span(free), h);
    integrator.advance_configuration(bodies, std::span<const typename S::Twist>(free), h);
  }
  typename S::Angular angular_momentum() const {
    return bodies.inertia(0, bodies.pose[0].rotation) *
           bodies.velocity[0].template tail<S::angular_dim>();
  }
  double rotation_energy() const {
    return bodies.velocity[0].template tail<S::angular_dim>().dot(angular_momentum()) / 2;
  }
};

}  // namespace

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
  // The growing direction of the linearized equations, in body axes.
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
