// SPDX-License-Identifier: MIT
// A Cylinder that lies with its round side on a face of a polyhedron, or along the side of another Cylinder.
//
// The axis of such a contact is that of the core, a segment: the general algorithms for convex shapes
// (convex/collide_convex.hpp) find it and one contact point, which can lie anywhere along the line of contact. With one point the
// body that rests there tips over the line. So the contact points are those of the segment, as of a capsule
// (collide_segment_polytope.hpp, collide_segments.hpp): the two ends of the line. All other contacts of cylinders have one point.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "moreau/detect/convex/collide_convex.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/pairs/collide_segment_polytope.hpp"
#include "moreau/detect/pairs/collide_segments.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/cylinder.hpp"

namespace moreau {

namespace detail {

/// The axis of a cylinder.
template <std::floating_point T>
Segment<Space<3, T>> axis_of(const Placed<Cylinder<T>>& cylinder) {
  return Segment<Space<3, T>>(cylinder.shape().half_length());
}
/// How far a rim lies beyond the end of the axis along a normal [m].
template <std::floating_point T>
T rim_height(const Placed<Cylinder<T>>& cylinder, const typename Cylinder<T>::Vector& normal) {
  const T along = (cylinder.pose().rotation.inverse() * normal)[0];
  return cylinder.shape().radius() * std::sqrt(std::max(T(0), 1 - along * along));
}

/// The points of the line along which a cylinder touches a face, if there are two.
template <std::floating_point T>
bool touch_along_face(const Placed<Cylinder<T>>& a, const Placed<Polyhedron<T>>& b,
                      const SignedDistance<Space<3, T>>& found, T margin,
                      Manifold<Space<3, T>>& out) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  const Vector towards_a = -found.normal;
  const auto face = facing_feature(b, FeatureKind::vertex, b.vertices().farthest(towards_a).index,
                                   towards_a, margin - found.gap);
  const Vector normal = -b.normals()[face];
  if ((normal - found.normal).norm() > T(10) * DetectionTolerance<T>::aligned) return false;
  const T rim = rim_height(a, normal), size = a.radius() + b.radius();
  const T near = size * DetectionTolerance<T>::coincident;
  const Segment<S> core = axis_of(a);
  const Placed<Segment<S>> axis(core, a.pose());
  out.start(normal, found.gap);
  SegmentOnFace<T> segment(axis, b, face, normal);
  segment.clip(near);
  segment.for_each_corner(near, [&](ManifoldPoint<S> corner) {
    corner.gap -= rim;
    corner.position += rim / 2 * normal;
    if (corner.gap <= margin) out.points.push_back(corner);
  });
  if (out.points.size() < 2) return false;
  out.gap = std::min(out.points[0].gap, out.points[1].gap);
  // Beside the face an edge or a vertex may be nearer.
  if (std::abs(out.gap - found.gap) > near) return false;
  out.sort();
  out.contact_class = ContactClass::edge_face;
  return true;
}

}  // namespace detail

/// Contact points of a cylinder and a polyhedron: two if the cylinder lies along a face, otherwise one.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Cylinder<T>>& a, const Placed<Polyhedron<T>>& b, T margin,
             Manifold<Space<3, T>>& out, PairCache<Space<3, T>>& cache) {
  MOREAU_ASSERT(margin >= 0);
  const auto found =
      detail::ConvexPair<Cylinder<T>, Polyhedron<T>>(a, b).distance(margin, cache.axis);
  if (!(found.gap <= margin)) return false;
  return detail::touch_along_face(a, b, found, margin, out) ||
         detail::touch_at_one_point(found, margin,
                                    FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0), out);
}
/// The same in the other order.
template <std::floating_point T>
bool collide(const Placed<Polyhedron<T>>& a, const Placed<Cylinder<T>>& b, T margin,
             Manifold<Space<3, T>>& out, PairCache<Space<3, T>>& cache) {
  cache.axis = -cache.axis;
  const bool touch = collide(b, a, margin, out, cache);
  cache.axis = -cache.axis;
  if (touch) out.swap_sides();
  return touch;
}
/// Contact points of two cylinders: two if they lie along each other, otherwise one.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Cylinder<T>>& a, const Placed<Cylinder<T>>& b, T margin,
             Manifold<Space<3, T>>& out, PairCache<Space<3, T>>& cache) {
  using S = Space<3, T>;
  MOREAU_ASSERT(margin >= 0);
  const auto found =
      detail::ConvexPair<Cylinder<T>, Cylinder<T>>(a, b).distance(margin, cache.axis);
  if (!(found.gap <= margin)) return false;
  const T thickness = a.shape().radius() + b.shape().radius();
  const T near = (a.radius() + b.radius()) * DetectionTolerance<T>::coincident;
  const Segment<S> core_a = detail::axis_of(a), core_b = detail::axis_of(b);
  const Placed<Segment<S>> axis_a(core_a, a.pose()), axis_b(core_b, b.pose());
  PairCache<S> none;
  if (collide(axis_a, axis_b, margin + thickness, out, none) && out.points.size() == 2 &&
      std::abs(out.gap - thickness - found.gap) <= near) {
    out.gap -= thickness;
    for (auto& point : out.points) {
      point.gap -= thickness;
      point.position += (a.shape().radius() - b.shape().radius()) / 2 * out.normal;
    }
    return true;
  }
  return detail::touch_at_one_point(found, margin,
                                    FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0), out);
}

}  // namespace moreau
