// SPDX-License-Identifier: MIT
// prove_axis: proves that the features which made the axis of a pair of polytopes in the previous
// step make it also for the present poses.
//
// The proof uses the present poses only. It needs no bound on the motion since the previous step.
//
// Let C = B - A be the set of all differences b - a. Let F(m) = min over c in C of m . c be the
// separation along the unit vector m. The signed gap is the largest F(m). Let n be the axis that
// the remembered features make, s = F(n), and d = max(0, -s). Suppose that two conditions hold for
// C.
//
//   1. The point s n lies in the facet of C with the normal n, at a distance of at least r from the
//      rim of the facet. This is the case if the projection of one feature onto the other lies that
//      far inside. The disk of radius r about s n then lies in C. So for every m at an angle theta
//      from n
//          F(m) <= s cos theta - r sin theta.
//      With tau = tan(theta / 2), the right side is less than s by at least
//      2 tau (r - d tau) / (1 + tau^2).
//   2. The shapes contain balls about their centres, and rho is the sum of the radii of these
//      balls. C then contains a ball of radius rho about c, the difference of the centres. Let
//      h = c . n and t^2 = |c|^2 - h^2. So for every m at an angle theta from n
//          F(m) <= h cos theta + t sin theta - rho.
//      The right side is less than -d where (h + rho - d) tau^2 - 2 t tau - (h + d - rho) >= 0.
//      Every tau beyond the larger root of this polynomial satisfies the inequality. The root is
//          tau_0 = (t + sqrt(|c|^2 - (rho - d)^2)) / (h + rho - d).
//
// So if r >= d tau_0, the first bound excludes all m up to tau_0 and the second bound excludes all
// m beyond tau_0: no axis separates the shapes by more than n does. In words: if the overlap is
// shallow and the projection lies well inside the features, this overlap is the global one. If the
// shapes are apart (d = 0), it suffices that the projection of one feature onto the other lies
// inside, at any distance from the rim: the distance of convex shapes is a convex problem, whose
// local minimum is the global one.
//
// The result must also be equal to the result of the full search. If several axes have the same
// separation to within rounding, the full search returns the first of them. So the proof must
// exclude other axes with the same separation. An axis at an angle of more than theta from n has a
// separation smaller by more than `doubt` if r >= d tau_0 + 2 doubt / theta, tau_0 < 100 and
// theta < 0.04, where d includes `doubt` (DetectionTolerance). So theta follows from the distance r that
// the projection has. Axes at a smaller angle are excluded by requiring that no other feature of either
// shape has a direction that close to n. If any of these conditions fails, prove_axis returns nothing,
// and the full search is made.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

/// The axis that remembered features make for the present poses. It is not proved yet.
template <class S>
struct RememberedAxis {
  Axis<S> axis;
  typename S::Scalar
      clearance;  ///< the distance r of the projection from the rim of the facet [m], < 0 if it
                  ///< lies outside
};

/// The angle theta [rad] from the axis beyond which the proof excludes all other axes, at least `distinct`;
/// infinite if it excludes none.
/// @param clearance  the distance r of the projection from the rim of the facet, or of the facets taken together
///                   [m]
/// @param uneven     largest height of a point of these facets above the point s n, along n [m]
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar excluded_beyond(const PolytopePair<ShapeT>& pair,
                                                 const Axis<SpaceOf<ShapeT>>& axis,
                                                 typename SpaceOf<ShapeT>::Scalar clearance,
                                                 typename SpaceOf<ShapeT>::Scalar uneven = 0) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  constexpr T infinity = std::numeric_limits<T>::infinity();
  if (!(clearance >= T(0))) return infinity;
  const T height = axis.normal.dot(pair.offset), apart2 = pair.offset.squaredNorm();
  const T inner = pair.a.shape().inradius() + pair.b.shape().inradius();
  const T doubt = DetectionTolerance<T>::doubt * pair.size;
  const T depth = std::max(-axis.gap, T(0)) + doubt;
  const T aside = std::sqrt(std::max(apart2 - height * height, T(0)));
  const T within = inner - depth;
  const T root = std::sqrt(std::max(apart2 - within * within, T(0)));
  if (!(aside + root < T(100) * (height + within))) return infinity;
  const T spare = clearance - depth * (aside + root) / (height + within);
  const T below = T(2) * doubt + uneven;
  return below < T(0.04) * spare ? std::max(DetectionTolerance<T>::distinct, below / spare)
                                 : infinity;
}
/// The distance of the projection of a point onto a face from the rim of the face [m]; < 0 if the projection lies
/// outside.
/// @param point  relative to the centre of the shape, world axes [m]
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar rim_distance(const Placed<ShapeT>& shape, std::size_t face,
                                              const typename SpaceOf<ShapeT>::Vector& point) {
  const auto distance2 = rim_distance2(shape, face, point);
  return distance2 < 0 ? distance2 : std::sqrt(distance2);
}

/// Whether the normals of all other faces differ from that of a face by more than `angle` [rad].
template <class ShapeT>
bool is_alone(const Placed<ShapeT>& shape, std::size_t face,
              typename SpaceOf<ShapeT>::Scalar angle) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  if (shape.shape().normal_spacing() >= angle) return true;
  // 1 - angle^2 / 2 is at most the cosine; the rest allows for rounding.
  const T cosine = T(1) - T(0.55) * angle * angle - T(4) * std::numeric_limits<T>::epsilon();
  return shape.normals().count_above(shape.normals()[face], cosine) == 1;
}

/// The number of vertices of a shape that can be its top vertex along a direction at most `angle`
/// [rad] from `direction`. Only these vertices can belong to a face or an edge perpendicular to
/// such a direction.
/// @param top  height of the top vertex along `direction` [m]
template <class ShapeT>
std::ptrdiff_t count_top(const Placed<ShapeT>& shape,
                         const typename SpaceOf<ShapeT>::Vector& direction,
                         typename SpaceOf<ShapeT>::Scalar top,
                         typename SpaceOf<ShapeT>::Scalar angle) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  return shape.vertices().count_above(direction, top - T(2) * angle * shape.radius());
}
/// Whether count_top counts this vertex only.
template <class ShapeT>
bool vertex_is_top(const Placed<ShapeT>& shape, std::uint32_t vertex,
                   const typename SpaceOf<ShapeT>::Vector& direction,
                   typename SpaceOf<ShapeT>::Scalar angle) {
  return count_top(shape, direction, direction.dot(shape.vertices()[vertex]), angle) == 1;
}
/// Whether count_top counts the two ends of this edge only.
template <std::floating_point T>
bool edge_is_top(const Placed<Polyhedron<T>>& shape, std::uint32_t edge,
                 const typename Space<3, T>::Vector& direction, T angle) {
  const auto& ends = shape.shape().edges()[edge].vertex;
  const T first = direction.dot(shape.vertices()[ends[0]]);
  const T second = direction.dot(shape.vertices()[ends[1]]);
  const T top = std::max(first, second);
  return std::abs(first - second) < T(2) * angle * shape.radius() &&
         count_top(shape, direction, top, angle) == 2;
}

/// Whether so many vertices count as top vertices that a face can be perpendicular to the direction.
/// @param vertex  the top vertex
template <std::floating_point T>
bool has_face_near_top(const Placed<Polyhedron<T>>& shape, std::uint32_t vertex,
                       const typename Space<3, T>::Vector& direction, T angle) {
  return count_top(shape, direction, direction.dot(shape.vertices()[vertex]), angle) >= 3;
}
/// For polygons: the second highest vertex is a neighbour of the top vertex.
template <std::floating_point T>
bool has_face_near_top(const Placed<Polygon<T>>& shape, std::uint32_t vertex,
                       const typename Space<2, T>::Vector& direction, T angle) {
  const auto height = [&](std::uint32_t v) { return direction.dot(shape.vertices()[v]); };
  const auto [before, after] = neighbours(shape, vertex);
  return std::max(height(before), height(after)) >= height(vertex) - T(2) * angle * shape.radius();
}

/// The axis of a face of a.
/// @param vertex  of b, the deepest in the previous step
template <class ShapeT>
RememberedAxis<SpaceOf<ShapeT>> remember_face_a(const PolytopePair<ShapeT>& pair,
                                                std::uint32_t face, std::uint32_t vertex) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const auto axis = axis_of_face_a(pair, face, vertex);
  return {axis, rim_distance(pair.a, face, Vector(pair.b.vertices()[axis.b] + pair.offset))};
}
/// Whether an axis of a face of a is proved. The full search takes a face of a unless another axis separates
/// by more than rounding beyond it. So the only further condition is that no other face of a has
/// nearly the same normal.
template <class ShapeT>
bool is_face_a_proved(const PolytopePair<ShapeT>& pair,
                      const RememberedAxis<SpaceOf<ShapeT>>& remembered) {
  const auto angle = excluded_beyond(pair, remembered.axis, remembered.clearance);
  return std::isfinite(angle) && is_alone(pair.a, remembered.axis.a, 2 * angle);
}
/// The axis of a face of b.
/// @param vertex  of a, the deepest in the previous step
template <class ShapeT>
RememberedAxis<SpaceOf<ShapeT>> remember_face_b(const PolytopePair<ShapeT>& pair,
                                                std::uint32_t vertex, std::uint32_t face) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const auto axis = axis_of_face_b(pair, face, vertex);
  return {axis, rim_distance(pair.b, face, Vector(pair.a.vertices()[axis.a] - pair.offset))};
}
/// Whether an axis of a face of b is proved. In addition, no face of a may be nearly perpendicular to the
/// axis. A face has at least as many vertices as the space has dimensions, so the number of a's
/// vertices near the top must be smaller than that.
template <class ShapeT>
bool is_face_b_proved(const PolytopePair<ShapeT>& pair,
                      const RememberedAxis<SpaceOf<ShapeT>>& remembered) {
  const auto& axis = remembered.axis;
  const auto angle = excluded_beyond(pair, axis, remembered.clearance);
  return std::isfinite(angle) && is_alone(pair.b, axis.b, 2 * angle) &&
         !has_face_near_top(pair.a, axis.a, axis.normal, angle);
}

/// The angle [rad] from an axis of two vertices, or of a vertex and an edge, beyond which every axis of a face or
/// of two edges separates by less than this axis, by more than the full search leaves in doubt. C lies beyond the
/// plane n . c = gap, so an axis at the angle theta from n separates by at most gap cos theta. The smaller
/// the gap, the larger the angle. It is at least `aligned`, the smallest angle that the search tells
/// apart, and infinite if there is no such angle below 0.1.
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar distinct_angle(const PolytopePair<ShapeT>& pair,
                                                const Axis<SpaceOf<ShapeT>>& axis) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  // cos theta < 1 - 0.499 theta^2 for theta < 0.1
  const T angle2 = T(9) * pair.rounding() / axis.gap;
  if (!(axis.gap > T(0) && angle2 < T(0.01))) return std::numeric_limits<T>::infinity();
  return std::max(DetectionTolerance<T>::aligned, std::sqrt(angle2));
}
template <class ShapeT>
std::optional<Axis<SpaceOf<ShapeT>>> prove_vertices(const PolytopePair<ShapeT>& pair,
                                                    std::uint32_t a, std::uint32_t b) {
  using S = SpaceOf<ShapeT>;
  const auto axis = axis_of_nearest(pair, AxisKind::vertices, a, b);
  const auto angle = distinct_angle(pair, axis);
  if (!std::isfinite(angle) || !vertex_is_top(pair.a, a, axis.normal, angle) ||
      !vertex_is_top(pair.b, b, typename S::Vector(-axis.normal), angle))
    return std::nullopt;
  return axis;
}
/// Proves an axis of an edge of one polyhedron and a vertex of the other polyhedron.
template <std::floating_point T>
std::optional<Axis<Space<3, T>>> prove_edge_and_vertex(const PolytopePair<Polyhedron<T>>& pair,
                                                       AxisKind kind, std::uint32_t a,
                                                       std::uint32_t b) {
  using Vector = typename Space<3, T>::Vector;
  constexpr T aligned = DetectionTolerance<T>::aligned;
  const bool edge_is_of_a = kind == AxisKind::edge_vertex;
  const T fraction = edge_is_of_a
                         ? fraction_along(pair.a, a, Vector(pair.b.vertices()[b] + pair.offset))
                         : fraction_along(pair.b, b, Vector(pair.a.vertices()[a] - pair.offset));
  if (!(fraction > aligned && fraction < 1 - aligned)) return std::nullopt;
  const auto axis = axis_of_nearest(pair, kind, a, b);
  const T angle = distinct_angle(pair, axis);
  if (!std::isfinite(angle)) return std::nullopt;
  const Vector& n = axis.normal;
  const bool is_top = edge_is_of_a
                          ? edge_is_top(pair.a, a, n, angle) && vertex_is_top(pair.b, b, -n, angle)
                          : vertex_is_top(pair.a, a, n, angle) && edge_is_top(pair.b, b, -n, angle);
  return is_top ? std::optional(axis) : std::nullopt;
}

/// How far the crossing of two edges, seen along the normal, lies inside the parallelogram of all
/// differences between points of the two edges [m]. Negative if it lies outside, or if the edges are
/// nearly parallel.
template <std::floating_point T>
T depth_of_crossing(const EdgeView<T>& a, const EdgeView<T>& b,
                    const PolytopePair<Polyhedron<T>>& pair,
                    const typename Space<3, T>::Vector& normal) {
  using Vector = typename Space<3, T>::Vector;
  const Vector apart = b.from + pair.offset - a.from;
  const Vector across_a = normal.cross(a.direction);
  const Vector across_b = normal.cross(b.direction);
  const T turn = a.direction.dot(across_b), area = std::abs(turn);
  const T length2_a = a.direction.squaredNorm(), length2_b = b.direction.squaredNorm();
  if (!(area * area > T(1e-4) * length2_a * length2_b)) return T(-1);
  const T sign = std::copysign(T(1), turn);
  const auto inside = [&](T along) { return std::min(along, area - along); };
  const T from_a = inside(sign * apart.dot(across_b)), from_b = inside(sign * apart.dot(across_a));
  if (!(from_a >= T(0) && from_b >= T(0))) return T(-1);
  return std::min(from_a / std::sqrt(length2_b), from_b / std::sqrt(length2_a));
}
/// The axis of two edges. Nothing if their arcs in the Gauss map do not cross, or if their crossing lies outside.
template <std::floating_point T>
std::optional<RememberedAxis<Space<3, T>>> remember_edges(const PolytopePair<Polyhedron<T>>& pair,
                                                          std::uint32_t id_a, std::uint32_t id_b) {
  const EdgeView<T> a(pair.a, id_a), b(pair.b, id_b);
  const auto axis = axis_of_edges(a, b, pair.offset);
  if (!axis) return std::nullopt;
  const T inside = depth_of_crossing(a, b, pair, axis->normal);
  if (!(inside >= T(0))) return std::nullopt;
  return RememberedAxis<Space<3, T>>{*axis, inside};
}
/// Whether each of the two edges of an axis is the top of its shape (edge_is_top).
template <std::floating_point T>
bool edges_are_top(const PolytopePair<Polyhedron<T>>& pair, const Axis<Space<3, T>>& axis,
                   T angle) {
  using Vector = typename Space<3, T>::Vector;
  return edge_is_top(pair.a, axis.a, axis.normal, angle) &&
         edge_is_top(pair.b, axis.b, Vector(-axis.normal), angle);
}
/// Whether an axis of two edges is proved. No face and no other edge may be nearly perpendicular to the axis,
/// so the two ends of each edge must be the only vertices near the top.
template <std::floating_point T>
bool are_edges_proved(const PolytopePair<Polyhedron<T>>& pair,
                      const RememberedAxis<Space<3, T>>& remembered) {
  const T angle = excluded_beyond(pair, remembered.axis, remembered.clearance);
  return std::isfinite(angle) && edges_are_top(pair, remembered.axis, angle);
}

/// Whether a shape has a feature of this kind with this index.
template <std::floating_point T>
bool has_feature(const Placed<Polygon<T>>& shape, FeatureKind, std::uint32_t id) {
  return id < shape.vertices().size();
}
template <std::floating_point T>
bool has_feature(const Placed<Polyhedron<T>>& shape, FeatureKind kind, std::uint32_t id) {
  return id < (kind == FeatureKind::face   ? shape.normals().size()
               : kind == FeatureKind::edge ? shape.shape().edge_count()
                                           : shape.vertices().size());
}

/// The axis of two vertices, or of a vertex and an edge, of polyhedra, if it is proved.
template <std::floating_point T>
std::optional<Axis<Space<3, T>>> prove_nearest(const PolytopePair<Polyhedron<T>>& pair,
                                               const PairCache<Space<3, T>>& features) {
  switch (features.kind) {
    case AxisKind::vertices:
      return prove_vertices(pair, features.a, features.b);
    case AxisKind::vertex_edge:
    case AxisKind::edge_vertex:
      return prove_edge_and_vertex(pair, features.kind, features.a, features.b);
    default:
      return std::nullopt;
  }
}
/// For polygons: edges count as faces, so only two vertices are left.
template <std::floating_point T>
std::optional<Axis<Space<2, T>>> prove_nearest(const PolytopePair<Polygon<T>>& pair,
                                               const PairCache<Space<2, T>>& features) {
  if (features.kind != AxisKind::vertices) return std::nullopt;
  return prove_vertices(pair, features.a, features.b);
}

/// The axis of a face or of two edges that is remembered, for the present poses; nothing if the features are of
/// another kind or not of these shapes.
/// @param features  kind and indices of any features; features of another pair are allowed
template <class ShapeT>
std::optional<RememberedAxis<SpaceOf<ShapeT>>> remember_axis(
    const PolytopePair<ShapeT>& pair, const PairCache<SpaceOf<ShapeT>>& features) {
  if (!has_feature(pair.a, feature_of_a(features.kind), features.a) ||
      !has_feature(pair.b, feature_of_b(features.kind), features.b))
    return std::nullopt;
  if (features.kind == AxisKind::face_a) return remember_face_a(pair, features.a, features.b);
  if (features.kind == AxisKind::face_b) return remember_face_b(pair, features.a, features.b);
  if constexpr (SpaceOf<ShapeT>::dim == 3)
    if (features.kind == AxisKind::edges) return remember_edges(pair, features.a, features.b);
  return std::nullopt;
}
/// Whether it is proved that find_axis would find the features of an axis.
template <class ShapeT>
bool is_proved(const PolytopePair<ShapeT>& pair,
               const RememberedAxis<SpaceOf<ShapeT>>& remembered) {
  if (remembered.axis.kind == AxisKind::face_a) return is_face_a_proved(pair, remembered);
  if (remembered.axis.kind == AxisKind::face_b) return is_face_b_proved(pair, remembered);
  if constexpr (SpaceOf<ShapeT>::dim == 3) return are_edges_proved(pair, remembered);
  return false;
}

/// The axis of remembered features, if it is proved that find_axis would find the same features.
/// The result then equals the result of find_axis bit by bit.
/// @param features  kind and indices of any features; features of another pair are allowed
template <class ShapeT>
std::optional<Axis<SpaceOf<ShapeT>>> prove_axis(const PolytopePair<ShapeT>& pair,
                                                const PairCache<SpaceOf<ShapeT>>& features) {
  if (const auto remembered = remember_axis(pair, features))
    return is_proved(pair, *remembered) ? std::optional(remembered->axis) : std::nullopt;
  if (!has_feature(pair.a, feature_of_a(features.kind), features.a) ||
      !has_feature(pair.b, feature_of_b(features.kind), features.b))
    return std::nullopt;
  return prove_nearest(pair, features);
}

}  // namespace moreau::detail
