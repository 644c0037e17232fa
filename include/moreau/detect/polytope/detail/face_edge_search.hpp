// SPDX-License-Identifier: MIT
// The signed gap of two polyhedra from the normals of their faces and pairs of edges.
//
// With s(n) the separation along a unit vector (axis.hpp), C = B - A is a polytope, and the signed
// gap is the largest s over all n.
//   Overlapping shapes: the origin lies in C, and the gap is minus its distance to the nearest face
//     of C. The face normals of C are those of A, those of B reversed, and the common normals of
//     pairs of edges; the gap is the largest s over these.
//   Shapes apart: the largest s over these normals is a lower bound of the gap. It is the gap if
//   the
//     nearest points of the two features lie within them, for the features are then that far apart.
//
// A vertex q of B that lies below every face of A, and nowhere less deep than -s(n_f) below the
// best face f, proves that f is the axis: to bring this one point out of A takes as much along any
// axis.
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
  ///                  search is shorter if these lie near the contact; the set grows
  /// @param points_b  the same of b, relative to the centre of a
  /// @param margin    the search stops at an axis that separates by more [m]
  FaceEdgeSearch(const PolytopePair<Polyhedron<T>>& pair, PointSet<T>& points_a,
                 PointSet<T>& points_b, T margin)
      : pair_(pair),
        points_a_(points_a),
        points_b_(points_b),
        margin_(margin),
        rounding_(pair.rounding()),
        below_a_(pair.a, points_b),
        below_b_(pair.b, points_a) {}

  /// First part: the faces of a.
  void search_faces_of_a() {
    const auto of_a = search_faces(pair_.a, pair_.b, pair_.offset, points_b_,
                                   -std::numeric_limits<T>::infinity());
    axis_ = {pair_.a.normals()[of_a.face], of_a.separation, AxisKind::face_a, of_a.face,
             of_a.vertex};
    if (axis_.gap > margin_) return;
    below_a_.update(level());
    prove_face(pair_.a, of_a, pair_.offset, pair_.b, below_a_);
  }
  /// Whether the axis is exact or separates by more than the margin, so that the search can end.
  bool is_done() const { return is_exact_ || axis_.gap > margin_; }
  /// Second part: the faces of b and the pairs of edges, unless the search is done.
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
  /// Whether the axis has the signed gap. Otherwise the shapes are apart by axis().gap or more.
  bool is_exact() const { return is_exact_; }

 private:
  /// The separation [m] that an edge has to exceed; never positive, see edge_search.hpp.
  T level() const { return std::min(axis_.gap + rounding_, T(0)); }

  /// Sets is_exact_ if the face of the shape is proved to make the axis.
  /// @param below  for each face of the shape, the points of the other shape at most level() above
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
  /// Takes n if its separation is the best so far. For any n this separation is a lower bound of
  /// the gap, so errors of rounding in the crossing test cannot make the result too large.
  /// @returns whether n was taken
  bool try_lower_bound(const EdgeView<T>& a, const EdgeView<T>& b, const Vector& n) {
    const T separation = pair_.separation(n);
    if (!(separation > axis_.gap + rounding_)) return false;
    axis_ = {n, separation, AxisKind::edges, a.id, b.id};
    is_exact_ = false;
    return true;
  }
  /// The normal of edges that are nearly parallel has an error of about eps / sine [rad], and so
  /// has the separation along it. The distance of the edges is known better. The two are equal if
  /// the nearest points lie within the edges, as they do for the separating axis.
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
  /// Measures the axis from the ends of its two edges, as the proof of remembered features does.
  /// Nearly parallel edges have been measured by their distance.
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
