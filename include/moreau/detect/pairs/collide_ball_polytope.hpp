// SPDX-License-Identifier: MIT
// Ball against polyhedron, disk against polygon. The signed distance is that of the ball's centre
// from the polytope, minus the radius.
//
// Take the face above whose plane the centre is highest. The signed distance of the centre is its
// height above this plane in two cases: the centre is inside the polytope, or it is outside and
// projects onto this face. Otherwise the nearest feature is a vertex or an edge. For a polygon it
// is found by comparing all vertices, for a polyhedron by GJK.
#pragma once

#include <limits>

#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/projection.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

namespace detail {

/// The signed distance of a point from the surface of a polytope, < 0 inside.
template <class S>
struct PointDistance {
  typename S::Scalar distance;  ///< [m]
  typename S::Vector outward;   ///< unit normal at the nearest point of the surface, out of the
                                ///< polytope, world axes
  FeatureKey feature;  ///< feature key with the point as vertex 0 of a and the polytope as b
};

/// The face above whose plane a point is highest, and the height of the point above this plane [m].
/// @param x  the point, relative to the shape's centre, world axes [m]
template <class ShapeT>
Extreme<typename SpaceOf<ShapeT>::Scalar> highest_face(const Placed<ShapeT>& shape,
                                                       const typename SpaceOf<ShapeT>::Vector& x) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  using Lanes = Wide<T>;
  const auto point = PointRows<SpaceOf<ShapeT>>::broadcast(x);
  WideMaximum<T> best{Lanes::broadcast(-std::numeric_limits<T>::infinity()), Lanes::iota()};
  auto index = Lanes::iota();
  for (Eigen::Index i = 0; i < shape.normals().padded_size(); i += Lanes::lanes) {
    best.take(shape.normals().dot(i, point) - Lanes::load(shape.offsets() + i), index);
    index += Lanes::lanes;
  }
  return best.reduce();
}

/// The distance of a point outside of a polygon: from the edge `highest` if the point projects onto
/// it, otherwise from the nearest vertex.
template <std::floating_point T>
PointDistance<Space<2, T>> nearest_outside(const Placed<Polygon<T>>& shape,
                                           const Extreme<T>& highest,
                                           const typename Space<2, T>::Vector& x, T) {
  using Vector = typename Space<2, T>::Vector;
  using Kind = FeatureKey::Kind;
  const std::size_t edge = highest.index, count = shape.vertices().size();
  if (projects_onto(shape, edge, x))
    return {highest.value, shape.normals()[edge], FeatureKey(Kind::vertex_edge, 0, edge)};
  std::size_t nearest = 0;
  for (std::size_t v = 1; v < count; ++v)
    if ((x - shape.vertices()[v]).squaredNorm() < (x - shape.vertices()[nearest]).squaredNorm())
      nearest = v;
  const Vector apart = x - shape.vertices()[nearest];
  const T distance = apart.norm();
  return {distance, distance > T(0) ? Vector(apart / distance) : shape.normals()[edge],
          FeatureKey(Kind::vertex_vertex, 0, nearest)};
}

/// The distance of a point outside of a polyhedron: from the face `highest` if the point projects
/// onto it, otherwise by GJK.
/// @param size  order of magnitude of the size of the pair [m]
template <std::floating_point T>
PointDistance<Space<3, T>> nearest_outside(const Placed<Polyhedron<T>>& shape,
                                           const Extreme<T>& highest,
                                           const typename Space<3, T>::Vector& x, T size) {
  using Vector = typename Space<3, T>::Vector;
  using Kind = FeatureKey::Kind;
  const PointDistance<Space<3, T>> above_face{highest.value, shape.normals()[highest.index],
                                              FeatureKey(Kind::vertex_face, 0, highest.index)};
  if (projects_onto(shape, highest.index, x)) return above_face;
  const auto support = [&](const Vector& n) -> DifferencePoint<Vector> {
    const std::uint32_t i = shape.vertices().farthest(n).index;
    return {x - shape.vertices()[i], i, 0};
  };
  Vector axis = above_face.outward;
  Simplex<T> simplex(support(axis), size);
  const Proximity proximity =
      gjk<T>(support, simplex, axis, std::numeric_limits<T>::infinity(), size, all_steps);
  // The point projects onto the rim of a face, or rounding decides whether it touches the
  // polyhedron.
  if (proximity == Proximity::touching || simplex.size() == 3) return above_face;
  FeatureKey feature(Kind::vertex_vertex, 0, simplex[0].a);
  if (simplex.size() == 2)
    for (const std::uint32_t e : shape.shape().vertex_edges(simplex[0].a)) {
      const auto& ends = shape.shape().edges()[e].vertex;
      if (ends[0] == simplex[1].a || ends[1] == simplex[1].a)
        feature = FeatureKey(Kind::vertex_edge, 0, e);
    }
  return {simplex.nearest().norm(), simplex.direction().normalized(), feature};
}

/// The signed distance of a point from a polytope.
/// @param x     the point, relative to the polytope's centre, world axes [m]
/// @param size  order of magnitude of the size of the pair [m]
template <class ShapeT>
PointDistance<SpaceOf<ShapeT>> point_distance(const Placed<ShapeT>& shape,
                                              const typename SpaceOf<ShapeT>::Vector& x,
                                              typename SpaceOf<ShapeT>::Scalar size) {
  const auto highest = highest_face(shape, x);
  if (highest.value > 0) return nearest_outside(shape, highest, x, size);
  return {highest.value, shape.normals()[highest.index],
          FeatureKey(vertex_on_face(SpaceOf<ShapeT>{}), 0, highest.index)};
}

}  // namespace detail

/// Signed distance of a ball from a polytope: the signed distance of its centre minus its radius.
template <class ShapeT>
requires Polytope<ShapeT> SignedDistance<SpaceOf<ShapeT>> distance(
    const Placed<BallIn<SpaceOf<ShapeT>>>& a, const Placed<ShapeT>& b) {
  const auto found = detail::point_distance(b, a.center() - b.center(), a.radius() + b.radius());
  return {found.distance - a.radius(), -found.outward, a.center() - a.radius() * found.outward,
          a.center() - found.distance * found.outward};
}

/// Contact of a ball and a polytope at one point.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Polytope<ShapeT>
bool collide(const Placed<BallIn<SpaceOf<ShapeT>>>& a, const Placed<ShapeT>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  MOREAU_ASSERT(margin >= 0);
  const auto offset = (a.center() - b.center()).eval();
  const auto reach = a.radius() + b.radius() + margin;
  if (offset.squaredNorm() > reach * reach) return false;
  const auto found = detail::point_distance(b, offset, a.radius() + b.radius());
  const auto gap = found.distance - a.radius();
  if (!(gap <= margin)) return false;
  out.set_single_point(-found.outward, gap, a.center() - (a.radius() + gap / 2) * found.outward,
                       found.feature);
  return true;
}

}  // namespace moreau
