// SPDX-License-Identifier: MIT
// Why features remembered from the step before can be proved, from the present poses alone, to give
// the signed gap: no bound on the motion is needed, and none is assumed.
//
// C = B - A is the set of differences b - a; F(m) = min over C of m . c is the separation along the
// unit vector m, and the signed gap is the largest F(m). Let n be an axis at hand and s = F(n),
// d = max(0, -s). Suppose two things about C.
//
//   1. The point s n lies in C's facet at n, at least r from the facet's rim: the foot of one
//      feature on the other is inside it. The disk of radius r about s n is then in C, and for m at
//      an angle theta from n
//          F(m) <= s cos theta - r sin theta.
//      With tau = tan(theta / 2) this falls short of s by at least 2 tau (r - d tau) / (1 + tau^2).
//   2. The balls about the centres that the shapes hold, of radii that add up to rho, lie in them.
//      C then has a ball of radius rho about c, the difference of the centres. With h = c . n and
//      t^2 = |c|^2 - h^2
//          F(m) <= h cos theta + t sin theta - rho,
//      which is below -d where (h + rho - d) tau^2 - 2 t tau - (h + d - rho) >= 0, so for all tau
//      beyond the larger root, tau_0 = (t + sqrt(|c|^2 - (rho - d)^2)) / (h + rho - d).
//
// So if r >= d tau_0, the first bound rules out all m up to tau_0, the second all m beyond: no axis
// separates better than n. In a word: a shallow overlap whose foot is well inside the features is
// the global one. Where the shapes are apart (d = 0) any foot inside will do, as it must, the
// distance being a convex problem.
//
// To have the very answer of the full search, which of several axes that tie within rounding takes
// the first, no other candidate may tie. Axes more than the angle `distinct` from n lose by more
// than `doubt` if r >= d tau_0 + 2 doubt / distinct, d includes the doubt, and tau_0 < 100; nearer
// ones are ruled out by the callers, who see to it that no other feature of either shape is that
// parallel. A pair that fails any of this is searched in full.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/detect/tolerance.hpp"

namespace moreau::detail {

/// How far inside the facet the foot has to be [m]; infinite if no proof of this kind is possible.
/// @param height   of b's centre above a's along the axis, h [m]
/// @param apart2   square of the distance of the centres, |c|^2 [m^2]
/// @param inner    sum of the radii of balls about the centres within the shapes, rho [m]
/// @param size     sum of the radii of balls around the shapes [m]
template <std::floating_point T>
T needed_clearance(T gap, T height, T apart2, T inner, T size) {
  const T doubt = DetectionTolerance<T>::doubt * size;
  const T depth = std::max(-gap, T(0)) + doubt;
  const T aside = std::sqrt(std::max(apart2 - height * height, T(0)));
  const T within = inner - depth;
  const T root = std::sqrt(std::max(apart2 - within * within, T(0)));
  if (!(aside + root < T(100) * (height + within))) return std::numeric_limits<T>::infinity();
  return depth * (aside + root) / (height + within) +
         T(2) * doubt / DetectionTolerance<T>::distinct;
}

}  // namespace moreau::detail
