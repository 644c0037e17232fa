// SPDX-License-Identifier: MIT
// Polygon against polygon.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polytope/contact_class.hpp"
#include "moreau/detect/polytope/edge_overlap.hpp"
#include "moreau/detect/polytope/polygon_axis.hpp"
#include "moreau/detect/polytope/polygon_recall.hpp"
#include "moreau/detect/polytope/single_contact_point.hpp"

namespace moreau {

namespace detail {

/// The edge of one shape that looks along the direction: its own, if the axis is an edge's; or of
/// the two at the top vertex the one with both ends less than the slab [m] below it, or else the
/// one that faces the direction more.
template <std::floating_point T>
std::uint32_t facing_edge(const Placed<Polygon<T>>& shape, FeatureKind kind, std::uint32_t id,
                          const typename Space<2, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto count = static_cast<std::uint32_t>(shape.vertices().size());
  const std::uint32_t before = (id > 0 ? id : count) - 1, after = id + 1 < count ? id + 1 : 0;
  const T height = direction.dot(shape.vertices()[id]) - slab;
  const bool has_before = direction.dot(shape.vertices()[before]) >= height;
  const bool has_after = direction.dot(shape.vertices()[after]) >= height;
  if (has_before != has_after) return has_before ? before : id;
  return direction.dot(shape.normals()[before]) > direction.dot(shape.normals()[id]) ? before : id;
}

/// The point of contact if the edges' overlap does not hold it.
template <std::floating_point T>
ManifoldPoint<Space<2, T>> witness_point(const PolygonPair<T>& pair,
                                         const Axis<Space<2, T>>& axis) {
  using Vector = typename Space<2, T>::Vector;
  using Kind = FeatureKey::Kind;
  const Vector half = T(0.5) * axis.gap * axis.normal;
  if (axis.kind == AxisKind::face_a)
    return {pair.b.center() + (pair.b.vertices()[axis.b] - half), axis.gap,
            FeatureKey(Kind::edge_vertex, axis.a, axis.b)};
  const Kind kind = axis.kind == AxisKind::face_b ? Kind::vertex_edge : Kind::vertex_vertex;
  return {pair.a.center() + (pair.a.vertices()[axis.a] + half), axis.gap,
          FeatureKey(kind, axis.a, axis.b)};
}

/// The facing edges, whose overlap is the region of contact.
template <std::floating_point T>
EdgeOverlap<T> edge_overlap(const PolygonPair<T>& pair, const Axis<Space<2, T>>& axis, T margin) {
  const T slab = margin - axis.gap + pair.rounding();
  const auto edge_a = facing_edge(pair.a, feature_of_a(axis.kind), axis.a, axis.normal, slab);
  const auto edge_b = facing_edge(pair.b, feature_of_b(axis.kind), axis.b,
                                  typename Space<2, T>::Vector(-axis.normal), slab);
  return {pair.a,
          edge_a,
          pair.b,
          edge_b,
          pair.offset,
          axis.normal,
          pair.size * DetectionTolerance<T>::coincident};
}

/// Midway between the surfaces where they are nearest or deepest, relative to the centre of a.
template <std::floating_point T>
typename Space<2, T>::Vector middle_of_contact(const PolygonPair<T>& pair,
                                               const Axis<Space<2, T>>& axis) {
  auto best = witness_point(pair, axis);
  const bool is_on_both =
      axis.kind == AxisKind::vertices ||
      (axis.kind == AxisKind::face_a
           ? projects_onto(pair.a, axis.a, pair.b.vertices()[axis.b] + pair.offset)
           : projects_onto(pair.b, axis.b, pair.a.vertices()[axis.a] - pair.offset));
  if (!is_on_both) {
    best.gap = std::numeric_limits<T>::infinity();
    edge_overlap(pair, axis, std::max(axis.gap, T(0)))
        .for_each_corner([&](const ManifoldPoint<Space<2, T>>& corner) {
          if (corner.gap < best.gap) best = corner;
        });
  }
  return best.position - pair.a.center();
}

template <std::floating_point T>
void fill(const PolygonPair<T>& pair, const Axis<Space<2, T>>& axis, T margin,
          Manifold<Space<2, T>>& out) {
  using S = Space<2, T>;
  out.clear();
  out.normal = axis.normal;
  out.gap = axis.gap;
  const T near = pair.size * DetectionTolerance<T>::coincident;
  if (touches_only_at_vertex(pair, axis, margin - axis.gap + pair.rounding(), near)) {
    out.points.push_back(witness_point(pair, axis));
    out.contact_class = ContactClass::vertex_edge;
    return;
  }
  const EdgeOverlap<T> segment = edge_overlap(pair, axis, margin);
  T deepest = std::numeric_limits<T>::infinity();
  segment.for_each_corner([&](const ManifoldPoint<S>& corner) {
    if (!(corner.gap <= margin + pair.rounding())) return;
    deepest = std::min(deepest, corner.gap);
    out.points.push_back(corner);
  });
  // Nearest vertices lie above each other, but no edge takes part.
  const bool is_degenerate = axis.kind == AxisKind::vertices && out.points.size() == 1;
  if (is_degenerate) out.points.clear();
  if (is_degenerate || !(deepest <= axis.gap + T(64) * pair.rounding()))
    out.points.push_back(witness_point(pair, axis));
  out.sort();
  out.contact_class =
      out.points.size() == 1 ? class_of_point(out.points[0].feature) : ContactClass::edge_edge;
}

/// The axis, proved from the features of the step before or searched for.
/// @param margin  a gap larger than this need not be known exactly [m]
/// @returns whether the gap is at most the margin
template <std::floating_point T>
bool find_axis(const PolygonPair<T>& pair, T margin, PairCache<Space<2, T>>& cache,
               Axis<Space<2, T>>& axis) {
  if (PolygonRecall<T> recall(pair);
      recall.prove(cache) && std::abs(recall.axis().gap - margin) > pair.rounding()) {
    axis = recall.axis();
    return axis.gap <= margin;
  }
  const auto found = pair.edge_axis(margin);
  axis = found.axis;
  if (axis.gap <= margin && !found.is_exact) {
    // Where vertices all but touch, their difference has no direction: the edge's stays.
    const auto nearest = pair.nearest_points();
    const T doubt = T(4) * pair.rounding();
    if (pair.separation(nearest.normal) >= nearest.gap - doubt || axis.gap < nearest.gap - doubt)
      axis = nearest;
  }
  cache.remember(axis);
  if (axis.gap <= margin) return true;
  cache.kind = AxisKind::none;
  return false;
}

}  // namespace detail

/// All points of the contact of two polygons; reduce() keeps a few of them.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b,
             std::type_identity_t<T> margin, Manifold<Space<2, T>>& out,
             PairCache<Space<2, T>>& cache) {
  MOREAU_ASSERT(margin >= T(0));
  const detail::PolygonPair<T> pair(a, b);
  if (pair.is_apart_at_once(margin, cache)) return false;
  detail::Axis<Space<2, T>> axis;
  if (!detail::find_axis(pair, margin, cache, axis)) return false;
  detail::fill(pair, axis, margin, out);
  return true;
}

/// Signed distance of two polygons, exact to rounding, with what is remembered of the pair.
template <std::floating_point T>
SignedDistance<Space<2, T>> distance(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b,
                                     PairCache<Space<2, T>>& cache) {
  using Vector = typename Space<2, T>::Vector;
  const detail::PolygonPair<T> pair(a, b);
  detail::Axis<Space<2, T>> axis;
  detail::find_axis(pair, std::numeric_limits<T>::infinity(), cache, axis);
  const Vector witness = detail::middle_of_contact(pair, axis);
  const Vector half = T(0.5) * axis.gap * axis.normal;
  return {axis.gap, axis.normal, a.center() + (witness - half), a.center() + (witness + half)};
}

/// The same without a memory of the pair.
template <std::floating_point T>
SignedDistance<Space<2, T>> distance(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b) {
  PairCache<Space<2, T>> none;
  return distance(a, b, none);
}

/// Whether two polygons have a point in common.
template <std::floating_point T>
bool overlap(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b,
             PairCache<Space<2, T>>& cache) {
  const detail::PolygonPair<T> pair(a, b);
  detail::Axis<Space<2, T>> axis;
  return !pair.is_apart_at_once(T(0), cache) && detail::find_axis(pair, T(0), cache, axis);
}

/// The same without a memory of the pair.
template <std::floating_point T>
bool overlap(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b) {
  PairCache<Space<2, T>> none;
  return overlap(a, b, none);
}

}  // namespace moreau
