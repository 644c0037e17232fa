// SPDX-License-Identifier: MIT
// Polygon against polygon.
#pragma once

#include "moreau/detect/contact_class.hpp"
#include "moreau/detect/contact_segment.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polygon_axis.hpp"

namespace moreau {

namespace detail {

/// Of the two edges at the top vertex along the direction: the one with both ends at or above the
/// height, or else the one that faces it more.
template <std::floating_point T>
std::uint32_t facing_edge(const Placed<Polygon<T>>& shape, std::uint32_t top,
                          const typename Space<2, T>::Vector& direction, T height) {
  const auto count = static_cast<std::uint32_t>(shape.vertices().size());
  const std::uint32_t before = (top + count - 1) % count, after = (top + 1) % count;
  const bool has_before = direction.dot(shape.vertices()[before]) >= height;
  const bool has_after = direction.dot(shape.vertices()[after]) >= height;
  if (has_before != has_after) return has_before ? before : top;
  return direction.dot(shape.normals()[before]) > direction.dot(shape.normals()[top]) ? before
                                                                                      : top;
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
ContactSegment<T> contact_segment(const PolygonPair<T>& pair, const Axis<Space<2, T>>& axis,
                                  T margin) {
  const T slab = margin - axis.gap + pair.rounding();
  const auto facing = [&](const Placed<Polygon<T>>& shape,
                          const typename Space<2, T>::Vector& direction) {
    const Extreme<T> top = shape.vertices().farthest(direction);
    return facing_edge(shape, top.index, direction, top.value - slab);
  };
  const auto edge_a = axis.kind == AxisKind::face_a ? axis.a : facing(pair.a, axis.normal);
  const auto edge_b = axis.kind == AxisKind::face_b ? axis.b : facing(pair.b, -axis.normal);
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
  const bool is_on_both = axis.kind == AxisKind::vertices ||
                          (axis.kind == AxisKind::face_a
                               ? has_foot(pair.a, axis.a, pair.b.vertices()[axis.b] + pair.offset)
                               : has_foot(pair.b, axis.b, pair.a.vertices()[axis.a] - pair.offset));
  if (!is_on_both) {
    best.gap = std::numeric_limits<T>::infinity();
    contact_segment(pair, axis, std::max(axis.gap, T(0)))
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
  const ContactSegment<T> segment = contact_segment(pair, axis, margin);
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

}  // namespace detail

/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b,
             std::type_identity_t<T> margin, Manifold<Space<2, T>>& out,
             PairCache<Space<2, T>>& cache) {
  MOREAU_ASSERT(margin >= T(0));
  const detail::PolygonPair<T> pair(a, b);
  const T reach = pair.size + margin;
  if (pair.offset.squaredNorm() > reach * reach) return false;
  if (!cache.axis.isZero(0) && pair.separation(cache.axis) > margin) return false;
  auto [axis, is_exact] = pair.edge_axis(margin);
  cache.axis = axis.normal;
  if (axis.gap > margin) return false;
  if (!is_exact) {
    axis = pair.nearest_points();
    cache.axis = axis.normal;
    if (axis.gap > margin) return false;
  }
  detail::fill(pair, axis, margin, out);
  return true;
}

template <std::floating_point T>
SignedDistance<Space<2, T>> distance(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b) {
  using Vector = typename Space<2, T>::Vector;
  const detail::PolygonPair<T> pair(a, b);
  auto [axis, is_exact] = pair.edge_axis(std::numeric_limits<T>::infinity());
  if (!is_exact) axis = pair.nearest_points();
  const Vector witness = detail::middle_of_contact(pair, axis);
  const Vector half = T(0.5) * axis.gap * axis.normal;
  return {axis.gap, axis.normal, a.center() + (witness - half), a.center() + (witness + half)};
}

template <std::floating_point T>
bool overlap(const Placed<Polygon<T>>& a, const Placed<Polygon<T>>& b) {
  return detail::PolygonPair<T>(a, b).edge_axis(T(0)).axis.gap <= T(0);
}

}  // namespace moreau
