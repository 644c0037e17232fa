// SPDX-License-Identifier: MIT
// The signed gap of two polyhedra from the normals of their faces and of pairs of their edges.
//
// Let s(n) be the separation along a unit vector n (axis.hpp). The signed gap is the largest s(n)
// over all n. C = B - A, the set of all differences b - a, is a polytope. Its face normals are the
// face normals of A, the reversed face normals of B, and common normals of an edge of A and an edge
// of B.
//   Overlapping shapes: the origin lies in C. The gap is minus the distance of the origin from the
//     nearest face of C. This is the largest s(n) over the face normals n of C.
//   Shapes that are apart: the largest s(n) over the face normals of C is a lower bound of the gap.
//     It equals the gap if the nearest points of the planes or lines of the two features lie within
//     the features, because the features are then at that distance from each other.
//
// Let f be the face of A with the largest s(n_f), and let a vertex q of B be at least -s(n_f) deep
// below every face of A. Then f makes the axis: to move q out of A takes a displacement of at least
// -s(n_f) along any axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/detect/polytope/detail/edge_search.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

template <std::floating_point T>
class FaceEdgeSearch {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;

  /// @param points_a  at least one vertex of a, relative to the centre of b, world axes [m]. The
  ///                  search takes fewer rounds if these vertices lie near the contact. The search
  ///                  adds vertices
  /// @param points_b  at least one vertex of b, relative to the centre of a, used in the same way
  /// @param margin    the search stops at an axis that separates the shapes by more than this [m]
  FaceEdgeSearch(const PolytopePair<Polyhedron<T>>& pair, PointSet<T>& points_a,
                 PointSet<T>& points_b, T margin)
      : pair_(pair),
        points_a_(points_a),
        points_b_(points_b),
        margin_(margin),
        rounding_(pair.rounding()),
        below_a_(pair.a, points_b),
        below_b_(pair.b, points_a) {}

  /// First part: searches the faces of a.
  void search_faces_of_a() {
    const auto of_a = search_faces(pair_.a, pair_.b, pair_.offset, points_b_,
                                   -std::numeric_limits<T>::infinity());
    axis_ = {pair_.a.normals()[of_a.face], of_a.separation, AxisKind::face_a, of_a.face,
             of_a.vertex};
    if (axis_.gap > margin_) return;
    below_a_.update(level());
    prove_face(pair_.a, of_a, pair_.offset, pair_.b, below_a_);
  }
  /// Whether the axis is exact or separates the shapes by more than the margin, so that the search
  /// can end.
  bool is_done() const { return is_exact_ || axis_.gap > margin_; }
  /// Second part: searches the faces of b and the pairs of edges, unless the search is done.
  void search_faces_of_b_and_edges() {
    if (is_done()) return;
    const auto of_b =
        search_faces(pair_.b, pair_.a, Vector(-pair_.offset), points_a_, axis_.gap + rounding_);
    if (of_b.is_found)
      axis_ = {-pair_.b.normals()[of_b.face], of_b.separation, AxisKind::face_b, of_b.vertex,
               of_b.face};
    if (axis_.gap > margin_) return;
    below_b_.update(level());
    if (of_b.is_found) prove_face(pair_.b, of_b, Vector(-pair_.offset), pair_.a, below_b_);
    if (is_exact_) return;
    search_edges(edges_left(pair_.a, below_a_), edges_left(pair_.b, below_b_));
    if (axis_.gap <= T(0)) is_exact_ = true;
    if (axis_.kind == AxisKind::edges) measure_again();
  }

  const Axis<S>& axis() const { return axis_; }
  /// Whether axis().gap is the signed gap. If not, the signed gap is at least axis().gap.
  bool is_exact() const { return is_exact_; }

 private:
  /// An edge that separates by no more than this [m] need not be examined. Never positive, because
  /// the test in edge_search.hpp holds only for t <= 0.
  T level() const { return std::min(axis_.gap + rounding_, T(0)); }

  /// Sets is_exact_ if it is proved that the face of the shape makes the axis.
  /// @param below  for each face of `shape`, the points of the other shape whose height above the
  ///               face is at most level()
  void prove_face(const Placed<Polyhedron<T>>& shape, const FaceSeparation<T>& found,
                  const Vector& offset, const Placed<Polyhedron<T>>& other,
                  const FaceMasks<T>& below) {
    is_exact_ = below.in_common() != 0 ||
                (axis_.gap > T(0) &&
                 projects_onto(shape, found.face, Vector(other.vertices()[found.vertex] + offset)));
  }

  void search_edges(const ShortList& edges_a, const ShortList& edges_b) {
    for (std::size_t i = 0; i < edges_a.size(); ++i) {
      const EdgeView<T> a(pair_.a, edges_a[i]);
      for (std::size_t j = 0; j < edges_b.size(); ++j)
        try_edges(a, EdgeView<T>(pair_.b, edges_b[j]));
    }
  }
  void try_edges(const EdgeView<T>& a, const EdgeView<T>& b) {
    Vector n;
    if (!crossing_normal(a, b, n)) return;
    const Vector apart = b.from + pair_.offset - a.from;
    if (are_nearly_parallel(a, b)) return try_parallel(a, b, apart, n);
    if (!(n.dot(apart) > axis_.gap + rounding_)) return;
    if (try_lower_bound(a, b, n))
      is_exact_ = axis_.gap > T(0) && nearest_points_are_within(a, b, apart, n);
  }
  /// Takes n as the axis if its separation is the largest so far. The separation along any n is a
  /// lower bound of the gap. So rounding errors in the crossing test cannot make the gap too large.
  /// @returns whether n was taken
  bool try_lower_bound(const EdgeView<T>& a, const EdgeView<T>& b, const Vector& n) {
    const T separation = pair_.separation(n);
    if (!(separation > axis_.gap + rounding_)) return false;
    axis_ = {n, separation, AxisKind::edges, a.id, b.id};
    is_exact_ = false;
    return true;
  }
  /// Treats two nearly parallel edges. Their common normal has an error of about eps / sine [rad],
  /// where sine is the sine of the angle between the edges. The separation along the normal has the
  /// same relative error, but the distance of the two edges is more accurate. The separation and
  /// the distance are equal if the nearest points lie within the edges, as for the separating axis.
  void try_parallel(const EdgeView<T>& a, const EdgeView<T>& b, const Vector& apart,
                    const Vector& n) {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    const T sine =
        a.direction.cross(b.direction).norm() / (a.direction.norm() * b.direction.norm());
    const T angle = T(16) * eps / sine;
    const T height = height_at_nearest(a, b, apart, n);
    if (sine < T(4) * std::cbrt(eps * eps) ||
        !nearest_points_are_within(a, b, apart, n, T(4) * angle) ||
        pair_.separation(n) < height - (rounding_ + angle * pair_.size)) {
      try_lower_bound(a, b, n);
    } else if (height > axis_.gap + rounding_) {
      axis_ = {n, height, AxisKind::edges, a.id, b.id};
      is_exact_ = false;
    }
  }
  /// Measures the axis again, from the ends of its two edges, as prove_axis does for remembered
  /// features, so that both functions return the same bits. Nearly parallel edges keep their
  /// distance as the gap.
  void measure_again() {
    const EdgeView<T> a(pair_.a, axis_.a), b(pair_.b, axis_.b);
    if (are_nearly_parallel(a, b)) return;
    const auto axis = axis_of_edges(a, b, pair_.offset);
    if (axis && std::abs(axis->gap - axis_.gap) <= rounding_) axis_ = *axis;
  }

  const PolytopePair<Polyhedron<T>>& pair_;
  PointSet<T>&points_a_, &points_b_;
  const T margin_, rounding_;
  FaceMasks<T> below_a_, below_b_;
  Axis<S> axis_;
  bool is_exact_ = false;
};

}  // namespace moreau::detail
