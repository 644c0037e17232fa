// SPDX-License-Identifier: MIT
// Anything against a wall. The wall counts as a face; the normal points into it.
#pragma once

#include "moreau/detect/contact_class.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau {

namespace detail {

/// What touches a plane with that many vertices: in the plane, a point or an edge; in space, a
/// vertex, an edge or a face.
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

/// Of any convex shape: its farthest point into the wall.
template <class ShapeT>
SignedDistance<SpaceOf<ShapeT>> distance(const Placed<ShapeT>& a,
                                         const Placed<HalfSpace<SpaceOf<ShapeT>>>& b) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const Vector normal = -b.normal();
  const Vector deepest = a.support(normal);
  const auto gap = b.normal().dot((a.center() - b.center()) + deepest);
  const Vector witness = a.center() + deepest;
  return {gap, normal, witness, witness + gap * normal};
}

/// One point, the deepest.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  MOREAU_ASSERT(margin >= 0);
  const SignedDistance<S> found = distance(a, b);
  if (!(found.gap <= margin)) return false;
  out.clear();
  out.normal = found.normal;
  out.gap = found.gap;
  out.contact_class = detail::class_at_plane(S{}, 1);
  out.points.push_back({(found.witness_a + found.witness_b) / 2, found.gap,
                        FeatureKey(detail::vertex_on_face(S{}), 0, 0)});
  return true;
}

/// Every vertex within the margin is a point.
template <class ShapeT>
requires Polytope<ShapeT>
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
  out.clear();
  out.normal = normal;
  out.gap = gap;
  const T rounding = a.radius() * DetectionTolerance<T>::rounding;
  a.vertices().for_each_above(normal, height - margin - rounding, [&](std::uint32_t v) {
    const Vector x = a.vertices()[v];
    const T gap_v = height + b.normal().dot(x);
    out.points.push_back({a.center() + (x + T(0.5) * gap_v * normal), gap_v,
                          FeatureKey(detail::vertex_on_face(S{}), v, 0)});
  });
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

}  // namespace moreau
