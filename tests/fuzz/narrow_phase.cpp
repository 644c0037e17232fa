// SPDX-License-Identifier: MIT
// Input: two shapes in arbitrary poses. Expected: the narrow phase agrees with the exhaustive
// search, and the pair cache changes no bit.
#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "bytes.hpp"
#include "detect/oracle.hpp"
#include "detect/same_manifold.hpp"
#include "shapes.hpp"

namespace {

using namespace moreau;

template <class Vector>
std::vector<Vector> take_points(Bytes& bytes) {
  std::vector<Vector> points(static_cast<std::size_t>(bytes.between(3, 12)));
  for (Vector& x : points)
    for (double& coordinate : x) coordinate = bytes.number();
  return points;
}
double take_side(Bytes& bytes) {
  constexpr double sides[] = {1, 0.5, 2, 0.1, 0.01, 1e-3};
  return sides[bytes.between(0, 5)];
}
template <class Vector>
std::vector<Vector> take_box(Bytes& bytes) {
  Vector side;
  for (double& x : side) x = take_side(bytes);
  std::vector<Vector> corners;
  for (int corner = 0; corner < 1 << side.size(); ++corner) {
    Vector x = side / 2;
    for (int axis = 0; axis < side.size(); ++axis)
      if (corner >> axis & 1) x[axis] = -x[axis];
    corners.push_back(x);
  }
  return corners;
}
std::vector<Eigen::Vector3d> take_prism(Bytes& bytes) {
  const int sides = bytes.between(3, 10);
  const double radius = take_side(bytes), height = take_side(bytes);
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {-height / 2, height / 2})
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return corners;
}

template <class ShapeT>
std::optional<ShapeT> take_shape(Bytes& bytes) {
  using Vector = typename ShapeT::Vector;
  std::vector<Vector> points;
  const int kind = bytes.between(0, 3);
  if constexpr (std::same_as<ShapeT, Polyhedron<double>>)
    points = kind == 0 ? take_prism(bytes) : points;
  if (points.empty()) points = kind == 1 ? take_box<Vector>(bytes) : take_points<Vector>(bytes);
  try {
    return hull_of<ShapeT>(points);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Rotations by quarter and eighth turns about axes, by an arbitrary angle, or by a small angle.
template <class S>
typename S::Rotation take_rotation(Bytes& bytes) {
  typename S::Angular turn = S::Angular::Zero();
  switch (bytes.between(0, 3)) {
    case 0:
      break;
    case 1:
      turn[bytes.between(0, S::angular_dim - 1)] = std::numbers::pi / 4 * bytes.between(0, 7);
      break;
    case 2:
      for (double& w : turn) w = bytes.number();
      break;
    default:
      for (double& w : turn) w = bytes.between(-3, 3) * std::ldexp(1., -bytes.between(3, 60));
  }
  return S::normalized(S::exp(turn));
}

/// Compares the results of the three queries of a pair with each other and with the exact result.
template <class ShapeT>
class Trial {
 public:
  using S = SpaceOf<ShapeT>;

  Trial(const ShapeT& a, const ShapeT& b) : shape_a_(a), shape_b_(b), a_(a), b_(b) {}

  void at(const Pose<S>& pose_a, const Pose<S>& pose_b) {
    a_.update(shape_a_, pose_a);
    b_.update(shape_b_, pose_b);
    const double size = shape_a_.circumradius() + shape_b_.circumradius();
    const double tiny = 1e-12 * size + 16 * std::numeric_limits<double>::epsilon() *
                                           (pose_a.position.norm() + pose_b.position.norm());
    const auto truth = oracle::signed_gap(shape_a_, pose_a, shape_b_, pose_b);
    const SignedDistance<S> found = distance(a_, b_);
    hold(std::abs(found.gap - truth.gap) < tiny, "the gap is that of the exhaustive search");
    hold(std::abs(found.normal.norm() - 1) < 1e-12, "unit normal");
    hold((found.witness_b - found.witness_a - found.gap * found.normal).norm() < tiny,
         "witnesses are the gap apart");
    const SignedDistance<S> again = distance(a_, b_, of_distance_);
    hold(again.gap == found.gap && again.normal == found.normal &&
             again.witness_a == found.witness_a && again.witness_b == found.witness_b,
         "distance: cached as cold");
    if (std::abs(truth.gap) > tiny) {
      hold(overlap(a_, b_) == (truth.gap <= 0), "overlap: as the exhaustive search");
      hold(overlap(a_, b_, of_overlap_) == (truth.gap <= 0), "overlap: cached as cold");
    }
    check_manifold(found, 0.02 * size, tiny);
  }

 private:
  void check_manifold(const SignedDistance<S>& found, double margin, double tiny) {
    const bool touch = collide(a_, b_, margin, cold_);
    hold(collide(a_, b_, margin, cached_, of_manifold_) == touch, "collide: cached as cold");
    if (std::abs(found.gap - margin) > tiny) hold(touch == (found.gap <= margin), "margin");
    if (!touch) return;
    hold(is_same(cold_, cached_), "manifold: cached as cold");
    hold(std::abs(cold_.gap - found.gap) < tiny, "gap of the manifold");
    hold(!cold_.points.empty(), "a contact has points");
    for (std::size_t k = 0; k < cold_.points.size(); ++k) {
      const auto& point = cold_.points[k];
      hold(point.position.allFinite() && std::isfinite(point.gap), "finite points");
      hold(point.gap <= margin + tiny, "points within the margin");
      hold(point.gap >= cold_.gap - tiny, "no point deeper than the gap");
      if (k > 0) hold(cold_.points[k - 1].feature < point.feature, "sorted keys, each once");
    }
    reduce(cold_, S::dim);
    hold(!cold_.points.empty() && cold_.points.size() <= S::dim, "few points are left");
  }

  const ShapeT &shape_a_, &shape_b_;
  Placed<ShapeT> a_, b_;
  PairCache<S> of_distance_, of_overlap_, of_manifold_;
  Manifold<S> cold_, cached_;
};

template <class ShapeT>
void try_pair(Bytes& bytes) {
  using S = SpaceOf<ShapeT>;
  const auto a = take_shape<ShapeT>(bytes), b = take_shape<ShapeT>(bytes);
  if (!a || !b) return;
  Pose<S> pose_a, pose_b;
  pose_a.rotation = take_rotation<S>(bytes);
  pose_b.rotation = take_rotation<S>(bytes);
  for (double& x : pose_b.position) x = bytes.number();
  Trial trial(*a, *b);
  trial.at(pose_a, pose_b);
  for (int k = 0; k < 4 && !bytes.is_empty(); ++k) {
    typename S::Vector shift;
    for (double& x : shift) x = bytes.between(-3, 3) * std::ldexp(1., -bytes.between(3, 50));
    pose_b.position += shift;
    pose_b.rotation = S::normalized(take_rotation<S>(bytes) * pose_b.rotation);
    trial.at(pose_a, pose_b);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  if (bytes.between(0, 1) == 0)
    try_pair<Polyhedron<double>>(bytes);
  else
    try_pair<Polygon<double>>(bytes);
  return 0;
}
