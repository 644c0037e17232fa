// SPDX-License-Identifier: MIT
// Contacts with a restitution that close within a step.
//
// Under a law with restitution a contact does not act before its gap is closed (newton_restitution.hpp): a contact that
// acted before would lose the restitution. For the points of a face this is too late. The gaps of a face that
// lands flat differ by rounding, or by the tilt that an earlier impact has left. If a step begins when some of them are closed,
// these points would act and the others would not: the grain would turn, with up to twice the velocity of the
// impact. A grain at rest would fall for a step wherever rounding opens its gap. So a contact with an open gap that
// closes within the step, at the velocity that forces alone would give, acts in two cases:
//
//   1. the pair touches: it has a contact whose gap is closed. The contact acts as if its gap were closed, too: a face
//      lands as a whole;
//   2. the contact is slow: the approach before the step is at most what forces add in the step. It may close its gap
//      within the step, as without restitution, and the bounce of the law is on top of that.
//
// Both offsets tend to that of a closed contact if the gap tends to 0. Neither case applies to a ball that falls
// onto a floor, nor to balls in a row of which the first is hit.
#pragma once

#include <cmath>
#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"

namespace moreau::detail {

/// How a contact acts in a step.
template <class T>
struct Closing {
  T gap;         ///< to be given to the law [m]
  T offset = 0;  ///< to be added to that of the law [m/s]
};

/// Whether the pair of contact c touches.
template <class S>
MOREAU_INLINED inline bool touches(const DetectedContacts<S>& contacts, const auto& gap_of,
                                   std::size_t c) {
  const std::size_t first = first_of_pair(contacts, c), last = end_of_pair(contacts, first);
  for (std::size_t k = first; k < last; ++k)
    if (!(gap_of(k) > 0)) return true;
  return false;
}

/// How contact c acts; the head of this file has the cases.
/// @param context StepContext of the step
/// @param gap_of  function: contact -> its gap [m]
/// @param before  u_n before the step [m/s], > 0 separates
/// @param free    u_n after it without impulses [m/s]
template <class Law, class T>
Closing<T> closing_of(const auto& context, const auto& gap_of, std::size_t c, const Law& law,
                      T before, T free) {
  const T gap = gap_of(c), step = context.step;
  if (!(gap > 0) || !(gap + step * free < 0) ||
      std::isfinite(law.velocity_offset(gap, before, step)))
    return {gap};
  if (2 * before >= free) return {T(0), gap / step};
  return touches(context.contacts, gap_of, c) ? Closing<T>{T(0)} : Closing<T>{gap};
}

}  // namespace moreau::detail
