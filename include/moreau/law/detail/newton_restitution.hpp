// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace moreau::detail {

/// e min(0, u_n before) if the gap is closed, else infinity: the contact cannot act in this step, and the step in which
/// its gap closes is the impact. Arguments as of newton_offset().
template <class T>
T impact_offset(T restitution, T gap, T before) {
  if (gap > T(0)) return std::numeric_limits<T>::infinity();
  return restitution * std::min(T(0), before);
}

/// Offset of the normal velocity [m/s] under Newton's restitution, as SetValuedLaw asks for it.
///
/// e = 0: max(0, g) / h. The contact may close its gap within the step; a penetration is not pushed
/// out. e > 0: e min(0, u_n before) if the gap is closed, else infinity. A contact that anticipated
/// its gap would lose the restitution.
/// @param restitution e in [0, 1] [-]
/// @param gap         g [m], < 0 is penetration
/// @param before      u_n before the step [m/s], > 0 separates
/// @param step        h [s], > 0
/// @returns infinity if the contact cannot act in this step
template <class T>
T newton_offset(T restitution, T gap, T before, T step) {
  if (restitution == T(0)) return std::max(T(0), gap) / step;
  return impact_offset(restitution, gap, before);
}

}  // namespace moreau::detail
