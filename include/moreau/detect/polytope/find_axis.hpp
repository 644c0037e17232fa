// SPDX-License-Identifier: MIT
// find_axis: searches the separating axis of a pair of polytopes and the signed gap along it. The
// separation s(n) along a unit vector n is defined in axis.hpp.
//
// Polygons. The largest separation s(n) over the normals of all edges is a lower bound of the gap.
// It equals the gap in two cases:
//   - The shapes overlap, because every edge of B - A, the set of all differences b - a, is
//     parallel to an edge of A or B.
//   - The vertex of one polygon that is deepest below the best edge of the other polygon projects
//     onto this edge.
// Otherwise the shapes are apart, and two vertices may be nearest to each other. All vertices and
// edges are then compared.
//
// Polyhedra.
//   1. Two iterations of GJK separate most pairs that are apart. For other pairs they give vertices
//      near the contact.
//   2. The faces of a are searched (detail/face_edge_search.hpp).
//   3. If a face of a separates the shapes, but is not proved to make the axis, GJK is run to its
//      end. The features on which GJK ends are a guess, which prove_axis proves or rejects.
//   4. The faces of b and the pairs of edges are searched. The best axis is then exact, except for
//      shapes that are apart and of which a vertex is nearest to a vertex or an edge.
//   5. For these shapes GJK is run to its end. If GJK ends on rounding errors, all features that
//      can be nearest are compared (detail/nearest_features.hpp).
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

/// The edge of `own` along whose normal the separation from `other` is largest, and this separation
/// [m].
/// @param offset  centre of other minus centre of own, world axes [m]
template <std::floating_point T>
Extreme<T> best_edge(const Placed<Polygon<T>>& own, const Placed<Polygon<T>>& other,
                     const typename Space<2, T>::Vector& offset) {
  using Lanes = Wide<T>;
  WideMaximum<T> best{Lanes::broadcast(-std::numeric_limits<T>::infinity()), Lanes::iota()};
  auto index = Lanes::iota();
  const auto apart = PointRows<Space<2, T>>::broadcast(offset);
  for (Eigen::Index i = 0; i < own.normals().padded_size(); i += Lanes::lanes) {
    const auto normals = own.normals().wide(i);
    best.take(other.vertices().lowest(normals) + own.normals().dot(i, apart) -
                  Lanes::load(own.offsets() + i),
              index);
    index += Lanes::lanes;
  }
  return best.reduce();
}

/// Compares a vertex x of one polygon with an edge of the other polygon and with the first vertex
/// of this edge. If one of them is nearer than the nearest features so far, replaces `best`. For
/// shapes that are apart.
/// @param edge  index of the edge and of its first vertex
/// @param x     position of the vertex relative to the centre of the edge's shape, world axes [m]
/// @param sign  1 if the edge belongs to a, -1 if it belongs to b
/// @param a,b   indices of a's and b's feature: the edge and the vertex, or the reverse
/// @param best  the axis of the nearest features so far
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
/// The axis of the nearest points of two polygons that are apart. Every vertex of each polygon is
/// compared with every edge of the other polygon.
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

/// The normal of an edge along which the separation of two polygons is largest.
template <std::floating_point T>
struct EdgeAxis {
  Axis<Space<2, T>> axis;
  bool is_exact;  ///< whether axis.gap is the signed gap; if not, the signed gap is at least
                  ///< axis.gap
};
/// @param margin  the search stops at an axis that separates the shapes by more than this [m]
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

/// The separating axis of two polygons.
/// @param margin  the gap need not be exact if it is larger than this [m], >= 0
template <std::floating_point T>
FoundAxis<Space<2, T>> find_axis(const PolytopePair<Polygon<T>>& pair, T margin) {
  const auto [axis, is_exact] = find_edge_axis(pair, margin);
  if (axis.gap > margin || is_exact) return {axis, axis.gap > margin};
  const auto nearest = nearest_features(pair);
  // The direction between two vertices at a distance d has an error of about eps size / d. If the shapes are not
  // separated by d along it, d is not the gap, or the vertices almost touch. In both cases the normal of the edge
  // separates by the gap, to rounding: a feature at the gap that nearest_features() left out is an edge whose vertex
  // lies below it by a rounding; and if the true direction is that of the two vertices, the normal of the edge
  // differs from it by no more than the error.
  const bool take_nearest = pair.separation(nearest.normal) >= nearest.gap - T(4) * pair.rounding();
  const Axis<Space<2, T>>& best = take_nearest ? nearest : axis;
  return {best, best.gap > margin};
}

/// GJK on a pair of polyhedra. It can be run in portions of a few iterations.
template <std::floating_point T>
struct PairGjk {
  using Vector = typename Space<3, T>::Vector;
  const PolytopePair<Polyhedron<T>>& pair;
  const T margin;      ///< the iteration stops if the gap exceeds this [m]
  Simplex<T> simplex;  ///< the current simplex, which contains the nearest point found so far
  Vector direction = Vector::Zero();  ///< the last search direction, of any length, world axes
  Proximity proximity = Proximity::undecided;  ///< result of the iteration so far
  bool is_beyond() const { return proximity == Proximity::beyond; }

  /// Runs some more iterations, unless it is already known how near the shapes are.
  void run(int steps) {
    if (proximity != Proximity::undecided) return;
    proximity = gjk<T>([this](const Vector& n) { return pair.support(n); }, simplex, direction,
                       margin, pair.size, steps);
  }
  /// The axis found if the shapes are separated by more than the margin.
  FoundAxis<Space<3, T>> separating_axis() const {
    FoundAxis<Space<3, T>> found;
    found.axis.normal = direction.normalized();
    found.is_beyond = true;
    return found;
  }
};

/// Adds the vertices of a GJK simplex to two sets of points. Vertices of a are stored relative to
/// the centre of b, vertices of b relative to the centre of a.
template <std::floating_point T>
void collect_vertices(const PolytopePair<Polyhedron<T>>& pair, const Simplex<T>& simplex,
                      PointSet<T>& points_a, PointSet<T>& points_b) {
  for (int i = 0; i < simplex.size(); ++i) {
    const std::uint32_t a = simplex[i].a, b = simplex[i].b;
    if (!points_a.contains(a)) points_a.add(a, pair.a.vertices()[a] - pair.offset);
    if (!points_b.contains(b)) points_b.add(b, pair.b.vertices()[b] + pair.offset);
  }
}

/// The axis on which GJK ended, and the distance of two points of the shapes.
template <std::floating_point T>
struct GjkEnd {
  T distance;  ///< distance of a point of a from a point of b, an upper bound of the gap [m]
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

/// The direction between two vertices at a distance d has an error of about eps size / d. It can so point beyond the
/// normals at the vertices, where another vertex is farther along it. The true direction is then perpendicular to the
/// edge that leads there, to within the error.
/// @param axis  of two vertices
/// @returns the direction, made perpendicular to the edge; unchanged if both vertices are the farthest
template <std::floating_point T>
typename Space<3, T>::Vector perpendicular_to_edge(const PolytopePair<Polyhedron<T>>& pair,
                                                   const Axis<Space<3, T>>& axis) {
  using Vector = typename Space<3, T>::Vector;
  const Vector& n = axis.normal;
  const auto top = pair.support(n);
  const Vector of_a = pair.a.vertices()[top.a] - pair.a.vertices()[axis.a];
  const Vector of_b = pair.b.vertices()[top.b] - pair.b.vertices()[axis.b];
  const Vector edge = n.dot(of_a) > -n.dot(of_b) ? of_a : of_b;
  const T length2 = edge.squaredNorm();
  if (!(length2 > T(0))) return n;
  const Vector turned = n - n.dot(edge) / length2 * edge;
  return turned.squaredNorm() > T(0.25) ? Vector(turned.normalized()) : n;
}

/// Step 5: the axis of the nearest points of two polyhedra. The axis `flat` of a face or of two
/// edges is kept if it has the same gap and nearly the same direction, because the nearest points
/// then lie on these features. The direction between two points suffers from rounding if the points
/// are close together; the normal of a face or of two edges does not.
///
/// The distance of any point of a from any point of b is an upper bound of the gap. The separation
/// along any direction is a lower bound. If both bounds agree for the result of GJK, this result is
/// exact. Otherwise all features that can be nearest are compared.
/// @param flat  the best axis of a face or of two edges
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
    if (!is_exact && end.axis.kind == AxisKind::vertices) {
      end.axis.normal = perpendicular_to_edge(pair, end.axis);
      is_exact = separates(end.axis);
    }
    // The distance of two features is not the gap if an axis separates by more than the direction between them does.
    if (!is_exact && !(pair.separation(end.axis.normal) > flat.gap))
      return {flat, flat.gap > margin};
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

/// The separating axis of two polyhedra. The steps are numbered at the top of this file.
/// @param margin  the gap need not be exact if it is larger than this [m], >= 0
template <std::floating_point T>
FoundAxis<Space<3, T>> find_axis(const PolytopePair<Polyhedron<T>>& pair, T margin) {
  constexpr int first_steps = 2;
  const typename Space<3, T>::Vector start = pair.start();
  PairGjk<T> gjk{pair, margin, Simplex<T>(pair.support(start), pair.size), start};
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
