// SPDX-License-Identifier: MIT
#include "moreau/motion/body_motion.hpp"

#include <algorithm>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "conformance/integrator.hpp"

using namespace moreau;

TEST_CASE_TEMPLATE("a pose advances along the twist", S, Space<2>, Space<3>) {
  Pose<S> pose;
  pose.position = S::Vector::Constant(1);
  typename S::Twist twist = S::Twist::Zero();
  twist[0] = 2, twist[S::dofs - 1] = 0.4;
  advance_pose<S>(pose, twist, 0.5);
  CHECK(pose.position[0] == 2);
  CHECK(pose.position[1] == 1);
  const typename S::Vector turned = pose.rotation * S::Vector::UnitX();
  CHECK(turned[0] == doctest::Approx(std::cos(0.2)));
  CHECK(turned[1] == doctest::Approx(std::sin(0.2)));
}

TEST_CASE_TEMPLATE("forces change the velocity along axes with an inverse mass only", S, Space<2>,
                   Space<3>) {
  conformance::FreeBody<S> body(2, conformance::uneven_inertia<S>());
  body.bodies.force[0][0] = 6;
  const typename S::Vector load = 4 * S::Vector::UnitX(), gravity = -10 * S::Vector::UnitY();
  typename S::Vector change = velocity_change<S>(body.bodies, 0, load, gravity, 0.1);
  CHECK(change[0] == doctest::Approx(0.1 * (6 + 4) / 2));
  CHECK(change[1] == doctest::Approx(-1));
  body.bodies.inverse_mass[0] = S::Vector::UnitX() / 2;
  change = velocity_change<S>(body.bodies, 0, load, gravity, 0.1);
  CHECK(change[0] == doctest::Approx(0.5));
  CHECK(change[1] == 0);
}

TEST_CASE("the spin at the end of a rotation has the angular momentum that is given") {
  using S = Space<3>;
  conformance::FreeBody<S> body(1, conformance::uneven_inertia<S>());
  const Eigen::Vector3d momentum(1, -2, 3);
  const Eigen::Vector3d spin = spin_after<S>(body.bodies, 0, momentum, {1, 1, 1}, 0.2);
  const Eigen::Vector3d result = body.bodies.inertia(0, S::exp(0.2 * spin)) * spin;
  CHECK((result - momentum).norm() < 1e-14);
}

// In steps of theta = 1/2. If the length of the quaternion is not 1 on average, the momentum drifts by two roundings per step.
TEST_CASE_TEMPLATE("a free body keeps its angular momentum over 40000 steps", T, float, double) {
  using S = Space<3, T>;
  using Angular = typename S::Angular;
  for (const T half : {T(1e-3), T(2.5e-4)})
    for (const T first : {T(1), T(3)}) {
      conformance::FreeBody<S> body(
          1, Eigen::Matrix<T, 3, 1>(T(0.089), T(0.073), T(0.034)).asDiagonal());
      Bodies<S>& bodies = body.bodies;
      Pose<S>& pose = bodies.pose[0];
      pose.rotation = S::exp(Angular(T(0.3), T(-0.7), T(1.1)));
      Angular w(first, 10 - first, T(0.5));
      const auto momentum = [&] { return Angular(product(bodies.inertia(0, pose.rotation), w)); };
      const auto advance = [&] {
        typename S::Twist twist = S::Twist::Zero();
        angular<S>(twist) = w;
        advance_pose<S>(pose, twist, half);
      };
      const Angular start = momentum();
      T worst = 0;
      constexpr int steps = 40000;
      for (int k = 0; k < steps; ++k) {
        const Angular before = momentum();
        advance();
        w = product(inverse_of(typename S::Inertia(bodies.inertia(0, pose.rotation))), before);
        w = spin_after<S>(bodies, 0, momentum(), w, half);
        advance();
        worst = std::max(worst, T((momentum() - start).norm() / start.norm()));
      }
      CHECK(worst < T(steps) * std::numeric_limits<T>::epsilon() / 2);
    }
}

TEST_CASE("the spin of slender bodies meets the angular momentum for large rotations") {
  using S = Space<3>;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double turn : {0.3, 0.8, 1.5}) {
    CAPTURE(turn);
    int missed = 0;
    for (int k = 0; k < 300; ++k) {
      conformance::FreeBody<S> body(1, Eigen::Vector3d(1, 0.95, 0.1).asDiagonal());
      body.bodies.pose[0].rotation = S::exp({normal(random), normal(random), normal(random)});
      const Eigen::Vector3d axis(normal(random), normal(random), normal(random));
      const Eigen::Vector3d start = turn * axis.normalized();
      const Eigen::Vector3d momentum = body.bodies.inertia(0, body.bodies.pose[0].rotation) * start;
      const Eigen::Vector3d spin = spin_after<S>(body.bodies, 0, momentum, start, 1);
      const Eigen::Vector3d result =
          body.bodies.inertia(0, S::exp(spin) * body.bodies.pose[0].rotation) * spin;
      missed += (result - momentum).norm() > 1e-12 * momentum.norm();
    }
    CHECK(missed == 0);
  }
}
