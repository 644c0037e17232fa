// SPDX-License-Identifier: MIT
// Any shape against the inside of a cylinder, or in the plane of a circle. The wall counts as a
// face. The normal of a contact points into the wall, away from the axis of the cylinder.
//
// The distance of a point from the axis is a convex function of the point. So the contact points
// are:
//   - of a polytope, its vertices, because a convex function has its maximum at a vertex. Each
//     contact point has a normal of its own;
//   - of a ball, its centre, with the radius of the ball subtracted from the gap;
//   - of a capsule, the two ends of its core, with the radius subtracted in the same way;
//   - of a shape of which only the support function is known, two points, which are found by an
//     iteration from either side of the shape. The two points coincide if the shape touches the
//     wall at one point. If an edge or a face lies across the axis, they are its two ends. If an
//     edge or a face is parallel to the axis, only one of its points is found.
#pragma once

#include <cstdint>
#include <limits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/shape/cylinder_wall.hpp"

namespace moreau {

namespace detail {

/// The placed data of a cylinder wall. The solid is { x : |radial(x - center)| >= radius }.
template <class S>
class Placement<CylinderWall<S>> {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;

  /// Places the wall at a pose, world axes [m].
  void update(const CylinderWall<S>& shape, const Pose<S>& pose) {
    center_ = pose.position;
    axis_ = shape.axis_at(pose.rotation);
    radius_ = shape.radius();
  }
  const Vector& center() const { return center_; }  ///< a point of the axis, world axes [m]
  const Angular& axis() const { return axis_; }     ///< unit, world axes
  Scalar radius() const { return radius_; }         ///< [m]
  /// The component of a vector r perpendicular to the axis, world axes: -axis x (axis x r).
  Vector radial(const Vector& r) const { return -S::spin(axis_, S::spin(axis_, r)); }
  /// Whether a shape in this bounding box, world axes [m], can have a gap to the wall of at most
  /// the margin [m].
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

/// A point of a shape with a maximal distance from the axis of the cylinder, relative to the centre
/// of the shape, world axes [m]. It starts from the support point in `direction`. Each step takes
/// the support point in the radial direction of the last point. By convexity each step increases
/// the distance from the axis or is the last step.
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

/// Calls use(k, x, r) for each place at which a shape may touch the wall, k = 0, 1, ... The ball of
/// radius r [m] about x touches the wall if and only if the shape touches it at this place. x is
/// relative to the centre of the shape, world axes [m].
template <class ShapeT, class Use>
void for_each_outermost(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                        Use&& use) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr T near = T(1e-3);  // fraction of the diagonal of the bounding box; points closer
                               // together count as one point
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

/// Computes contact points that each have a normal of their own. Each contact point is passed on in
/// a manifold with one point. The list at the top of this file says which points a shape has.
/// @param margin largest gap of a contact point [m], >= 0
/// @param out    overwritten for each contact point
/// @param use    called without arguments for each contact point, when `out` contains it, in the
///               order of the feature keys
/// @returns whether there was a contact point
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
