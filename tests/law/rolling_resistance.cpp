// SPDX-License-Identifier: MIT
#include "moreau/law/rolling_resistance.hpp"

#include <doctest/doctest.h>
#include <random>

using namespace moreau;
using S = Space<3>;
using Row = RollingBlock<S>::Vector;

namespace {

/// W of two balls that touch off the line of their centres.
RollingBlock<S> eccentric_block(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  const double radii[] = {0.2 + part(random), 0.2 + part(random)};
  const double radius = 1 / (1 / radii[0] + 1 / radii[1]);
  Eigen::Matrix<double, 6, 6> w = Eigen::Matrix<double, 6, 6>::Zero();
  for (const int sign : {1, -1}) {
    const double r = radii[sign < 0], mass = 4 * r * r * r;
    const Eigen::Vector3d lever(sign * r, 0.3 * r * normal(random), 0.3 * r * normal(random));
    Eigen::Matrix<double, 6, 6> j = Eigen::Matrix<double, 6, 6>::Zero(), mobility = j;
    j.topLeftCorner<3, 3>().setIdentity();
    j.topRightCorner<3, 3>() = S::lever(lever);
    j.bottomRightCorner<3, 3>() = radius * Eigen::Matrix3d::Identity();
    mobility.diagonal() << Eigen::Vector3d::Constant(1 / mass),
        Eigen::Vector3d::Constant(2.5 / (mass * r * r));
    w += j * mobility * j.transpose();
  }
  // In the frame in which the tangential part of W is diagonal.
  Eigen::Matrix2d turn;
  RollingBlock<S> block;
  block.point = align_tangents<S>(Eigen::Matrix3d(w.topLeftCorner<3, 3>()), turn);
  Eigen::Matrix<double, 6, 6> q = Eigen::Matrix<double, 6, 6>::Identity();
  q.block<2, 2>(1, 1) = turn;
  q.block<2, 2>(4, 4) = turn;
  w = q.transpose() * w * q;
  block.coupling = w.topRightCorner<3, 3>();
  block.spin = w.bottomRightCorner<3, 3>();
  return block;
}

Row velocity_of(const RollingBlock<S>& block, const Row& r, const Row& b) {
  Row u = b;
  linear<S>(u) += block.point.matrix() * linear<S>(r) + block.coupling * angular<S>(r);
  angular<S>(u) += block.coupling.transpose() * linear<S>(r) + block.spin * angular<S>(r);
  return u;
}

}  // namespace

TEST_CASE("a point on the cone is its own projection") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.1, 1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k) {
    const RollingResistance<> law(part(random), part(random));
    Row x;
    for (double& v : x) v = normal(random);
    const Row p = law.project(x);
    CHECK((law.project(p) - p).norm() <= 1e-14 * p.norm());
    // The distance to the cone is orthogonal to it, and in its polar cone.
    CHECK(std::abs(p.dot(x - p)) < 1e-13 * x.squaredNorm());
  }
}

TEST_CASE("the local problem is solved for any friction and any levers") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int k = 0; k < 4000; ++k) {
    const RollingBlock<S> block = eccentric_block(random);
    const RollingResistance<> law(0.3 + 1.7 * part(random), 0.5 * part(random));
    Row b;
    for (double& v : b) v = normal(random);
    b[0] = -std::abs(b[0]);
    const Row r = law.solve<S>(block, b, Row::Zero());
    const double scale = (block.point.matrix().trace() + block.spin.trace()) / 6;
    // The map jumps at r = 0 and where a limit is met exactly: one of the neighbours solves it, too.
    double least = 1;
    for (const double factor : {1.0, 1 + 1e-13, 1 - 1e-13}) {
      const Row x = factor * r;
      least = std::min(least,
                       law.natural_map(velocity_of(block, x, b), Row(scale * x)).norm() / b.norm());
    }
    worst = std::max(worst, least);
  }
  CHECK(worst < 1e-8);
}
