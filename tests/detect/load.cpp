// SPDX-License-Identifier: MIT
// The contact points of a pair can carry its load. A pressure along the normal on the contact
// polygon is equivalent to a force at a centre of pressure inside the polygon. Normal forces at
// points are equivalent to a force inside the convex hull of the points. So the hull of all contact
// points must contain the contact polygon, and the triangle of the points kept by reduce() must
// contain the centre of pressure of the previous step.
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/detect/reduce.hpp"

#include "detect/shapes.hpp"
#include "rotation_between.hpp"
#include "sanitized.hpp"

using namespace moreau;

namespace {

using S = Space<3>;
using Vector = S::Vector;
using Flat = Eigen::Vector2d;
using Outline = std::vector<Flat>;
using Solid = Polyhedron<double>;

/// The corners of a face in order, world axes.
std::vector<Vector> corners(const Solid& shape, Eigen::Index face, const Pose<S>& pose) {
  const Vector n = shape.face_normals().row(face).transpose();
  std::vector<Vector> found;
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i) {
    const Vector x = shape.vertices().row(i).transpose();
    if (std::abs(n.dot(x) - shape.face_offsets()[face]) < 1e-9 * shape.circumradius())
      found.push_back(pose(x));
  }
  Vector middle = Vector::Zero();
  for (const Vector& x : found) middle += x / double(found.size());
  const typename S::Matrix frame = S::contact_frame(pose.rotation * n);
  const auto angle = [&](const Vector& x) {
    return std::atan2(frame.col(2).dot(x - middle), frame.col(1).dot(x - middle));
  };
  std::sort(found.begin(), found.end(),
            [&](const Vector& x, const Vector& y) { return angle(x) < angle(y); });
  return found;
}

double cross(const Flat& a, const Flat& b) {
  return a.x() * b.y() - a.y() * b.x();
}
bool is_inside(const Outline& outline, const Flat& x) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Flat& a = outline[i];
    if (cross(outline[(i + 1) % outline.size()] - a, x - a) < 0) return false;
  }
  return true;
}
/// The corners of the intersection of two convex outlines, in any order.
Outline shared(const Outline& a, const Outline& b) {
  Outline found;
  for (const Flat& x : a)
    if (is_inside(b, x)) found.push_back(x);
  for (const Flat& x : b)
    if (is_inside(a, x)) found.push_back(x);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Flat p = a[(i + 1) % a.size()] - a[i], q = b[(j + 1) % b.size()] - b[j];
      const double s = cross(b[j] - a[i], q) / cross(p, q), t = cross(b[j] - a[i], p) / cross(p, q);
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1) found.emplace_back(a[i] + s * p);
    }
  return found;
}
/// The largest distance by which `a` extends beyond the hull of `b`, over many directions.
double beyond(const Outline& a, const Outline& b) {
  double worst = -1e9;
  for (int k = 0; k < 360; ++k) {
    const Flat d(std::cos(k * std::numbers::pi / 180), std::sin(k * std::numbers::pi / 180));
    double far_a = -1e9, far_b = -1e9;
    for (const Flat& x : a) far_a = std::max(far_a, d.dot(x));
    for (const Flat& x : b) far_b = std::max(far_b, d.dot(x));
    worst = std::max(worst, far_a - far_b);
  }
  return worst;
}

/// A random face of b on a random face of a, with a small overlap and a random shift and rotation.
struct FaceToFace {
  Solid a, b;
  Pose<S> pose_a, pose_b;
  Outline polygon;  ///< coordinates along the tangents of the contact frame
  S::Matrix frame;

  explicit FaceToFace(std::mt19937_64& random)
      : a(samples::grain(S{}, random)), b(samples::grain(S{}, random)) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto of_a = Eigen::Index(random() % std::size_t(a.face_normals().rows()));
    const auto of_b = Eigen::Index(random() % std::size_t(b.face_normals().rows()));
    pose_a.rotation = samples::rotation(S{}, random);
    const Vector n = pose_a.rotation * a.face_normals().row(of_a).transpose();
    frame = S::contact_frame(n);
    pose_b.rotation = rotation_between(b.face_normals().row(of_b).transpose(), -n);
    pose_b.rotation = Eigen::AngleAxisd(std::numbers::pi * unit(random), n) * pose_b.rotation;
    const auto under = corners(a, of_a, pose_a);
    const auto over = corners(b, of_b, pose_b);
    const auto middle = [](const std::vector<Vector>& list) {
      Vector sum = Vector::Zero();
      for (const Vector& x : list) sum += x;
      return Vector(sum / double(list.size()));
    };
    const double wide = (under[0] - middle(under)).norm();
    pose_b.position = middle(under) - middle(over) - 1e-5 * a.circumradius() * n +
                      0.5 * wide * (unit(random) * frame.col(1) + unit(random) * frame.col(2));
    Outline low, high;
    for (const Vector& x : under) low.push_back(flat(x));
    for (const Vector& x : over) high.insert(high.begin(), flat(x + pose_b.position));
    polygon = shared(low, high);
  }
  Flat flat(const Vector& x) const { return {frame.col(1).dot(x), frame.col(2).dot(x)}; }
};

}  // namespace

TEST_CASE("the hull of all points holds the polygon on which faces meet") {
  std::mt19937_64 random(17);
  Manifold<S> manifold;
  int met = 0;
  for (int i = 0; i < rounds(3000); ++i) {
    const FaceToFace pair(random);
    if (pair.polygon.size() < 3) continue;
    const Placed<Solid> a(pair.a, pair.pose_a), b(pair.b, pair.pose_b);
    REQUIRE(collide(a, b, 0.0, manifold));
    // A very small contact polygon at a corner is left out.
    if (manifold.contact_class != ContactClass::face_face) continue;
    ++met;
    Outline points;
    for (const auto& point : manifold.points) points.push_back(pair.flat(point.position));
    const double size = pair.a.circumradius() + pair.b.circumradius();
    CHECK(beyond(pair.polygon, points) < 1e-9 * size);
    CHECK(beyond(points, pair.polygon) < 1e-9 * size);
  }
  CHECK(met > rounds(2000));
}

TEST_CASE("three points hold the centre of pressure of the step before") {
  std::mt19937_64 random(18);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < rounds(20000); ++i) {
    // The points form a convex polygon that is nearly plane. Some of its corners appear and
    // disappear.
    Manifold<S> manifold;
    manifold.normal = Vector::UnitZ();
    manifold.contact_class = ContactClass::face_face;
    const std::size_t count = 4 + random() % 8;
    std::vector<double> angles;
    for (std::size_t k = 0; k < count; ++k) angles.push_back(2 * std::numbers::pi * unit(random));
    std::sort(angles.begin(), angles.end());
    for (std::size_t k = 0; k < count; ++k)
      manifold.points.push_back({{2 * std::cos(angles[k]), std::sin(angles[k]), 0},
                                 1e-6 * unit(random),
                                 FeatureKey(FeatureKey::Kind::vertex_face, k, 0)});
    std::vector<KeptPoint> kept;
    Vector pressure = Vector::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& point = manifold.points[(random() % (count / 3)) + k * (count / 3)];
      const double push = random() % 3 == 0 ? 0 : unit(random);
      kept.push_back({point.feature, push});
      pressure += push * point.position;
      sum += push;
    }
    if (sum == 0) continue;
    pressure /= sum;
    reduce(manifold, 3, kept);
    REQUIRE(manifold.points.size() == 3);
    Outline triangle;
    for (const auto& point : manifold.points) triangle.push_back(point.position.head<2>());
    // A centre of pressure counts as inside if it lies beyond a side by at most 2 % of the
    // triangle's height.
    CHECK(beyond({pressure.head<2>()}, triangle) < 0.02 * 4);
  }
}
