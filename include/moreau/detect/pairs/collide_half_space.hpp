// SPDX-License-Identifier: MIT
// Anything against a wall. The wall counts as a face; the normal points into it.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/contact_class.hpp"
#include "moreau/detect/shape_kinds.hpp"
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

/// Signed distance of any convex shape from a wall: that of its farthest point into the wall.
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

/// One point, the deepest.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Elementary<ShapeT>
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

/// Every vertex within the margin is a point; arguments as above.
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

/// The ends within the margin are points; arguments as above.
template <class S>
bool collide(const Placed<Segment<S>>& a, const Placed<HalfSpace<S>>& b, typename S::Scalar margin,
             Manifold<S>& out, PairCache<S>&) {
  MOREAU_ASSERT(margin >= 0);
  const SignedDistance<S> found = distance(a, b);
  if (!(found.gap <= margin)) return false;
  out.clear();
  out.normal = found.normal;
  out.gap = found.gap;
  for (std::size_t v = 0; v < 2; ++v) {
    const typename S::Vector x = a.vertex(v);
    const auto gap = b.normal().dot((a.center() - b.center()) + x);
    if (gap <= margin)
      out.points.push_back({a.center() + (x + gap / 2 * found.normal), gap,
                            FeatureKey(detail::vertex_on_face(S{}), v, 0)});
  }
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

namespace detail {

/// Calls use(unit vector) for directions in the plane of contact: two in the plane, six in space.
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

/// The farthest points of a shape in directions around a normal, relative to its centre.
template <class ShapeT>
class FlatSpot {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  FlatSpot(const Placed<ShapeT>& shape, const Vector& normal, const Vector& deepest, T size) {
    constexpr T tilt = DetectionTolerance<T>::tilt;
    const T far = T(10) * tilt * size;
    for_each_tangent(S{}, S::contact_frame(normal), [&](const Vector& tangent) {
      corners_[count_] = shape.support(normal + tilt * tangent);
      is_flat_ = is_flat_ || (corners_[count_] - deepest).squaredNorm() > far * far;
      ++count_;
    });
  }
  /// None unless the surface is flat there.
  std::size_t size() const { return is_flat_ ? count_ : 0; }
  const Vector& operator[](std::size_t k) const { return corners_[k]; }

 private:
  std::array<Vector, 6> corners_;
  std::size_t count_ = 0;
  bool is_flat_ = false;
};

}  // namespace detail

/// A shape known by its support: the deepest point (vertex 0) and, where the surface is flat, the
/// corners of the flat spot (vertices 1 to 6), so that what is flat can stand. Arguments as above.
template <class ShapeT>
requires Elementary<ShapeT> && SupportOnly<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<HalfSpace<SpaceOf<ShapeT>>>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  MOREAU_ASSERT(margin >= 0);
  const SignedDistance<S> found = distance(a, b);
  if (!(found.gap <= margin)) return false;
  out.clear();
  out.normal = found.normal;
  out.gap = found.gap;
  const Aabb<S> box = a.bounding_box();
  const T size = (box.upper - box.lower).norm(), near = size * DetectionTolerance<T>::coincident;
  const auto add = [&](const Vector& x, std::size_t id) {
    const T gap = b.normal().dot((a.center() - b.center()) + x);
    const Vector position = a.center() + (x + gap / 2 * found.normal);
    bool is_new = gap <= margin;
    for (const auto& point : out.points)
      is_new = is_new && (point.position - position).squaredNorm() > near * near;
    if (is_new)
      out.points.push_back({position, gap, FeatureKey(detail::vertex_on_face(S{}), id, 0)});
  };
  const Vector deepest = a.support(found.normal);
  const detail::FlatSpot<ShapeT> spot(a, found.normal, deepest, size);
  for (std::size_t k = 0; k < spot.size(); ++k) add(spot[k], k + 1);
  add(deepest, 0);
  out.sort();
  out.contact_class = detail::class_at_plane(S{}, out.points.size());
  return true;
}

}  // namespace moreau
