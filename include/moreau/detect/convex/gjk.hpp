// SPDX-License-Identifier: MIT
// GJK: the distance of two convex shapes that are given by their support functions, or the result
// that the shapes overlap. Source: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure
// for computing the distance between complex objects in three-dimensional space, IEEE J. Robotics
// and Automation 4 (1988) 193-203.
//
// Let C = B - A be the set of all differences b - a. The shapes are apart if and only if C does not
// contain the origin. Let v be the point of C nearest to the origin. The distance of the shapes is
// |v|, and the contact normal is v / |v|. The iteration has an upper and a lower bound of |v|:
//   - The hull of the points of C found so far (simplex.hpp) is a part of C. So its distance from
//     the origin is at least |v|.
//   - Let w(n) be the point of C with the smallest n . w, for a unit vector n. Then n . w(n) is at
//     most |v|.
#pragma once

#include <limits>

#include "moreau/detect/convex/simplex.hpp"

namespace moreau::detail {

enum class Proximity {
  beyond,     ///< the shapes are separated by more than the margin along the last direction
  apart,      ///< the shapes are apart; the simplex contains the nearest points
  touching,   ///< the shapes overlap, or their distance is smaller than the rounding errors
  undecided,  ///< the number of steps was too small for a result
};

/// Runs at most `steps` iterations of GJK.
/// @param support  support(n) -> the DifferencePoint of C with the smallest n . point
/// @param simplex  in: points of C at which the iteration starts; out: the simplex with the nearest
///                 point found
/// @param axis     out: the last direction for which a support point was computed, of any length
/// @param margin   the iteration stops if the gap is proved to be larger than this [m], >= 0
/// @param size     order of magnitude of the size of the shapes [m]; lengths below 8 eps size count
///                 as zero
/// @param steps    largest number of iterations; usually about 6 are needed
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
    const T length2 = axis.squaredNorm(), unit = simplex.unit();
    const auto squared = [unit](T x) { return unit * x * (unit * x); };
    if (s > T(0) && squared(s) > squared(margin) * length2) return Proximity::beyond;
    const T gain = axis.dot(simplex[0].point) - s;
    if (squared(gain) <= squared(negligible) * length2 || gain < T(0) || simplex.contains(next))
      return Proximity::apart;
    const Step step = simplex.add(next);
    if (step == Step::enclosed) return Proximity::touching;
    if (step == Step::stuck) return Proximity::apart;
  }
  return Proximity::undecided;
}

/// The largest number of GJK iterations. More iterations occur only because of rounding errors.
inline constexpr int all_steps = 64;

}  // namespace moreau::detail
