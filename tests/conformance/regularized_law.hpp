// SPDX-License-Identifier: MIT
// The requirements on every regularized law. A new law is tested by one line:
//
//   TEST_CASE("my law") { conformance::regularized_law<moreau::Space<3>>(MyLaw(...)); }
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/law/regularized.hpp"

namespace conformance {

/// Speed [m/s] after a central impact with the initial speed 1 m/s.
/// @param step small compared with the duration of the impact [s]
template <class S, class Law>
double rebound(const Law& law, double mass, double step) {
  using T = typename S::Scalar;
  moreau::ContactMotion<S> motion{0, S::Vector::Zero(), T(mass), T(0.01), T(step)};
  typename S::Vector memory = S::Vector::Zero();
  double gap = 0, speed = -1;
  for (int k = 0; k < 1000000 && (k == 0 || gap < 0); ++k) {
    gap += step * speed;
    motion.gap = T(gap);
    motion.velocity[0] = T(speed);
    speed += step / mass * double(law.force(motion, memory)[0]);
  }
  return speed;
}

/// Checks the force of a regularized law:
///   - Without contact the force is zero and the memory is cleared.
///   - In a compressed contact the force repels.
///   - Friction lies in the cone, if the law has friction().
///   - Friction opposes sliding.
///   - An impact does not increase the speed.
///   - If the tangents are rotated or mirrored, the force is rotated or mirrored in the same way.
/// @param step small compared with the duration of an impact of a mass of 1 kg [s]
/// @param pull largest attractive force of the law [N]. An attractive law may act across a gap, and
///             its friction is limited by mu (f_n + pull)
template <class S, class Law>
requires moreau::RegularizedLaw<Law, S>
void regularized_law(const Law& law, double step, double pull = 0) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int tangents = S::dim - 1;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  moreau::ContactMotion<S> motion{T(1e-4), Vector::Zero(), T(1), T(0.01), T(step)};
  Vector memory = Vector::Constant(T(1e-6));
  const Vector apart = law.force(motion, memory);
  CHECK(double(apart.norm()) <= pull);
  // If a law never writes its memory, the memory need not be cleared.
  moreau::ContactMotion<S> pressed = motion;
  pressed.gap = T(-1e-5);
  pressed.velocity.setOnes();
  Vector kept = Vector::Constant(T(1e-6));
  law.force(pressed, kept);
  const bool remembers = kept != Vector(Vector::Constant(T(1e-6)));
  if (pull == 0 && remembers) CHECK(memory.isZero(0));
  if (!remembers) memory.setZero();
  Vector mirrored_memory = memory, turned_memory = memory;
  Eigen::Matrix<T, tangents, tangents> turn;  // rotation of the tangents, in space by 0.5 rad
  turn.setIdentity();
  if constexpr (tangents > 1) turn = Eigen::Rotation2D<T>(T(0.5)).toRotationMatrix();
  const auto turned = [&](Vector v) {
    v.template tail<tangents>() = (turn * v.template tail<tangents>()).eval();
    return v;
  };
  bool finite = true;
  // The largest violations of all samples.
  double attracts = 0, outside = 0, mirrors = 0, turns = 0, drives = 0;
  for (int i = 0; i < 2000; ++i) {
    motion.gap = T(-1e-5 * std::abs(normal(random)));
    for (auto& x : motion.velocity) x = T(0.1 * normal(random));
    const Vector force = law.force(motion, memory);
    const double size = double(force.norm());
    finite = finite && force.allFinite();
    attracts = std::max(attracts, -double(force[0]) - pull);
    if constexpr (requires { law.friction(); }) {
      const double most = double(law.friction()) * (double(force[0]) + pull);
      const double friction = double(force.template tail<tangents>().norm());
      outside = std::max(outside, friction - most * (1 + 1e-5));
    }
    moreau::ContactMotion<S> mirrored = motion;
    mirrored.velocity.template tail<tangents>() *= T(-1);
    Vector other = law.force(mirrored, mirrored_memory);
    other.template tail<tangents>() *= T(-1);
    mirrors = std::max(mirrors, double((other - force).norm()) - 1e-5 * size);
    moreau::ContactMotion<S> aside = motion;
    aside.velocity = turned(motion.velocity);
    const Vector aside_force = law.force(aside, turned_memory);
    finite = finite && other.allFinite() && aside_force.allFinite();
    turns = std::max(turns, double((aside_force - turned(force)).norm()) - 1e-5 * size);
  }
  // In a contact without history, friction opposes the sliding velocity.
  for (int i = 0; i < 100; ++i) {
    Vector fresh = Vector::Zero();
    motion.gap = T(-1e-5);
    for (auto& x : motion.velocity) x = T(0.1 * normal(random));
    const Vector force = law.force(motion, fresh);
    finite = finite && force.allFinite();
    drives = std::max(
        drives,
        double(force.template tail<tangents>().dot(motion.velocity.template tail<tangents>())));
  }
  CHECK(finite);
  CHECK(attracts <= 0);
  CHECK(outside <= 0);
  CHECK(mirrors <= 0);
  CHECK(turns <= 0);
  CHECK(drives <= 0);
  const double speed = rebound<S>(law, 1, step);
  CHECK(speed >= 0);
  CHECK(speed <= 1 + 1e-3);
}

}  // namespace conformance
