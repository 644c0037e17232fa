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
//   - of a Cylinder, up to two points of each rim, found as the next ones;
//   - of a shape of which only the support function is known, two points, which are found by an
//     iteration from either side of the shape. The two points coincide if the shape touches the
//     wall at one point. If an edge or a face lies across the axis, they are its two ends. If an
//     edge or a face is parallel to the axis, only one of its points is found.
#pragma once

#include <cstdint>
#include <limits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/shape/cylinder.hpp"
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

/// A point of a convex set with a maximal distance from the axis of the cylinder, relative to the
/// centre of the set, world axes [m]. It starts from the support point in `direction`. Each step takes
/// the support point in the radial direction of the last point. By convexity each step increases
/// the distance from the axis or is the last step.
/// @param offset  of the centre of the set from the centre of the wall, world axes [m]
/// @param support the point of the set farthest in a direction, relative to its centre, world axes [m]
template <class S>
typename S::Vector climb(const Placed<CylinderWall<S>>& b, const typename S::Vector& offset,
                         const typename S::Vector& direction, const auto& support) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int steps = 100;
  Vector best = support(direction);
  for (int k = 0; k < steps; ++k) {
    const Vector outward = b.radial(offset + best);
    if (outward.isZero(0)) break;
    const Vector next = support(outward);
    const T gain = b.radial(offset + next).norm() - outward.norm();
    if (!(gain > 4 * std::numeric_limits<T>::epsilon() * b.radius())) break;
    best = next;
  }
  return best;
}
/// Calls use(k, x) for k = 0, and for k = 1 if there is a second one, with points of a convex set that are farthest
/// from the axis, on either side of its centre.
/// @param near points closer together count as one [m]; for the others see climb()
template <class S>
void for_each_side(const Placed<CylinderWall<S>>& b, const typename S::Vector& offset,
                   const auto& support, typename S::Scalar near, const auto& use) {
  using Vector = typename S::Vector;
  Vector outward = b.radial(offset);
  outward = outward.isZero(0) ? any_radial(b) : Vector(outward.normalized());
  const Vector across = S::spin(b.axis(), outward);
  const Vector left = climb<S>(b, offset, Vector(outward + across), support);
  const Vector right = climb<S>(b, offset, Vector(outward - across), support);
  use(0u, left);
  if ((left - right).norm() > near) use(1u, right);
}

/// Fraction of the size of a shape below which two of its points count as one.
inline constexpr double near_points = 1e-3;

/// Calls use(k, x, r) for each place at which a shape may touch the wall, k = 0, 1, ... The ball of
/// radius r [m] about x touches the wall if and only if the shape touches it at this place. x is
/// relative to the centre of the shape, world axes [m].
template <class ShapeT, class Use>
void for_each_outermost(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                        Use&& use) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Aabb<S> box = a.bounding_box();
  for_each_side<S>(
      b, a.center() - b.center(), [&](const Vector& direction) { return a.support(direction); },
      T(near_points) * (box.upper - box.lower).norm(),
      [&](std::uint32_t k, const Vector& x) { use(k, x, T(0)); });
}
template <std::floating_point T, class Use>
void for_each_outermost(const Placed<Cylinder<T>>& a, const Placed<CylinderWall<Space<3, T>>>& b,
                        Use&& use) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  const Cylinder<T>& shape = a.shape();
  const Vector axis = a.pose().rotation * Vector(Vector::UnitX());
  for (std::uint32_t rim = 0; rim < 2; ++rim) {
    const Vector middle = (rim == 0 ? -shape.half_length() : shape.half_length()) * axis;
    const auto support = [&](const Vector& direction) {
      const Vector along = direction - axis * axis.dot(direction);
      const T length = along.norm();
      return length > 0 ? Vector(shape.radius() / length * along) : Vector(Vector::Zero());
    };
    for_each_side<S>(
        b, Vector(a.center() - b.center() + middle), support, T(near_points) * shape.radius(),
        [&](std::uint32_t k, const Vector& x) { use(2 * rim + k, Vector(middle + x), T(0)); });
  }
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
