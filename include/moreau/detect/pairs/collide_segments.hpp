// SPDX-License-Identifier: MIT
// Segment against segment and ball against segment. Segments are the cores of capsules.
#pragma once

#include <cmath>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/pairs/collide_balls.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/segment_axis.hpp"

namespace moreau {

/// Signed distance of a ball from a segment. If the centre of the ball lies on the segment, the
/// normal is any unit vector perpendicular to the segment.
template <class S>
SignedDistance<S> distance(const Placed<BallIn<S>>& a, const Placed<Segment<S>>& b) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector offset = a.center() - b.center();
  const T t = std::clamp(offset.dot(b.half()) / b.half().squaredNorm(), T(-1), T(1));
  const Vector apart = t * b.half() - offset;
  const T between = detail::stable_length(apart);
  const Vector normal = between > T(0) ? Vector(apart / between)
                                       : Vector(S::contact_frame(b.half().normalized()).col(1));
  const Vector witness = a.center() + a.radius() * normal;
  return {between - a.radius(), normal, witness, witness + (between - a.radius()) * normal};
}

/// Contact of a ball and a segment at one point.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
/// @returns whether the signed gap is at most the margin
template <class S>
bool collide(const Placed<BallIn<S>>& a, const Placed<Segment<S>>& b, typename S::Scalar margin,
             Manifold<S>& out, PairCache<S>&) {
  using Kind = FeatureKey::Kind;
  MOREAU_ASSERT(margin >= 0);
  const auto along = (a.center() - b.center()).dot(b.half()), end = b.half().squaredNorm();
  const FeatureKey feature = std::abs(along) < end
                                 ? FeatureKey(Kind::vertex_edge, 0, 0)
                                 : FeatureKey(Kind::vertex_vertex, 0, along < 0 ? 0 : 1);
  return detail::touch_at_one_point(distance(a, b), margin, feature, out);
}

/// Signed distance of two segments. If they intersect, the gap is < 0 in the plane and 0 in space.
template <class S>
SignedDistance<S> distance(const Placed<Segment<S>>& a, const Placed<Segment<S>>& b) {
  using Vector = typename S::Vector;
  const detail::SegmentPair<S> pair(a, b);
  const detail::SegmentAxis<S> axis = detail::segment_axis(pair);
  const Vector witness = a.center() + axis.s * pair.half_a;
  return {axis.gap, axis.normal, witness, witness + axis.gap * axis.normal};
}

namespace detail {

/// Adds as contact points the ends of each segment that project onto the other segment and whose
/// gap is at most the margin. The gap of each end is its own distance from the other segment.
template <class S>
void add_ends(const SegmentPair<S>& pair, const SegmentAxis<S>& axis,
              const typename S::Vector& center, typename S::Scalar margin, Manifold<S>& out) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const T near = pair.size * DetectionTolerance<T>::coincident;
  const auto add = [&](T s, T t, FeatureKey key) {
    if (std::abs(s) > T(1) + near / pair.half_a.norm()) return;
    if (std::abs(t) > T(1) + near / pair.half_b.norm()) return;
    const Vector apart = pair.apart(s, t);
    const T height = axis.normal.dot(apart), gap = height < T(0) ? height : apart.norm();
    if (!(gap <= margin + pair.size * DetectionTolerance<T>::rounding)) return;
    const Vector position = center + (s * pair.half_a + apart / 2);
    for (const auto& point : out.points)
      if ((point.position - position).squaredNorm() <= near * near) return;
    out.points.push_back({position, gap, key});
  };
  for (const std::size_t v : {0U, 1U}) {
    const T end = v == 0 ? T(-1) : T(1);
    add(end, pair.project_on_b(end), FeatureKey(FeatureKey::Kind::vertex_edge, v, 0));
  }
  for (const std::size_t v : {0U, 1U}) {
    const T end = v == 0 ? T(-1) : T(1);
    add(pair.project_on_a(end), end, FeatureKey(FeatureKey::Kind::edge_vertex, 0, v));
  }
}

/// Whether the point with the parameter s of a segment is one of the segment's ends.
template <std::floating_point T>
bool is_end(T s) {
  return std::abs(s) >= T(1);
}

/// The feature key of the nearest points of two segments.
template <class S>
FeatureKey feature_of(const SegmentAxis<S>& axis) {
  using Kind = FeatureKey::Kind;
  const bool end_a = is_end(axis.s), end_b = is_end(axis.t);
  const Kind kind = end_a && end_b ? Kind::vertex_vertex
                    : end_a        ? Kind::vertex_edge
                    : end_b        ? Kind::edge_vertex
                                   : Kind::edge_edge;
  return FeatureKey(kind, end_a && axis.s > 0 ? 1 : 0, end_b && axis.t > 0 ? 1 : 0);
}

}  // namespace detail

/// Contact points of two segments: the ends of each segment that project onto the other segment and
/// have a gap of at most the margin. There are two of them if one segment lies along the other. If
/// there is no such point, or if the gap of each is larger than the signed gap of the pair (by more
/// than rounding), the midpoint between the nearest points is added. Its gap is that of the pair.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
/// @returns whether the signed gap is at most the margin
template <class S>
bool collide(const Placed<Segment<S>>& a, const Placed<Segment<S>>& b, typename S::Scalar margin,
             Manifold<S>& out, PairCache<S>&) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  MOREAU_ASSERT(margin >= 0);
  const detail::SegmentPair<S> pair(a, b);
  const T reach = pair.size + margin;
  if (pair.offset.squaredNorm() > reach * reach) return false;
  const detail::SegmentAxis<S> axis = detail::segment_axis(pair);
  if (!(axis.gap <= margin)) return false;
  out.start(axis.normal, axis.gap);
  detail::add_ends(pair, axis, a.center(), margin, out);
  T deepest = std::numeric_limits<T>::infinity();
  for (const auto& point : out.points) deepest = std::min(deepest, point.gap);
  const T rounding = pair.size * DetectionTolerance<T>::rounding;
  if (!(deepest <= axis.gap + T(64) * rounding)) {
    const Vector middle = axis.s * pair.half_a + axis.gap / 2 * axis.normal;
    out.points.push_back({a.center() + middle, axis.gap, detail::feature_of(axis)});
  }
  out.sort();
  out.contact_class = out.points.size() == 1 ? detail::class_of_point(out.points[0].feature)
                                             : ContactClass::edge_edge;
  return true;
}

}  // namespace moreau
