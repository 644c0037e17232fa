// SPDX-License-Identifier: MIT
// prove_faces: the proof of prove_axis.hpp for two polyhedra of which two faces lie on each other, nearly parallel, as
// those of stacked boxes. Several features then have nearly the same separation, and the projection lies near the rim
// of the facet of each, so that prove_axis fails. Here all facets of C = B - A that the two faces make are taken
// together.
//
// Let n be the axis, s its separation, d = max(0, -s), f and g the two faces. Seen along n, the differences between a
// point of g and a point of f are a polygon P. Let its rim be at a distance of at least R from the origin
// (ContactPolygon::clearance), and let all these differences have a height along n of at most s + e. So for every m at
// an angle theta from n
//     F(m) <= (s + e) cos theta - R sin theta,
// which is the first bound of prove_axis.hpp with R in place of r and e added to the doubt. It excludes all m beyond an
// angle `zone`. The features that can make an axis at a smaller angle have their vertices near the top of their shape,
// and it is required that these are the vertices of f and g. So f, g and pairs of their edges are left.
//
// Of these the full search takes f unless another separates by more than rounding beyond it, then g unless a pair of
// edges does. If the projection onto the facet of n has the distance r > d tan(zone / 2) from its rim, then no m within
// the zone has a larger F than n has (first bound of prove_axis.hpp). So
//   - f is taken if it makes n;
//   - g is taken if it makes n and f separates by less, by more than rounding;
//   - two edges are taken if they make n, if f and g separate by less, and if all other edges are ruled out as in
//     prove_axis.hpp, now within the zone alone.
// If f makes n and the projection lies outside, f is still taken if the smallest gap of two points opposite each other
// exceeds s by less than rounding, because F(m) is at most the gap of any two such points.
//
// Edges that are nearly parallel are measured in another way by the search (FaceEdgeSearch::try_parallel). Those of f
// and g that can cross are measured here, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "moreau/detect/polytope/contact_polygon.hpp"
#include "moreau/detect/polytope/detail/edge_search.hpp"
#include "moreau/detect/polytope/prove_axis.hpp"

namespace moreau::detail {

/// Whether so many vertices of both shapes lie near the top along an axis that faces can lie on each other there. A
/// quick test, before prove_faces().
template <std::floating_point T>
bool faces_may_lie_on_each_other(const PolytopePair<Polyhedron<T>>& pair,
                                 const Axis<Space<3, T>>& axis) {
  using Vector = typename Space<3, T>::Vector;
  constexpr T angle = T(2e-3);
  const auto has_three = [](const Placed<Polyhedron<T>>& shape, const Vector& n) {
    return count_top(shape, n, shape.vertices().reach(n), angle) >= 3;
  };
  return has_three(pair.a, axis.normal) && has_three(pair.b, Vector(-axis.normal));
}

/// Whether the vertices of a face are the only vertices of the shape that can be the top along a direction at most
/// `angle` [rad] from n.
/// @param lowest height of the lowest vertex of the face along n [m]
template <std::floating_point T>
bool face_is_top(const Placed<Polyhedron<T>>& shape, std::size_t vertices, T lowest,
                 const typename Space<3, T>::Vector& n, T angle) {
  const T least = shape.vertices().reach(n) - T(2) * angle * shape.radius();
  return lowest >= least &&
         shape.vertices().count_above(n, least) == static_cast<std::ptrdiff_t>(vertices);
}

/// Whether nearly parallel edges of two shapes separate by at most `most` [m], in either way in which the search
/// measures them.
template <std::floating_point T>
bool parallel_edges_are_lower(const PolytopePair<Polyhedron<T>>& pair, std::uint32_t edge_a,
                              std::uint32_t edge_b, T most) {
  typename Space<3, T>::Vector n;
  const EdgeView<T> a(pair.a, edge_a), b(pair.b, edge_b);
  if (!crossing_normal(a, b, n) || !are_nearly_parallel(a, b)) return true;
  const auto apart = (b.from + pair.offset - a.from).eval();
  return std::max(pair.separation(n), height_at_nearest<T>(a, b, apart, n)) <= most;
}

/// Whether the search takes the axis, if only two faces and their edges are left.
/// @param zone   angle from the axis within which only these are left [rad]
/// @param deepest gap of the deepest corner of the contact polygon [m]
template <std::floating_point T>
bool is_taken_of_faces(const PolytopePair<Polyhedron<T>>& pair,
                       const RememberedAxis<Space<3, T>>& remembered, const FacingFeatures& facing,
                       T zone, T deepest) {
  using Vector = typename Space<3, T>::Vector;
  const auto& axis = remembered.axis;
  const T doubt = DetectionTolerance<T>::doubt * pair.size;
  const T depth = std::max(-axis.gap, T(0)) + doubt;
  const bool is_apart = axis.gap > T(0);
  const T spare = remembered.clearance - depth * zone;
  const bool is_inside = spare > (is_apart ? T(100) * doubt : T(0));
  if (axis.kind == AxisKind::face_a) {
    if (is_apart) return remembered.clearance >= T(0);
    const Vector slope = axis.normal + pair.b.normals()[facing.b];
    const T beside = T(2) * DetectionTolerance<T>::coincident * pair.size * slope.norm();
    return is_inside || deepest + beside + depth * zone * zone <= axis.gap + pair.rounding() / 2;
  }
  const T less = axis.gap - T(1.5) * pair.rounding();
  if (!is_inside || !(measure_face(pair.a, facing.a, pair.b, pair.offset).separation < less))
    return false;
  if (axis.kind == AxisKind::face_b) return true;
  return measure_face(pair.b, facing.b, pair.a, Vector(-pair.offset)).separation < less &&
         edges_are_top(pair, axis, T(2) * doubt / spare);
}

/// Whether it is proved that find_axis would find the features of an axis, given the contact polygon of the facing
/// features along this axis.
/// @param deepest  gap of the deepest corner of the polygon [m]
template <std::floating_point T>
bool prove_faces(const PolytopePair<Polyhedron<T>>& pair,
                 const RememberedAxis<Space<3, T>>& remembered, const FacingFeatures& facing,
                 const ContactPolygon<T>& polygon, T deepest) {
  using Vector = typename Space<3, T>::Vector;
  const auto& axis = remembered.axis;
  const auto [low_a, high_b] = polygon.unevenness();
  const T uneven = std::max(high_b - low_a - axis.gap, T(0));
  const T zone = excluded_beyond(pair, axis, polygon.clearance(), uneven);
  if (!std::isfinite(zone)) return false;
  const T low_b = axis.normal.dot(pair.offset) - high_b;  // along -n, from the centre of b
  if (!face_is_top(pair.a, polygon.loop_a().size(), low_a, axis.normal, zone) ||
      !face_is_top(pair.b, polygon.loop_b().size(), low_b, Vector(-axis.normal), zone) ||
      !is_taken_of_faces(pair, remembered, facing, zone, deepest))
    return false;
  const T most = axis.gap + (axis.kind == AxisKind::edges ? T(-1.5) : T(0.5)) * pair.rounding();
  bool are_lower = true;
  polygon.for_each_parallel([&](std::uint32_t edge_a, std::uint32_t edge_b) {
    are_lower = are_lower && parallel_edges_are_lower(pair, edge_a, edge_b, most);
  });
  return are_lower;
}

}  // namespace moreau::detail
