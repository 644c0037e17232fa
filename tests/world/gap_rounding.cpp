// SPDX-License-Identifier: MIT
// Gaps that count as closed because rounding leaves them: the bounds, against double precision, and what is done with them.
#include "moreau/world/detail/gap_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/motion/body_motion.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"

using namespace moreau;

namespace {

constexpr double unit = std::numeric_limits<float>::epsilon();

/// The same body in double precision.
Pose<Space<2>> exact(const Pose<Space<2, float>>& pose) {
  return {pose.position.cast<double>(), Eigen::Rotation2Dd(double(pose.rotation.angle()))};
}
Pose<Space<3>> exact(const Pose<Space<3, float>>& pose) {
  return {pose.position.cast<double>(), pose.rotation.cast<double>().normalized()};
}

/// A rotation by any angle about any axis, as after many steps: normalized in single precision.
template <class S>
typename S::Rotation any_rotation(std::mt19937& random) {
  std::uniform_real_distribution<float> number(-2, 2);
  typename S::Angular w;
  for (int k = 0; k < S::angular_dim; ++k) w[k] = number(random);
  return S::normalized(S::exp(w));
}

}  // namespace

// Two cuboids whose faces lie on each other, and a cuboid on a plane.
TEST_CASE_TEMPLATE("rounding of gaps: detection leaves less than the bound of half a step", ShapeT,
                   Polygon<float>, Polyhedron<float>) {
  using S = SpaceOf<ShapeT>;
  using D = Space<S::dim>;
  using Vector = typename S::Vector;
  using Exact = std::conditional_t<S::dim == 2, Polygon<>, Polyhedron<>>;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> number(0, 1);
  double largest = 0;
  int points = 0;
  for (int variant = 0; variant < 3000; ++variant) {
    const float size = std::pow(10.0f, float(variant % 7 - 3));
    Vector half_a, half_b;
    for (int k = 0; k < S::dim; ++k)
      half_a[k] = size * (0.2f + number(random)), half_b[k] = size * (0.2f + number(random));
    const ShapeT a = cuboid<ShapeT>(half_a), b = cuboid<ShapeT>(half_b);
    const Exact exact_a = cuboid<Exact>(half_a.template cast<double>()),
                exact_b = cuboid<Exact>(half_b.template cast<double>());
    Pose<S> pose_a, pose_b;
    pose_a.rotation = pose_b.rotation = any_rotation<S>(random);
    Vector offset = Vector::Zero();
    offset[0] = half_a[0] + half_b[0];
    for (int k = 1; k < S::dim; ++k) offset[k] = 0.3f * half_a[k] * number(random);
    for (int k = 0; k < S::dim; ++k) pose_a.position[k] = 2 * size * number(random);
    pose_b.position = pose_a.position + pose_a.rotation * offset;
    const float margin = 0.02f * size;
    Manifold<S> found;
    Manifold<D> expected;
    PairCache<S> cache;
    PairCache<D> exact_cache;
    const Placed<ShapeT> at_a(a, pose_a), at_b(b, pose_b);
    const Placed<Exact> exactly_a(exact_a, exact(pose_a)), exactly_b(exact_b, exact(pose_b));
    REQUIRE(collide(at_a, at_b, margin, found, cache));
    REQUIRE(collide(exactly_a, exactly_b, double(margin), expected, exact_cache));
    for (const auto& point : found.points)
      for (const auto& other : expected.points) {
        if (!(point.feature == other.feature)) continue;
        const double levers = double((point.position - pose_a.position).cwiseAbs().sum() +
                                     (point.position - pose_b.position).cwiseAbs().sum());
        const double positions =
            double(pose_a.position.cwiseAbs().sum() + pose_b.position.cwiseAbs().sum());
        largest = std::max(
            largest, std::abs(double(point.gap) - other.gap) / (unit * (16 * levers + positions)));
        ++points;
      }
  }
  CHECK(points > 3000);
  CHECK(largest < 1);
  CHECK(largest > 0.01);  // the bound is not that of something else
}

TEST_CASE_TEMPLATE("rounding of gaps: the motion of a step leaves less than the bound", ShapeT,
                   Polygon<float>, Polyhedron<float>) {
  using S = SpaceOf<ShapeT>;
  using D = Space<S::dim>;
  using Vector = typename S::Vector;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(-1, 1);
  double largest = 0;
  for (int variant = 0; variant < 3000; ++variant) {
    Pose<S> pose;
    pose.rotation = any_rotation<S>(random);
    Vector lever;
    typename S::Twist velocity;
    for (int k = 0; k < S::dim; ++k)
      pose.position[k] = 3 * number(random), lever[k] = number(random);
    for (int k = 0; k < S::dofs; ++k) velocity[k] = number(random);
    Pose<D> exactly = exact(pose);
    const float h = 1e-3f;
    advance_pose<S>(pose, velocity, h);
    advance_pose<D>(exactly, velocity.template cast<double>(), double(h));
    const auto exact_lever = lever.template cast<double>().eval();
    const double off = (exact(pose)(exact_lever) - exactly(exact_lever)).norm();
    largest = std::max(largest, off / (unit * double(pose.position.cwiseAbs().sum() +
                                                     9 * lever.cwiseAbs().sum())));
  }
  CHECK(largest < 1);
}

// A gap that one step leaves counts as closed, at any distance from the origin. One that many steps leave does up to
// the given length.
TEST_CASE("rounding of gaps: which gaps count as closed") {
  using S = Space<3, float>;
  const auto eps = float(unit), most = 2e-4f;
  Bodies<S> bodies;
  bodies.pose.resize(2);
  bodies.grain_mass.assign(2, 1);
  bodies.pose[1].position = {1, 0, 0};
  Contact<S> contact;
  contact.a = 0;
  contact.b = 1;
  contact.frame.setIdentity();
  contact.lever_a = {0.5f, 0, 0};
  contact.lever_b = {-0.5f, 0, 0};
  const auto is_closed = [&](float gap) {
    return detail::is_gap_rounding<S>(bodies, contact, gap, most);
  };
  CHECK_FALSE(is_closed(-eps));
  CHECK_FALSE(is_closed(0));
  CHECK(is_closed(543 * eps));
  CHECK_FALSE(is_closed(545 * eps));
  for (auto& pose : bodies.pose) pose.position[1] = 1e4f;
  CHECK(is_closed(most));
  CHECK(is_closed(1e-3f));
  CHECK_FALSE(is_closed(0.1f));
}
