// SPDX-License-Identifier: MIT
// Signed gap and axis of two segments, without thickness.
//
// They are apart by the distance of their nearest points: an end of one and a point of the other,
// or two inner points. If they meet, C = B - A holds the origin. In the plane it is a
// parallelogram, of which the nearest side is the axis; in space it is flat, so the gap is 0 along
// its normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau::detail {

/// Two segments relative to the centre of a: s half_a and offset + t half_b, s and t in [-1, 1].
template <class S>
struct SegmentPair {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  const Vector half_a, half_b, offset;
  const T size;  ///< the sum of the half lengths: what tolerances are relative to

  SegmentPair(const Placed<Segment<S>>& a, const Placed<Segment<S>>& b)
      : half_a(a.half()),
        half_b(b.half()),
        offset(b.center() - a.center()),
        size(a.radius() + b.radius()) {}
  /// @param first,second  the halves, from the middle to an end
  /// @param between       from the middle of the first to that of the second
  SegmentPair(const Vector& first, const Vector& second, const Vector& between)
      : half_a(first), half_b(second), offset(between), size(first.norm() + second.norm()) {}

  Vector apart(T s, T t) const { return offset + t * half_b - s * half_a; }
  /// Where on the line of the other the foot of a point is.
  T project_on_a(T t) const { return half_a.dot(offset + t * half_b) / half_a.squaredNorm(); }
  T project_on_b(T s) const { return half_b.dot(s * half_a - offset) / half_b.squaredNorm(); }
};

/// The axis of the signed gap, and the points of the segments that are nearest or deepest along it.
template <class S>
struct SegmentAxis {
  typename S::Vector normal;  ///< unit, from a to b
  typename S::Scalar gap = std::numeric_limits<typename S::Scalar>::infinity();  ///< [m]
  typename S::Scalar s = 0, t = 0;
};

/// The inner points of two segments in space where their lines are nearest, if there are any. From
/// the common normal: its digits last longer than those of a determinant.
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
/// In the plane segments without an end nearest to the other cross.
template <std::floating_point T, class Take>
void take_inner(const SegmentPair<Space<2, T>>&, const Take&) {}

/// The nearest points; the normal is not set.
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

/// Of segments that meet, in the plane: the nearest side of C.
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
    const T end = (along < T(0)) == is_of_a ? T(1) : T(-1);  // of the other, the deepest
    const T foot =
        std::clamp(is_of_a ? pair.project_on_a(end) : pair.project_on_b(end), T(-1), T(1));
    best = {normal, gap, is_of_a ? foot : end, is_of_a ? end : foot};
  };
  take(pair.half_a, pair.half_b, true);
  take(pair.half_b, pair.half_a, false);
  return best;
}

/// In space: the common normal, towards b's centre; of parallel ones any.
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

/// The normal of segments that pass each other at a small distance, where the difference of the
/// nearest points has lost its digits. In the plane such segments meet.
template <std::floating_point T>
void refine(const SegmentPair<Space<2, T>>&, SegmentAxis<Space<2, T>>&) {}
template <std::floating_point T>
void refine(const SegmentPair<Space<3, T>>& pair, SegmentAxis<Space<3, T>>& axis) {
  const typename Space<3, T>::Vector across = pair.half_a.cross(pair.half_b);
  const bool is_inner = std::abs(axis.s) < T(1) && std::abs(axis.t) < T(1);
  const T sine = across.norm() / (pair.half_a.norm() * pair.half_b.norm());
  if (!is_inner || !(axis.gap < sine * pair.size)) return;
  // Between the feet, where an error of the normal counts in second order only.
  axis.normal = across.normalized();
  axis.gap = axis.normal.dot(pair.apart(axis.s, axis.t));
  if (axis.gap >= T(0)) return;
  axis.normal = -axis.normal;
  axis.gap = -axis.gap;
}

/// Whether the segments meet.
/// @param nearest  of their points
template <std::floating_point T>
bool do_meet(const SegmentPair<Space<3, T>>& pair, const SegmentAxis<Space<3, T>>& nearest) {
  return !(nearest.gap > pair.size * DetectionTolerance<T>::rounding);
}
/// In the plane the nearest of the ends' distances is how far the origin is from the rim of C,
/// within it or not. It is within if it is below both pairs of sides, by as much: of segments
/// almost in line the sides alone do not tell, as they are almost parallel.
template <std::floating_point T>
bool do_meet(const SegmentPair<Space<2, T>>& pair, const SegmentAxis<Space<2, T>>& nearest) {
  const T rounding = pair.size * DetectionTolerance<T>::rounding;
  if (!(nearest.gap > rounding)) return true;
  const T below = crossing_axis(pair, nearest).gap;
  return below <= T(0) && nearest.gap + below <= rounding;
}

template <class S>
SegmentAxis<S> segment_axis(const SegmentPair<S>& pair) {
  using T = typename S::Scalar;
  SegmentAxis<S> axis = nearest_points(pair);
  if (do_meet(pair, axis)) return crossing_axis(pair, axis);
  // Across a segment whose end is not the nearest point, whatever rounding adds along it.
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
