// SPDX-License-Identifier: MIT
// Distance of two convex shapes that are apart, or the news that they are not.
//
// C = B - A is the set of differences b - a. The shapes are apart iff C does not hold the origin,
// and the nearest point v of C to the origin is then the distance, its direction the normal. Two
// bounds close in on it: the hull of the points of C found so far is at least as far away as C, and
// for any unit n the plane of the support point w(n) bounds C: s(n) = n . w <= distance.
#pragma once

#include <limits>

#include "moreau/detect/convex/simplex.hpp"

namespace moreau::detail {

enum class Proximity {
  beyond,     ///< a plane separates the shapes by more than the margin
  apart,      ///< apart; the simplex has the nearest points
  touching,   ///< they overlap, or what is between them is lost in rounding
  undecided,  ///< none of these yet
};

/// @param support  support(n) -> the DifferencePoint of C with the smallest n . point
/// @param simplex  points of C to go on from; ends up at the nearest ones found
/// @param axis     the last direction looked along, of any length
/// @param margin   stop when the gap is known to be larger [m], >= 0
/// @param size     length of the order of the shapes; what is below some eps of it counts as zero
/// @param steps    stop after as many; some 6 suffice for an answer
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

/// So many steps that only rounding can make them necessary.
inline constexpr int all_steps = 64;

}  // namespace moreau::detail
