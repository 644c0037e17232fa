// SPDX-License-Identifier: MIT
// GJK: the distance of two convex shapes that are known by their support functions, or that they
// overlap. Source: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the
// distance between complex objects in three-dimensional space, IEEE J. Robotics and Automation 4
// (1988) 193-203.
//
// C = B - A is the set of differences b - a. The shapes are apart if and only if C does not hold
// the origin. The point v of C nearest to the origin is then the distance, and its direction the
// normal. Two bounds close in on it: the hull of the points of C found so far (simplex.hpp) is at
// least as far from the origin as C, and for any unit n with the support point w(n), s(n) = n .
// w(n) is at most the distance.
#pragma once

#include <limits>

#include "moreau/detect/convex/simplex.hpp"

namespace moreau::detail {

enum class Proximity {
  beyond,     ///< a plane separates the shapes by more than the margin
  apart,      ///< the shapes are apart; the simplex holds the nearest points
  touching,   ///< the shapes overlap, or their distance is lost in rounding
  undecided,  ///< the steps were too few to tell
};

/// Runs some steps of GJK.
/// @param support  support(n) -> the DifferencePoint of C with the smallest n . point
/// @param simplex  in: points of C to start from; out: the nearest points found
/// @param axis     out: the last direction of a support point, any length
/// @param margin   the iteration stops when the gap is known to be larger [m], >= 0
/// @param size     of the order of the shapes [m]; less than some eps of it counts as zero
/// @param steps    the most steps to make; about 6 suffice for an answer
template <std::floating_point T, class Support>
Proximity gjk(const Support& support, Simplex<T>& simplex, typename Space<3, T>::Vector& axis,
              T margin, T size, int steps) {
  using Step = typename Simplex<T>::Step;
  const T negligible = T(8) * std::numeric_limits<T>::epsilon() * size;
  for (int i = 0; i < steps; ++i) {
    if (simplex.squared_distance() <= negligible * negligible) return Proximity::touching;
    axis = simplex.direction();
    const auto next = support(axis);
    const T s = axis.dot(next.point);
    const T length2 = axis.squaredNorm();
    if (s > T(0) && s * s > margin * margin * length2) return Proximity::beyond;
    const T gain = axis.dot(simplex[0].point) - s;
    if (gain * gain <= negligible * negligible * length2 || gain < T(0) || simplex.contains(next))
      return Proximity::apart;
    const Step step = simplex.add(next);
    if (step == Step::enclosed) return Proximity::touching;
    if (step == Step::stuck) return Proximity::apart;
  }
  return Proximity::undecided;
}

/// The most steps of GJK; more would be due to rounding only.
inline constexpr int all_steps = 64;

}  // namespace moreau::detail
