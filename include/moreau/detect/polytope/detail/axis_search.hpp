// SPDX-License-Identifier: MIT
// The signed gap of two polyhedra from their faces and edges.
//
// For a unit vector n let s(n) = min over B of n.b - max over A of n.a, the separation along n; the
// signed gap is the maximum of s over all n. C = B - A is a polytope. If the shapes overlap, the
// origin lies in it and the gap is minus the distance to its nearest face: the largest s over the
// normals of C's faces, which are those of A, those of B reversed, and the common normals of pairs
// of edges. If they are apart, the largest s over these normals is a lower bound; it is the gap if
// the nearest points of the two features lie within them, for then they are that far apart.
//
// A vertex q of B below every face of A, and nowhere less deep than -s(n_f) below the best one,
// proves that face at once: to bring that one point out of A takes as much along any axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "moreau/detect/polytope/detail/edge_search.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

template <std::floating_point T>
class AxisSearch {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;

  /// Looks at the faces of a.
  /// @param points_a  at least one vertex of a, relative to the centre of b; points_b likewise.
  /// They
  ///                  save time if they are near the contact; they grow
  /// @param margin    stop at an axis that separates by more [m]
  AxisSearch(const PolyhedronPair<T>& pair, PointSet<T>& points_a, PointSet<T>& points_b, T margin)
      : pair_(pair),
        points_a_(points_a),
        points_b_(points_b),
        margin_(margin),
        rounding_(pair.rounding()) {
    const auto of_a =
        search_faces(pair.a, pair.b, pair.offset, points_b, -std::numeric_limits<T>::infinity());
    axis_ = {pair.a.normals()[of_a.face], of_a.separation, AxisKind::face_a, of_a.face,
             of_a.vertex};
    if (axis_.gap > margin) return;
    below_a_.emplace(pair.a, points_b, level());
    is_proved(pair.a, of_a, pair.offset, pair.b, *below_a_);
  }
  /// Whether there is nothing to go on for.
  bool is_done() const { return is_exact_ || axis_.gap > margin_; }
  /// Looks at b's faces and the edges, unless that is so.
  void go_on() {
    if (is_done()) return;
    const auto of_b =
        search_faces(pair_.b, pair_.a, Vector(-pair_.offset), points_a_, axis_.gap + rounding_);
    if (of_b.is_found)
      axis_ = {-pair_.b.normals()[of_b.face], of_b.separation, AxisKind::face_b, of_b.vertex,
               of_b.face};
    if (axis_.gap > margin_) return;
    const FaceMasks<T> below_b(pair_.b, points_a_, level());
    if (of_b.is_found && is_proved(pair_.b, of_b, Vector(-pair_.offset), pair_.a, below_b)) return;
    search_edges(edges_left(pair_.a, *below_a_), edges_left(pair_.b, below_b));
    if (axis_.gap <= T(0)) is_exact_ = true;
    if (axis_.kind == AxisKind::edges) measure_again();
  }

  const Axis<S>& axis() const { return axis_; }
  /// Whether its gap is the signed gap. Otherwise the shapes are apart, by the gap or more.
  bool is_exact() const { return is_exact_; }

 private:
  /// What an edge has to exceed; never positive, see edge_search.hpp.
  T level() const { return std::min(axis_.gap + rounding_, T(0)); }

  /// @param below  for each face of the shape the points of the other at most level() above it
  bool is_proved(const Placed<Polyhedron<T>>& shape, const FaceSeparation<T>& found,
                 const Vector& offset, const Placed<Polyhedron<T>>& other,
                 const FaceMasks<T>& below) {
    is_exact_ = below.in_common() != 0 ||
                (axis_.gap > T(0) &&
                 projects_onto(shape, found.face, Vector(other.vertices()[found.vertex] + offset)));
    return is_exact_;
  }

  void search_edges(const ShortList& edges_a, const ShortList& edges_b) {
    for (std::size_t i = 0; i < edges_a.size(); ++i) {
      const EdgeView<T> a(pair_.a, edges_a[i]);
      for (std::size_t j = 0; j < edges_b.size(); ++j)
        try_pair(a, edges_a[i], EdgeView<T>(pair_.b, edges_b[j]), edges_b[j]);
    }
  }
  void try_pair(const EdgeView<T>& a, std::uint32_t id_a, const EdgeView<T>& b,
                std::uint32_t id_b) {
    Vector n;
    if (!crossing_normal(a, b, n)) return;
    const Vector apart = b.from + pair_.offset - a.from;
    if (are_nearly_parallel(a, b)) return try_parallel(a, id_a, b, id_b, apart, n);
    if (!(n.dot(apart) > axis_.gap + rounding_)) return;
    if (try_lower_bound(id_a, id_b, n))
      is_exact_ = axis_.gap > T(0) && nearest_points_are_within(a, b, apart, n);
  }
  /// Whatever n is, its own separation is a lower bound of the gap: nothing that rounding did to
  /// the arcs can make the result too large.
  bool try_lower_bound(std::uint32_t id_a, std::uint32_t id_b, const Vector& n) {
    const T separation = pair_.separation(n);
    if (!(separation > axis_.gap + rounding_)) return false;
    axis_ = {n, separation, AxisKind::edges, id_a, id_b};
    is_exact_ = false;
    return true;
  }

  /// The normal of edges that are nearly parallel is known to an angle of some eps / sine only, and
  /// so is the separation along it. The edges' distance is known better, and the two are the same
  /// if the feet are within: as they are for the axis that is looked for.
  void try_parallel(const EdgeView<T>& a, std::uint32_t id_a, const EdgeView<T>& b,
                    std::uint32_t id_b, const Vector& apart, const Vector& n) {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    const T sine =
        a.direction.cross(b.direction).norm() / (a.direction.norm() * b.direction.norm());
    const T angle = T(16) * eps / sine;
    const T height = height_at_nearest(a, b, apart, n);
    if (sine < T(4) * std::cbrt(eps * eps) ||
        !nearest_points_are_within(a, b, apart, n, T(4) * angle) ||
        pair_.separation(n) < height - (rounding_ + angle * pair_.size)) {
      try_lower_bound(id_a, id_b, n);
    } else if (height > axis_.gap + rounding_) {
      axis_ = {n, height, AxisKind::edges, id_a, id_b};
      is_exact_ = false;
    }
  }

  /// From the edges alone, unless they are nearly parallel: then they have been.
  void measure_again() {
    Axis<S> axis = axis_;
    const EdgeView<T> a(pair_.a, axis_.a), b(pair_.b, axis_.b);
    if (!are_nearly_parallel(a, b) && measure_edges(a, b, pair_.offset, axis) &&
        std::abs(axis.gap - axis_.gap) <= rounding_)
      axis_ = axis;
  }

  const PolyhedronPair<T>& pair_;
  PointSet<T>&points_a_, &points_b_;
  const T margin_, rounding_;
  std::optional<FaceMasks<T>> below_a_;
  Axis<S> axis_;
  bool is_exact_ = false;
};

}  // namespace moreau::detail
