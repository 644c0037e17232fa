// SPDX-License-Identifier: MIT
// One grain on a floor, for each law with springs: restitution of faces, edges and vertices; energy; springs
// on a turning floor.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>

#include "moreau/law/compliant.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"

#include "law/vertices_on_floor.hpp"

using namespace landing;

namespace {

using Linear = LinearSpringDashpot<double>;
using Hertz = HertzMindlin<double>;

/// The rotation by t about the first axis and part of t about the second.
template <class S>
typename S::Rotation tilted(double t, double part = 0) {
  typename S::Angular w = S::Angular::Zero();
  w[0] = t;
  if constexpr (S::angular_dim > 1) w[1] = part * t;
  return S::exp(w);
}

/// Duration of an impact of a grain on one vertex, about [s].
template <class S>
double duration(const Linear& law, const Grain<S>& grain) {
  return law.duration(grain.mass / 4);
}
template <class S>
double duration(const Hertz&, const Grain<S>&) {
  return 2e-4;
}

struct Rebound {
  std::size_t points = 0;  // that touched
  double restitution = 0;  // of the mean normal velocity of these points
  double energy = 0;       // kinetic, after over before
};

/// The first impact of a grain that falls with the speed [m/s]. Contacts end when the last point opens.
template <class S, class Law>
Rebound impact(const Grain<S>& grain, const Law& law, const typename S::Rotation& q, double speed,
               double h) {
  OnFloor<S, Law> world(grain, law, q, 1e-9);
  world.velocity()[world.up] = -speed;
  const double before = world.energy();
  Rebound rebound;
  std::vector<ContactKey> touched;
  for (int k = 0; k < 100000; ++k) {
    world.step(h);
    if (world.touches()) {
      if (!touched.empty()) continue;
      for (std::size_t c = 0; c < world.contacts.size(); ++c)
        if (world.contacts.impulses[c][0] > 0) touched.push_back(world.contacts.keys[c]);
    } else if (!touched.empty()) {
      break;
    }
  }
  for (std::size_t c = 0; c < world.contacts.size(); ++c) {
    if (std::find(touched.begin(), touched.end(), world.contacts.keys[c]) == touched.end())
      continue;
    ++rebound.points;
    rebound.restitution += relative_velocity(world.contacts.points[c], world.bodies.velocity[0],
                                             world.bodies.velocity[1])[0];
  }
  rebound.restitution /= speed * double(rebound.points);
  rebound.energy = world.energy() / before;
  return rebound;
}

}  // namespace

// The springs are stiff and the impacts slow: a grain turns by less than 0.001 rad during an impact.
TEST_CASE_TEMPLATE("springs: faces, edges and vertices have the restitution of the law", S,
                   Space<2>, Space<3>) {
  const auto check = [](const auto& law, double e, double tilt, double part) {
    for (const Grain<S>& grain : flat_grains(S())) {
      if (part == 0 && tilt > 0 && grain.name == "hull") continue;  // its edges lie askew
      CAPTURE(grain.name);
      CAPTURE(e);
      CAPTURE(tilt);
      const Rebound rebound =
          impact<S>(grain, law, tilted<S>(tilt, part), 0.01, duration(law, grain) / 200);
      CHECK(rebound.points >=
            (tilt == 0 || part == 0 ? std::size_t(S::dim == 2 && tilt > 0 ? 1 : 2) : 1));
      CHECK(std::abs(rebound.restitution - e) <= 0.01);
      CHECK(rebound.energy <= 1 + 1e-4);
    }
  };
  for (const double e : {0.2, 0.5, 0.9, 1.0})
    for (const double tilt : {0.0, 0.3}) {
      check(Linear(1e7, 0, 0, e), e, tilt, 0);
      check(Linear(1e7, 0, 0, e), e, tilt, 0.7);
      check(Hertz(1e9, 0, 0, e), e, tilt, 0);
    }
}

TEST_CASE_TEMPLATE("compliant: a face has the restitution of a point, (1 + e)/(1 + eps) - 1", S,
                   Space<2>, Space<3>) {
  using Law = Compliant<SignoriniCoulomb<double>>;
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double e : {0.5, 0.8, 1.0})
      for (const double eps : {1e-3, 2e-2}) {
        const double stiffness = 1e7, h = std::sqrt(grain.mass / (stiffness * eps));
        const Law law(SignoriniCoulomb<double>(0, e), stiffness);
        const Rebound rebound = impact<S>(grain, law, tilted<S>(0), 0.1, h);
        CAPTURE(grain.name);
        CAPTURE(e);
        CAPTURE(eps);
        CHECK(rebound.restitution == doctest::Approx((1 + e) / (1 + eps) - 1).epsilon(1e-4));
        CHECK(rebound.energy <= 1);
      }
}

TEST_CASE_TEMPLATE(
    "compliant: no impact makes energy, whether the step resolves the springs or not", S, Space<2>,
    Space<3>) {
  using Law = Compliant<SignoriniCoulomb<double>>;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto check = [&](const Grain<S>& grain, double e, double friction, double eps,
                         double tilt) {
    const double stiffness = 1e7, h = std::sqrt(grain.mass / (stiffness * eps));
    typename S::Angular turn;
    for (auto& x : turn) x = tilt * normal(random);
    OnFloor<S, Law> world(grain, Law(SignoriniCoulomb<double>(friction, e), stiffness),
                          S::exp(turn), 1e-9);
    for (int k = 0; k < S::dofs; ++k)
      world.velocity()[k] = friction * normal(random) * (k < S::dim ? 1 : 30);
    world.velocity()[world.up] = -1;
    const double before = world.energy();
    double most = 0;
    for (double time = 0; time < std::max(4 * h, 12 * std::sqrt(grain.mass / stiffness));
         time += h) {
      world.step(h);
      most = std::max(most, world.energy() + world.report.elastic_energy);
    }
    CAPTURE(grain.name);
    CAPTURE(e);
    CAPTURE(friction);
    CAPTURE(eps);
    CAPTURE(tilt);
    // A point has a share of the stiffness of the pair, which changes while further points come near.
    CHECK(most <= before * (tilt == 0 ? 1 + 1e-9 : 1.03));
  };
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double e : {0.2, 0.6, 1.0})
      for (const double friction : {0.0, 0.5})
        for (const double eps : {1e-3, 0.1, 1.0, 10.0, 300.0})
          for (const double tilt : {0.0, 0.02, 0.3}) check(grain, e, friction, eps, tilt);
}

TEST_CASE_TEMPLATE("springs: an impact takes energy, with friction and spin as well", S, Space<2>,
                   Space<3>) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto check = [&](const auto& law, const Grain<S>& grain, double tilt) {
    typename S::Angular turn;
    for (auto& x : turn) x = tilt * normal(random);
    OnFloor<S, std::decay_t<decltype(law)>> world(grain, law, S::exp(turn), 1e-9);
    for (int k = 0; k < S::dofs; ++k) world.velocity()[k] = normal(random) * (k < S::dim ? 1 : 30);
    world.velocity()[world.up] = -1;
    const double before = world.energy(), h = duration(law, grain) / 200;
    for (int k = 0; k < 1500; ++k) world.step(h);
    CAPTURE(grain.name);
    CAPTURE(tilt);
    CHECK(world.energy() <= before * (1 + 2e-4));
  };
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double tilt : {0.0, 1e-3, 0.02, 0.3})
      for (const double e : {0.5, 1.0}) {
        check(Linear(1e6, 7e5, 0.5, e), grain, tilt);
        check(Hertz(1e8, 5e7, 0.5, e), grain, tilt);
      }
}

TEST_CASE_TEMPLATE("springs without loss: the error of the energy falls as the square of the step",
                   S, Space<2>, Space<3>) {
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double tilt : {1e-3, 0.02, 0.3}) {
      const Linear law(1e6, 0, 0, 1);
      double errors[2];
      for (const int k : {0, 1})
        errors[k] = std::abs(impact<S>(grain, law, tilted<S>(tilt, 0.7), 1,
                                       duration(law, grain) / (k == 0 ? 100 : 400))
                                 .energy -
                             1);
      CAPTURE(grain.name);
      CAPTURE(tilt);
      CHECK(errors[0] <= 3e-3);
      CHECK(errors[1] <= 2e-4);
    }
}

TEST_CASE_TEMPLATE("springs: a damped grain that falls comes to rest", S, Space<2>, Space<3>) {
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double friction : {0.0, 0.4}) {
      const Linear law(1e5, 7e4, friction, 0.5);
      OnFloor<S, Linear> world(grain, law, tilted<S>(0.02, 0.7), 1e-3);
      world.gravity[world.up] = -9.81;
      const double h = duration(law, grain) / 30;
      const double rest = 1e-9 * grain.mass * 9.81 * 0.01;
      const auto rests = [&] { return world.touches() && world.kinetic_energy() < rest / 100; };
      while (world.time < 3 && (world.time < 0.1 || !rests())) world.step(h);
      CAPTURE(grain.name);
      CAPTURE(friction);
      CHECK(world.kinetic_energy() <= rest);
    }
}

TEST_CASE("springs: a grain that friction holds stays in its place on a turning floor") {
  using S = Space<3>;
  constexpr double radius = 0.1, h = 4e-4;
  const auto check = [&](const auto& law, const Grain<S>& grain, double spin, double stiffness) {
    OnFloor<S, std::decay_t<decltype(law)>> world(grain, law, S::identity(), -1e-6);
    world.gravity[2] = -9.81;
    world.bodies.velocity[0][5] = world.velocity()[5] = spin;
    world.bodies.pose[1].position[0] = radius;
    world.velocity()[1] = radius * spin;
    const double turn = 2 * std::numbers::pi / std::abs(spin);
    const auto angle = [&] {
      const auto& x = world.bodies.pose[1].position;
      return std::remainder(std::atan2(x[1], x[0]) - spin * world.time, 2 * std::numbers::pi);
    };
    while (world.time < turn) world.step(h);
    const double before = angle();
    while (world.time < 2 * turn) world.step(h);
    const double forgotten = 2 * std::numbers::pi * grain.mass * spin * spin * radius /
                             stiffness;  // by springs in world axes
    // A step along the tangent in place of the arc lags by (spin h)^3 / 12 on each side.
    const double chord = radius * turn / h * std::pow(std::abs(spin) * h, 3) / 6;
    CAPTURE(grain.name);
    CAPTURE(spin);
    CAPTURE(stiffness);
    CHECK(std::abs(angle() - before) * radius <= 0.02 * forgotten + 2 * chord);
  };
  const auto grains = flat_grains(S());
  for (const double spin : {3.0, -6.0})
    for (const double k : {3e2, 3e3})
      for (const std::size_t i : {0u, 2u, 4u})
        check(Compliant<SignoriniCoulomb<double>>(SignoriniCoulomb<double>(2), k), grains[i], spin,
              k);
}

TEST_CASE("springs: a load that turns with grain and floor keeps the grain in its place") {
  using S = Space<3>;
  const auto check = [&](const auto& law, const Grain<S>& grain, double spin) {
    OnFloor<S, std::decay_t<decltype(law)>> world(grain, law, S::identity(), -1e-6);
    world.gravity[2] = -9.81;
    world.bodies.velocity[0][5] = world.velocity()[5] = spin;
    const double turn = 2 * std::numbers::pi / std::abs(spin), load = 0.1 * grain.mass * 9.81;
    // The rod oscillates with a period of 0.56 ms: with the longer step its springs are lost again and again.
    const double h = grain.mass < 1e-3 ? 1e-5 : 5e-5;
    const auto run_to = [&](double end) {
      while (world.time < end) {
        const double angle = spin * (world.time + h);
        world.bodies.force[1][0] = load * std::cos(angle);
        world.bodies.force[1][1] = load * std::sin(angle);
        world.step(h);
      }
      const Eigen::Vector3d& x = world.bodies.pose[1].position;
      return Eigen::Vector2d(Eigen::Rotation2Dd(-spin * world.time) * Eigen::Vector2d(x[0], x[1]));
    };
    const Eigen::Vector2d before = run_to(turn), after = run_to(2 * turn);
    CAPTURE(grain.name);
    CAPTURE(spin);
    CHECK(before[0] > 1e-7);
    CHECK((after - before).norm() <= 0.05 * before[0]);  // in world axes: 2 pi before[0]
  };
  const auto grains = flat_grains(S());
  for (const std::size_t i : {0u, 1u, 2u, 3u, 4u, 6u, 10u, 11u})  // those that do not tip over
    for (const double spin : {20.0, -40.0}) {
      check(Linear(1e4, 1e2, 2, 0.2), grains[i], spin);
      check(Hertz(1e6, 2e4, 2, 0.2), grains[i], spin);
    }
}

TEST_CASE("springs: a cycle of shear and compression makes no energy under Hertz's law") {
  using S = Space<2>;
  const Hertz law(1e7, 5e6, 10, 1);
  for (int trial = 0; trial < 40; ++trial) {
    std::mt19937_64 random(static_cast<unsigned>(trial));
    std::uniform_real_distribution<double> some(0.2, 1);
    // Corners of the cycle: (overlap, shift). The cycle is passed in both directions.
    const double low = 1e-5 * some(random), high = low + 2e-5 * some(random);
    const double shift = 1e-6 * (trial % 2 == 0 ? 1 : -1) * some(random);
    const S::Vector corners[] = {{low, 0}, {low, shift}, {high, shift}, {high, 0}};
    S::Vector memory = S::Vector::Zero();
    double work = 0;  // of the contact on what moves it
    const int steps = 500;
    moreau::ContactMotion<S> motion{-low, S::Vector::Zero(), 0, 0.01, 1};
    law.force(motion, memory);
    for (int lap = 0; lap < 3; ++lap)
      for (int k = 0; k < 4; ++k) {
        const int from = trial % 4 < 2 ? k : (4 - k) % 4, to = trial % 4 < 2 ? (k + 1) % 4 : 3 - k;
        const S::Vector move = (corners[to] - corners[from]) / steps;
        S::Vector before = law.force(motion, memory);
        for (int i = 1; i <= steps; ++i) {
          motion.gap = -(corners[from] + i * move)[0];
          motion.velocity = {-move[0],
                             move[1]};  // over a step of 1 s: a gap closes as the overlap grows
          const S::Vector force = law.force(motion, memory);
          work += (force + before).dot(motion.velocity) / 2;
          motion.velocity.setZero();
          before = force;
        }
      }
    CAPTURE(trial);
    CHECK(work <= 1e-9 * std::abs(shift));
  }
}

TEST_CASE_TEMPLATE("rigid contacts: no impact makes kinetic energy", S, Space<2>, Space<3>) {
  using Law = SignoriniCoulomb<double>;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double tilt : {0.0, 1e-5, 3e-5, 1e-4, 0.3, 1.0})
      for (const double e : {0.0, 0.5, 1.0})
        for (const double friction : {0.0, 0.3, 1.0}) {
          typename S::Angular turn;
          for (auto& x : turn) x = tilt * normal(random);
          double gain = 0;
          for (const double h : {1e-4, 1e-7}) {
            OnFloor<S, Law> world(grain, Law(friction, e), S::exp(turn), -1e-6);
            for (int k = 0; k < S::dofs; ++k)
              world.velocity()[k] = normal(random) * (k < S::dim ? 1 : 50);
            world.velocity()[world.up] = -1;
            const double first = world.kinetic_energy();
            for (int k = 0; k < 40; ++k)
              gain = std::max(gain, gain_of_step<S>(world, 1, h) / first);
          }
          CAPTURE(grain.name);
          CAPTURE(tilt);
          CAPTURE(e);
          CAPTURE(friction);
          CHECK(gain <= 1e-9);
        }
}
