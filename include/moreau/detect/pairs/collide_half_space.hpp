// SPDX-License-Identifier: MIT
// Any shape against a half-space, the solid behind a plane wall. The half-space counts as a face.
// The contact normal points into the half-space.
//
// The contact points are:
//   - of a polytope or a segment, all vertices with a gap of at most the margin;
//   - of another shape, its deepest point;
//   - of a shape of which only the support function is known, its deepest point and, if the surface
//     is flat there, corners of the flat part.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau {

namespace detail {

/// The class of a contact with a half-space, given the number of vertices that touch. In the plane
/// the touching feature is a vertex or an edge; in space it is a vertex, an edge or a face.
template <std::floating_point T>
ContactClass class_at_plane(Space<2, T>, std::size_t vertices) {
  return vertices == 1 ? ContactClass::vertex_edge : ContactClass::edge_edge;
}
template <std::floating_point T>
ContactClass class_at_plane(Space<3, T>, std::size_t vertices) {
  return vertices == 1   ? ContactClass::vertex_face
         : vertices == 2 ? ContactClass::edge_face
                         : ContactClass::face_face;
}

}  // namespace detail

/// Signed distance of a convex shape from a half-space: the signed distance of its deepest point.
template <class ShapeT>
requires Elementary<ShapeT> SignedDistance<SpaceOf<ShapeT>> distance(
    const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const Vector normal = -b.normal();
  const Vector deepest = a.support(normal);
  const auto gap = b.normal().dot((a.center() - b.center()) + deepest);
  const Vector witness = a.center() + deepest;
  return {gap, normal, witness, witness + gap * normal};
}

/// One contact point: the deepest point of the shape.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Elementary<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  MOREAU_ASSERT(margin >= 0);
  return detail::touch_at_one_point(distance(a, b), margin,
                                    FeatureKey(detail::vertex_on_face(S{}), 0, 0), out);
}

/// Contact points of a polytope: every vertex with a gap of at most the margin. Arguments and
/// result are those of the first collide() of this file.
template <class ShapeT>
requires Elementary<ShapeT> && Polytope<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  MOREAU_ASSERT(margin >= 0);
  const Vector normal = -b.normal();
  const T height = b.normal().dot(a.center() - b.center());
  const T gap = height - a.vertices().farthest(normal).value;
  if (!(gap <= margin)) return false;
  out.start(normal, gap);
  const T rounding = a.radius() * DetectionTolerance<T>::rounding;
  a.vertices().for_each_above(normal, height - margin - rounding, [&](std::uint32_t v) {
    const Vector x = a.vertices()[v];
    const T gap_v = height + b.normal().dot(x);
    out.points.push_back({a.center() + along(x, T(0.5) * gap_v, normal), gap_v,
                          FeatureKey(detail::vertex_on_face(S{}), v, 0)});
  });
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

/// Contact points of a segment: each end with a gap of at most the margin. Arguments and result are
/// those of the first collide() of this file.
template <class S>
bool collide(const Placed<Segment<S>>& a, const Placed<HalfSpace<S>>& b, typename S::Scalar margin,
             Manifold<S>& out, PairCache<S>&) {
  MOREAU_ASSERT(margin >= 0);
  const SignedDistance<S> found = distance(a, b);
  if (!detail::start_if_touching(found, margin, out)) return false;
  for (std::size_t v = 0; v < 2; ++v) {
    const typename S::Vector x = a.vertex(v);
    const auto gap = b.normal().dot((a.center() - b.center()) + x);
    if (gap <= margin)
      out.points.push_back({a.center() + along(x, gap / 2, found.normal), gap,
                            FeatureKey(detail::vertex_on_face(S{}), v, 0)});
  }
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

namespace detail {

/// Calls use(tangent) for unit vectors perpendicular to the contact normal: two in the plane, six
/// in space.
/// @param frame  the contact frame
template <std::floating_point T, class Use>
void for_each_tangent(Space<2, T>, const typename Space<2, T>::Matrix& frame, Use&& use) {
  use(frame.col(1));
  use(-frame.col(1));
}
template <std::floating_point T, class Use>
void for_each_tangent(Space<3, T>, const typename Space<3, T>::Matrix& frame, Use&& use) {
  for (int k = 0; k < 6; ++k) {
    const T angle = std::numbers::pi_v<T> / 3 * static_cast<T>(k);
    use(std::cos(angle) * frame.col(1) + std::sin(angle) * frame.col(2));
  }
}

/// Corners of the flat part of a surface near its support point in the direction of a normal: the
/// support points in directions tilted from this normal, relative to the shape's centre, world axes
/// [m].
template <class S>
struct FlatSpot {
  std::array<typename S::Vector, 6> corners;
  std::size_t size = 0;  ///< number of corners; 0 if the surface is not flat
};
/// Where the surface is flat in one direction and curved in another, as on the side of a cylinder, the tilt moves the
/// support point by tilt x radius of curvature in the curved one; a wheel would roll over an edge of this width. The
/// corners are those for a tilt of 0, from one, two and three times the tilt: a polynomial of degree 2.
/// @param deepest  the support point along the normal, relative to the shape's centre, world axes
///                 [m]
/// @param size     diagonal of the shape's bounding box [m]
template <class ShapeT>
FlatSpot<SpaceOf<ShapeT>> flat_spot(const Placed<ShapeT>& shape,
                                    const typename SpaceOf<ShapeT>::Vector& normal,
                                    const typename SpaceOf<ShapeT>::Vector& deepest,
                                    typename SpaceOf<ShapeT>::Scalar size) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr T tilt = DetectionTolerance<T>::tilt;
  const T far = T(10) * tilt * size;
  FlatSpot<S> spot;
  bool is_flat = false;
  const auto frame = S::contact_frame(normal);
  for_each_tangent(S{}, frame, [&](const Vector& tangent) {
    Vector& corner = spot.corners[spot.size++];
    corner = shape.support(normal + tilt * tangent);
    is_flat = is_flat || (corner - deepest).squaredNorm() > far * far;
  });
  spot.size = 0;
  if (!is_flat) return spot;
  for_each_tangent(S{}, frame, [&](const Vector& tangent) {
    Vector& corner = spot.corners[spot.size++];
    const Vector second = shape.support(normal + 2 * tilt * tangent),
                 third = shape.support(normal + 3 * tilt * tangent);
    const T change = std::max((second - corner).squaredNorm(), (third - second).squaredNorm());
    if (change < far * far) corner = 3 * (corner - second) + third;
  });
  return spot;
}

}  // namespace detail

/// Contact points of a shape of which only the support function is known: the deepest point (vertex
/// 0 in the feature key) and, if the surface is flat there, corners of the flat part (vertices 1 to
/// 6). So a shape with a flat side can stand on this side. Arguments and result are those of
/// the first collide() of this file.
template <class ShapeT>
requires SupportOnly<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  MOREAU_ASSERT(margin >= 0);
  const SignedDistance<S> found = distance(a, b);
  if (!detail::start_if_touching(found, margin, out)) return false;
  const Aabb<S> box = a.bounding_box();
  const auto size = (box.upper - box.lower).norm();
  const auto near = size * DetectionTolerance<typename S::Scalar>::coincident;
  const auto add = [&](const typename S::Vector& x, std::size_t id) {
    const auto gap = b.normal().dot((a.center() - b.center()) + x);
    const typename S::Vector position = a.center() + along(x, gap / 2, found.normal);
    bool is_new = gap <= margin;
    for (const auto& point : out.points)
      is_new = is_new && (point.position - position).squaredNorm() > near * near;
    if (is_new)
      out.points.push_back({position, gap, FeatureKey(detail::vertex_on_face(S{}), id, 0)});
  };
  const typename S::Vector deepest = a.support(found.normal);
  const auto spot = detail::flat_spot(a, found.normal, deepest, size);
  for (std::size_t k = 0; k < spot.size; ++k) add(spot.corners[k], k + 1);
  add(deepest, 0);
  out.sort();
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

}  // namespace moreau
