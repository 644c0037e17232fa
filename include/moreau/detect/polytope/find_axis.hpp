// SPDX-License-Identifier: MIT
// find_axis: the separating axis of a pair of polytopes, and with it the signed gap, by search.
//
// Polygons. The gap is at least the largest separation s(n) over the normals of all edges. It
// equals that if the shapes overlap, because the edges of B - A are theirs, or if the deepest
// vertex projects onto the edge. What remains are shapes apart with two vertices nearest to each
// other.
//
// Polyhedra.
//   1. Two steps of GJK part most pairs that are apart, or else give vertices near the contact.
//   2. The faces of a are searched (detail/face_edge_search.hpp).
//   3. If a face of a parts the shapes without being proved the answer, GJK is run to its end. The
//      features that it ends on are a guess, which is proved as features from the step before are.
//   4. The faces of b and the pairs of edges are searched. The best axis is exact except for shapes
//      that are apart with a vertex nearest to a vertex or an edge.
//   5. For those GJK is run to its end, and where GJK ends on rounding, all features that can be
//      nearest are compared (detail/nearest_features.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/detail/face_edge_search.hpp"
#include "moreau/detect/polytope/detail/nearest_features.hpp"
#include "moreau/detect/polytope/detail/simplex_features.hpp"
#include "moreau/detect/polytope/prove_axis.hpp"

namespace moreau::detail {

/// The edge of own along whose normal the lowest vertex of other is highest, and that height [m].
/// @param offset  centre of other minus centre of own, world axes [m]
template <std::floating_point T>
Extreme<T> best_edge(const Placed<Polygon<T>>& own, const Placed<Polygon<T>>& other,
                     const typename Space<2, T>::Vector& offset) {
  using W = Wide<T>;
  WideMaximum<T> best{W::broadcast(-std::numeric_limits<T>::infinity()), W::iota()};
  auto index = W::iota();
  const auto apart = Rows<Space<2, T>>::broadcast(offset);
  for (Eigen::Index i = 0; i < own.normals().padded_size(); i += W::lanes) {
    const auto normals = own.normals().wide(i);
    best.take(
        other.vertices().lowest(normals) + own.normals().dot(i, apart) - W::load(own.offsets() + i),
        index);
    index += W::lanes;
  }
  return best.reduce();
}

/// Compares a vertex x of one polygon with an edge of the other one, from vertex `edge` on, and
/// with that vertex; takes over the nearer one. For shapes that are apart.
/// @param x     relative to the centre of the edge's shape, world axes [m]
/// @param sign  1 if the edge is that of a, -1 if it is that of b
/// @param a,b   numbers of the edge and the vertex, that of a first
template <std::floating_point T>
void compare_point(const Placed<Polygon<T>>& shape, std::uint32_t edge,
                   const typename Space<2, T>::Vector& x, T sign, std::uint32_t a, std::uint32_t b,
                   Axis<Space<2, T>>& best) {
  using Vector = typename Space<2, T>::Vector;
  const std::size_t next = edge + 1 < shape.vertices().size() ? edge + 1 : 0;
  const Vector from = shape.vertices()[edge];
  const Vector apart = x - from;
  const Vector along = shape.vertices()[next] - from;
  const T t = along.dot(apart);
  if (t > T(0) && t < along.squaredNorm()) {
    const Vector normal = shape.normals()[edge];
    const T gap = normal.dot(apart);
    const AxisKind kind = sign > T(0) ? AxisKind::face_a : AxisKind::face_b;
    if (gap >= T(0) && gap < best.gap) best = {sign * normal, gap, kind, a, b};
  } else if (const T gap = apart.norm(); t <= T(0) && gap > T(0) && gap < best.gap) {
    best = {sign / gap * apart, gap, AxisKind::vertices, a, b};
  }
}
/// The axis of the nearest points of two polygons that are apart: every vertex against every edge.
template <std::floating_point T>
Axis<Space<2, T>> nearest_features(const PolytopePair<Polygon<T>>& pair) {
  using Vector = typename Space<2, T>::Vector;
  const auto &a = pair.a.vertices(), &b = pair.b.vertices();
  Axis<Space<2, T>> best{Vector::UnitX(), std::numeric_limits<T>::infinity(), AxisKind::vertices, 0,
                         0};
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      compare_point(pair.a, i, Vector(b[j] + pair.offset), T(1), i, j, best);
      compare_point(pair.b, j, Vector(a[i] - pair.offset), T(-1), i, j, best);
    }
  return best.kind == AxisKind::vertices ? axis_of_nearest(pair, AxisKind::vertices, best.a, best.b)
                                         : best;
}

/// The axis of two polygons among the normals of their edges.
template <std::floating_point T>
struct EdgeAxis {
  Axis<Space<2, T>> axis;
  bool is_exact;  ///< whether it has the signed gap; otherwise the shapes are apart by the gap or
                  ///< more
};
/// @param margin  the search stops at an axis that separates by more [m]
template <std::floating_point T>
EdgeAxis<T> find_edge_axis(const PolytopePair<Polygon<T>>& pair, T margin) {
  const Extreme<T> of_a = best_edge(pair.a, pair.b, pair.offset);
  if (of_a.value > margin) return {axis_of_face_a(pair, of_a.index), false};
  const Extreme<T> of_b = best_edge(pair.b, pair.a, -pair.offset);
  const bool take_b = of_b.value > of_a.value + pair.rounding();
  const auto axis = take_b ? axis_of_face_b(pair, of_b.index) : axis_of_face_a(pair, of_a.index);
  const bool is_exact =
      axis.gap <= T(0) ||
      (take_b ? projects_onto(pair.b, axis.b, pair.a.vertices()[axis.a] - pair.offset)
              : projects_onto(pair.a, axis.a, pair.b.vertices()[axis.b] + pair.offset));
  return {axis, is_exact};
}

/// The axis of two polygons.
/// @param margin  a gap larger than this need not be known exactly [m], >= 0
template <std::floating_point T>
FoundAxis<Space<2, T>> find_axis(const PolytopePair<Polygon<T>>& pair, T margin) {
  const auto [axis, is_exact] = find_edge_axis(pair, margin);
  if (axis.gap > margin || is_exact) return {axis, axis.gap > margin};
  const auto nearest = nearest_features(pair);
  // Where two vertices all but touch, their difference has no direction: the edge's normal stays.
  const T doubt = T(4) * pair.rounding();
  const bool take_nearest =
      pair.separation(nearest.normal) >= nearest.gap - doubt || axis.gap < nearest.gap - doubt;
  const Axis<Space<2, T>>& best = take_nearest ? nearest : axis;
  return {best, best.gap > margin};
}

/// GJK on a pair of polyhedra, a few steps at a time.
template <std::floating_point T>
struct PairGjk {
  using Vector = typename Space<3, T>::Vector;
  const PolytopePair<Polyhedron<T>>& pair;
  const T margin;                              ///< the iteration stops beyond this gap [m]
  Simplex<T> simplex;                          ///< the nearest points so far
  Vector direction = Vector::Zero();           ///< the last direction, any length
  Proximity proximity = Proximity::undecided;  ///< of the shapes, as far as it is known
  bool is_beyond() const { return proximity == Proximity::beyond; }

  /// Goes on by some steps, unless it is decided how near the shapes are.
  void run(int steps) {
    if (proximity != Proximity::undecided) return;
    proximity = gjk<T>([this](const Vector& n) { return pair.support(n); }, simplex, direction,
                       margin, pair.size, steps);
  }
  /// An axis that separates by more than the margin.
  FoundAxis<Space<3, T>> separating_axis() const {
    FoundAxis<Space<3, T>> found;
    found.axis.normal = direction.normalized();
    found.is_beyond = true;
    return found;
  }
};

/// The vertices of a simplex of GJK as two sets of points, each relative to the other shape's
/// centre.
template <std::floating_point T>
void collect_vertices(const PolytopePair<Polyhedron<T>>& pair, const Simplex<T>& simplex,
                      PointSet<T>& points_a, PointSet<T>& points_b) {
  for (int i = 0; i < simplex.size(); ++i) {
    const std::uint32_t a = simplex[i].a, b = simplex[i].b;
    if (!points_a.contains(a)) points_a.add(a, pair.a.vertices()[a] - pair.offset);
    if (!points_b.contains(b)) points_b.add(b, pair.b.vertices()[b] + pair.offset);
  }
}

/// The axis that GJK ended on, with the distance of two points of the shapes.
template <std::floating_point T>
struct GjkEnd {
  T distance;  ///< [m]: an upper bound of the gap
  Axis<Space<3, T>> axis = {};
  std::optional<WitnessPoints<Space<3, T>>> nearest = std::nullopt;  ///< see FoundAxis
};
template <std::floating_point T>
GjkEnd<T> measure_end(const PolytopePair<Polyhedron<T>>& pair, const Simplex<T>& simplex) {
  if (simplex.size() == 4) return {simplex[0].point.norm()};
  const auto features = features_of(pair, simplex);
  if (features.kind != AxisKind::nearest_points) {
    const auto axis = axis_of_nearest(pair, features.kind, features.a, features.b);
    return {axis.gap, axis};
  }
  const auto points = witness_of(pair, simplex);
  return {(points.on_b - points.on_a).norm(),
          {simplex.direction().normalized(), simplex.nearest().norm(), features.kind, features.a,
           features.b},
          points};
}

/// Step 5: the axis of the nearest points of two polyhedra, unless the face or the edges of `flat`
/// lie across it just as far away, so that the nearest points are on them. The normal of a face or
/// of edges does not suffer from the rounding of a small difference, as that of two points does.
///
/// The distance of any two points of the shapes is an upper bound of the gap, the separation along
/// any direction a lower bound. What GJK ended on is taken where the two meet; else all features
/// are compared that can be nearest.
/// @param flat  the best axis of faces and edges
template <std::floating_point T>
FoundAxis<Space<3, T>> find_nearest_points(const PolytopePair<Polyhedron<T>>& pair,
                                           const Simplex<T>& simplex, const Axis<Space<3, T>>& flat,
                                           T margin) {
  const T doubt = T(4) * pair.rounding();
  if (flat.gap <= doubt && simplex.size() == 4) return {flat};
  GjkEnd<T> end = measure_end(pair, simplex);
  const T upper = end.distance;
  if (upper <= doubt) return {flat};
  const auto separates = [&](const Axis<Space<3, T>>& axis) {
    return pair.separation(axis.normal) >= axis.gap - doubt;
  };
  bool is_exact = std::abs(upper - end.axis.gap) <= doubt && separates(end.axis);
  if (!is_exact) {
    const T slab = std::max(upper - flat.gap, T(0)) + doubt;
    end.axis = nearest_features(pair, flat.normal, slab);
    if (!std::isfinite(end.axis.gap)) return {flat};
    is_exact = separates(end.axis);
  }
  const T turn = (flat.normal - end.axis.normal).norm();
  const bool is_aligned = turn < DetectionTolerance<T>::aligned &&
                          turn * end.axis.gap < pair.size * DetectionTolerance<T>::coincident;
  const T lacking = end.axis.gap - flat.gap;
  const bool take_nearest =
      lacking > doubt || (is_exact && (lacking > pair.rounding() || !is_aligned));
  if (!take_nearest) return {flat, flat.gap > margin};
  return {end.axis, end.axis.gap > margin, end.nearest};
}

/// The axis of two polyhedra; the head of this file numbers the steps.
/// @param margin  a gap larger than this need not be known exactly [m], >= 0
template <std::floating_point T>
FoundAxis<Space<3, T>> find_axis(const PolytopePair<Polyhedron<T>>& pair, T margin) {
  constexpr int first_steps = 2;
  const typename Space<3, T>::Vector start = pair.start();
  PairGjk<T> gjk{pair, margin, Simplex<T>(pair.support(start)), start};
  const T separation = start.dot(gjk.simplex[0].point);
  if (separation > T(0) && separation * separation > margin * margin * start.squaredNorm())
    return gjk.separating_axis();
  gjk.run(first_steps);
  if (gjk.is_beyond()) return gjk.separating_axis();

  PointSet<T> points_a, points_b;
  collect_vertices(pair, gjk.simplex, points_a, points_b);
  FaceEdgeSearch<T> search(pair, points_a, points_b, margin);
  search.search_faces_of_a();
  if (!search.is_done() && search.axis().gap > T(0)) {
    gjk.run(all_steps);
    if (gjk.is_beyond()) return gjk.separating_axis();
    if (gjk.proximity == Proximity::apart) {
      const auto guess = gjk.simplex.size() == 3 ? guess_features_of(pair, gjk.simplex)
                                                 : features_of(pair, gjk.simplex);
      const auto proved = prove_axis(pair, guess);
      if (proved && std::abs(proved->gap - margin) > pair.rounding())
        return {*proved, proved->gap > margin};
    }
  }
  search.search_faces_of_b_and_edges();
  const Axis<Space<3, T>>& axis = search.axis();
  if (axis.gap > margin) return {axis, true};
  if (search.is_exact()) return {axis};
  gjk.run(all_steps);
  if (gjk.is_beyond()) return gjk.separating_axis();
  return find_nearest_points(pair, gjk.simplex, axis, margin);
}

}  // namespace moreau::detail
