// SPDX-License-Identifier: MIT
// The signed gap and the separating axis of two segments without thickness.
//
// If the segments are apart, the gap is the distance of their nearest points. These are an end of
// one segment and a point of the other segment, or two inner points. If the segments intersect, C =
// B - A, the set of all differences b - a, contains the origin. In the plane C is a parallelogram,
// and the normal of its side nearest to the origin is the axis. In space C has no thickness, and
// along its normal the gap is 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau::detail {

/// Two segments in coordinates relative to the centre of a, world axes [m]. The points of a are s
/// half_a, those of b are offset + t half_b, with s and t in [-1, 1].
template <class S>
struct SegmentPair {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  const Vector half_a, half_b, offset;
  const T size;  ///< sum of the half lengths [m]; tolerances are relative to it

  SegmentPair(const Placed<Segment<S>>& a, const Placed<Segment<S>>& b)
      : half_a(a.half()),
        half_b(b.half()),
        offset(b.center() - a.center()),
        size(a.radius() + b.radius()) {}
  /// @param first,second  for each segment, the vector from its middle to its end, world axes [m]
  /// @param between       from the middle of the first segment to the middle of the second one [m]
  SegmentPair(const Vector& first, const Vector& second, const Vector& between)
      : half_a(first), half_b(second), offset(between), size(first.norm() + second.norm()) {}

  /// The vector from the point with parameter s of a to the point with parameter t of b [m].
  Vector apart(T s, T t) const { return offset + t * half_b - s * half_a; }
  /// project_on_a: the parameter s of the projection of b's point t onto the line of a.
  /// project_on_b: the parameter t of the projection of a's point s onto the line of b.
  T project_on_a(T t) const { return half_a.dot(along(offset, t, half_b)) / half_a.squaredNorm(); }
  T project_on_b(T s) const {
    Vector apart = s * half_a;
    apart -= offset;
    return half_b.dot(apart) / half_b.squaredNorm();
  }
};

/// The axis along which two segments have their signed gap, and the nearest or deepest points.
template <class S>
struct SegmentAxis {
  typename S::Vector normal;  ///< unit, from a to b, world axes
  typename S::Scalar gap = std::numeric_limits<typename S::Scalar>::infinity();  ///< signed gap [m]
  typename S::Scalar s = 0, t = 0;  ///< parameters of the point of a and of the point of b
};

/// Calls take(s, t) with the parameters of the points at which the lines of two segments in space
/// are nearest, if both points lie strictly inside the segments. The parameters are computed from
/// the common normal, which loses fewer digits than the determinant of the normal equations.
template <std::floating_point T, class Take>
void take_inner(const SegmentPair<Space<3, T>>& pair, const Take& take) {
  using Vector = typename Space<3, T>::Vector;
  const Vector across = pair.half_a.cross(pair.half_b);
  const T length2 = across.squaredNorm();
  constexpr T parallel = T(16) * std::numeric_limits<T>::epsilon();
  const T product = pair.half_a.squaredNorm() * pair.half_b.squaredNorm();
  if (!(length2 > parallel * parallel * product)) return;
  const T s = pair.offset.cross(pair.half_b).dot(across) / length2;
  const T t = pair.offset.cross(pair.half_a).dot(across) / length2;
  if (std::abs(s) < T(1) && std::abs(t) < T(1)) take(s, t);
}
/// In the plane two segments that are apart have an end as a nearest point, so there is nothing to
/// do.
template <std::floating_point T, class Take>
void take_inner(const SegmentPair<Space<2, T>>&, const Take&) {}

/// The nearest points of two segments. This function does not set the normal of
/// the result; its caller does.
template <class S>
SegmentAxis<S> nearest_points(const SegmentPair<S>& pair) {
  using T = typename S::Scalar;
  SegmentAxis<S> best;
  const auto take = [&](T s, T t) {
    const T distance = pair.apart(s, t).norm();
    if (distance < best.gap) best = {S::Vector::Zero(), distance, s, t};
  };
  for (const T end : {T(-1), T(1)}) {
    take(end, std::clamp(pair.project_on_b(end), T(-1), T(1)));
    take(std::clamp(pair.project_on_a(end), T(-1), T(1)), end);
  }
  take_inner(pair, take);
  return best;
}

/// The axis of two segments that intersect, in the plane: the normal of the side of C nearest to
/// the origin.
template <std::floating_point T>
SegmentAxis<Space<2, T>> crossing_axis(const SegmentPair<Space<2, T>>& pair,
                                       const SegmentAxis<Space<2, T>>&) {
  using Vector = typename Space<2, T>::Vector;
  SegmentAxis<Space<2, T>> best;
  best.gap = -std::numeric_limits<T>::infinity();
  const auto take = [&](const Vector& own, const Vector& other, bool is_of_a) {
    Vector normal = Vector(own.y(), -own.x()).normalized();
    if (normal.dot(pair.offset) < T(0)) normal = -normal;
    const T along = normal.dot(other), gap = normal.dot(pair.offset) - std::abs(along);
    if (!(gap > best.gap)) return;
    const T end = (along < T(0)) == is_of_a ? T(1) : T(-1);  // the deepest end of the other segment
    const T opposite =
        std::clamp(is_of_a ? pair.project_on_a(end) : pair.project_on_b(end), T(-1), T(1));
    best = {normal, gap, is_of_a ? opposite : end, is_of_a ? end : opposite};
  };
  take(pair.half_a, pair.half_b, true);
  take(pair.half_b, pair.half_a, false);
  return best;
}

/// The axis of two segments that intersect, in space: their common normal, towards the centre of b.
/// If the segments are parallel, any direction perpendicular to them.
template <std::floating_point T>
SegmentAxis<Space<3, T>> crossing_axis(const SegmentPair<Space<3, T>>& pair,
                                       const SegmentAxis<Space<3, T>>& nearest) {
  using S = Space<3, T>;
  const typename S::Vector across = pair.half_a.cross(pair.half_b);
  SegmentAxis<S> axis = nearest;
  const T least = T(64) * std::numeric_limits<T>::epsilon() * pair.size * pair.size;
  axis.normal = across.norm() > least ? across.normalized()
                                      : S::contact_frame(pair.half_a.normalized()).col(1).eval();
  if (axis.normal.dot(pair.offset) < T(0)) axis.normal = -axis.normal;
  return axis;
}

/// Computes the axis of two segments again if their nearest points are inner points at a small
/// distance, because the difference of these points has then lost digits. In the plane such
/// segments intersect, so there is nothing to do.
template <std::floating_point T>
void refine(const SegmentPair<Space<2, T>>&, SegmentAxis<Space<2, T>>&) {}
template <std::floating_point T>
void refine(const SegmentPair<Space<3, T>>& pair, SegmentAxis<Space<3, T>>& axis) {
  const typename Space<3, T>::Vector across = pair.half_a.cross(pair.half_b);
  const bool is_inner = std::abs(axis.s) < T(1) && std::abs(axis.t) < T(1);
  const T sine = across.norm() / (pair.half_a.norm() * pair.half_b.norm());
  if (!is_inner || !(axis.gap < sine * pair.size)) return;
  // The gap is measured at the nearest points, where an error of the normal changes it only in
  // second order.
  axis.normal = across.normalized();
  axis.gap = axis.normal.dot(pair.apart(axis.s, axis.t));
  if (axis.gap >= T(0)) return;
  axis.normal = -axis.normal;
  axis.gap = -axis.gap;
}

/// Whether the segments intersect.
/// @param nearest  the nearest points of the segments
template <std::floating_point T>
bool do_meet(const SegmentPair<Space<3, T>>& pair, const SegmentAxis<Space<3, T>>& nearest) {
  return !(nearest.gap > pair.size * DetectionTolerance<T>::rounding);
}
/// Whether two segments in the plane intersect. The smallest distance of an end from the other
/// segment equals the distance of the origin from the rim of C, whether the origin is inside of C
/// or outside. The origin is inside of C if it lies below both pairs of sides, by that distance.
/// The sides alone do not suffice for segments almost in one line, because all sides of C are then
/// almost parallel.
template <std::floating_point T>
bool do_meet(const SegmentPair<Space<2, T>>& pair, const SegmentAxis<Space<2, T>>& nearest) {
  const T rounding = pair.size * DetectionTolerance<T>::rounding;
  if (!(nearest.gap > rounding)) return true;
  const T below = crossing_axis(pair, nearest).gap;
  return below <= T(0) && nearest.gap + below <= rounding;
}

/// The separating axis of two segments, and the points that are nearest or deepest along it.
template <class S>
SegmentAxis<S> segment_axis(const SegmentPair<S>& pair) {
  using T = typename S::Scalar;
  SegmentAxis<S> axis = nearest_points(pair);
  if (do_meet(pair, axis)) return crossing_axis(pair, axis);
  // The direction between the nearest points is perpendicular to each segment whose nearest point
  // is an inner point. A component along such a segment is a rounding error and is removed.
  typename S::Vector apart = pair.apart(axis.s, axis.t);
  if (std::abs(axis.s) < T(1))
    apart -= apart.dot(pair.half_a) / pair.half_a.squaredNorm() * pair.half_a;
  if (std::abs(axis.t) < T(1))
    apart -= apart.dot(pair.half_b) / pair.half_b.squaredNorm() * pair.half_b;
  axis.normal = apart.normalized();
  refine(pair, axis);
  return axis;
}

}  // namespace moreau::detail
