// SPDX-License-Identifier: MIT
// Any shape against the inside of a cylinder (of a circle in the plane). The wall counts as a face;
// the normal of a contact points into the wall, away from the cylinder's axis.
//
// The distance from the axis is a convex function of the point. Within a polytope it is therefore
// largest at a vertex, and the vertices are the contact points, each with a normal of its own. A
// ball is a vertex with a radius, a capsule two of them. For a shape known by its support function
// alone, two points are found by climbing outwards from either side of the shape. They coincide if
// the shape touches at one point; they are the two ends if an edge or a face lies across the axis.
// Of a line or a face of contact that is parallel to the axis, one point is found.
#pragma once

#include <cstdint>
#include <limits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/shape/cylinder_wall.hpp"

namespace moreau {

namespace detail {

/// What is kept of the wall of a cylinder. The solid is { x : |radial(x - center)| >= radius }.
template <class S>
class Placement<CylinderWall<S>> {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;

  /// Places the wall at a pose, world axes [m].
  void update(const CylinderWall<S>& shape, const Pose<S>& pose) {
    center_ = pose.position;
    axis_ = product(S::adjoint(pose.rotation), shape.axis());
    radius_ = shape.radius();
  }
  const Vector& center() const { return center_; }  ///< a point of the axis, world axes [m]
  const Angular& axis() const { return axis_; }     ///< unit, world axes
  Scalar radius() const { return radius_; }         ///< [m]
  /// The part of a vector, world axes, that is perpendicular to the axis: -axis x (axis x r).
  Vector radial(const Vector& r) const { return -S::spin(axis_, S::spin(axis_, r)); }
  /// Whether a box, world axes [m], may come within the margin [m] of the wall.
  bool reaches(const Aabb<S>& box, Scalar margin) const {
    const Vector middle = (box.lower + box.upper) / 2 - center_;
    return radial(middle).norm() + (box.upper - box.lower).norm() / 2 >= radius_ - margin;
  }

 private:
  Vector center_ = Vector::Zero();
  Angular axis_ = Angular::Zero();
  Scalar radius_ = 0;
};

/// Any unit vector perpendicular to the axis.
template <class S>
typename S::Vector any_radial(const Placed<CylinderWall<S>>& wall) {
  using Vector = typename S::Vector;
  Vector longest = Vector::Zero();
  for (int axis = 0; axis < S::dim; ++axis) {
    const Vector r = wall.radial(Vector::Unit(axis));
    if (r.squaredNorm() > longest.squaredNorm()) longest = r;
  }
  return longest.normalized();
}

/// The point of a shape that is farthest from the cylinder's axis, by climbing: from the farthest
/// point in a direction, again and again to the farthest point in the radial direction. By
/// convexity each step leads farther from the axis or is the last one.
template <class ShapeT>
typename SpaceOf<ShapeT>::Vector climb(const Placed<ShapeT>& a,
                                       const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                                       const typename SpaceOf<ShapeT>::Vector& direction) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  using Vector = typename SpaceOf<ShapeT>::Vector;
  constexpr int steps = 100;
  const Vector offset = a.center() - b.center();
  Vector best = a.support(direction);
  for (int k = 0; k < steps; ++k) {
    const Vector outward = b.radial(offset + best);
    if (outward.isZero(0)) break;
    const Vector next = a.support(outward);
    const T gain = b.radial(offset + next).norm() - outward.norm();
    if (!(gain > 4 * std::numeric_limits<T>::epsilon() * b.radius())) break;
    best = next;
  }
  return best;
}

/// Calls use(k, x, r) for the places k where a shape may touch the wall: the ball of radius r [m]
/// about x, relative to the centre, world axes [m], touches the wall there if and only if the shape
/// does.
template <class ShapeT, class Use>
void for_each_outermost(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                        Use&& use) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr T near = T(1e-3);  // of the shape's box: nearer points are one
  Vector outward = b.radial(a.center() - b.center());
  outward = outward.isZero(0) ? any_radial(b) : Vector(outward.normalized());
  const Vector across = S::spin(b.axis(), outward);
  const Vector left = climb(a, b, Vector(outward + across));
  const Vector right = climb(a, b, Vector(outward - across));
  const Aabb<S> box = a.bounding_box();
  use(0u, left, T(0));
  if ((left - right).norm() > near * (box.upper - box.lower).norm()) use(1u, right, T(0));
}
template <class ShapeT, class Use>
requires Polytope<ShapeT>
void for_each_outermost(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>&,
                        Use&& use) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  const auto count = static_cast<std::uint32_t>(a.vertices().size());
  for (std::uint32_t v = 0; v < count; ++v) use(v, a.vertices()[v], T(0));
}
template <class S, class Use>
void for_each_outermost(const Placed<BallIn<S>>& a, const Placed<CylinderWall<S>>&, Use&& use) {
  use(0u, S::Vector::Zero().eval(), a.radius());
}
template <class S, class Use>
void for_each_outermost(const Placed<Segment<S>>& a, const Placed<CylinderWall<S>>&, Use&& use) {
  for (std::uint32_t v = 0; v < 2; ++v) use(v, a.vertex(v), typename S::Scalar(0));
}
template <class Core, class Use>
void for_each_outermost(const Placed<Rounded<Core>>& a,
                        const Placed<CylinderWall<SpaceOf<Core>>>& b, Use&& use) {
  using Vector = typename SpaceOf<Core>::Vector;
  const Vector shift = a.core().center() - a.center();
  for_each_outermost(a.core(), b, [&](std::uint32_t k, const Vector& x, auto radius) {
    use(k, Vector(x + shift), radius + a.rounding_radius());
  });
}
template <class... Shapes, class Use>
void for_each_outermost(const Placed<OneOf<Shapes...>>& a,
                        const Placed<CylinderWall<SpaceOf<OneOf<Shapes...>>>>& b, Use&& use) {
  a.visit([&](const auto& kind) { for_each_outermost(kind, b, use); });
}

}  // namespace detail

/// Contact points with normals of their own, each in a manifold of one point. The head of this file
/// says which points these are.
/// @param margin points up to this gap are in contact [m], >= 0
/// @param out    filled anew for each point
/// @param use    called without arguments after each filling, in the order of the feature keys
/// @returns whether there was a point
template <class ShapeT, class Use>
bool collide_each(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                  typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
                  Use&& use) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  MOREAU_ASSERT(margin >= 0);
  bool touch = false;
  detail::for_each_outermost(a, b, [&](std::uint32_t k, const Vector& x, T radius) {
    const Vector arm = b.radial((a.center() - b.center()) + x);
    const T distance = arm.norm();
    const T gap = b.radius() - radius - distance;
    if (!(gap <= margin)) return;
    const Vector normal = distance > 0 ? Vector(arm / distance) : detail::any_radial(b);
    out.set_single_point(normal, gap, a.center() + (x + (radius + gap / 2) * normal),
                         FeatureKey(detail::vertex_on_face(S{}), k, 0));
    use();
    touch = true;
  });
  return touch;
}

}  // namespace moreau
