// SPDX-License-Identifier: MIT
// Values that contacts keep from the step before. A contact is the same in two steps if its key is.
#pragma once

#include <cstddef>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/merge_join.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau {

/// Carries vectors in contact frames over to the contacts of the same keys: through world axes into
/// the new frame. Contacts without a predecessor get zero.
/// @param before,now each sorted by its keys
/// @param old        in: one per contact of `before`
/// @param out        one per contact of `now`
/// @returns how many contacts have a predecessor
template <class S>
std::size_t carry(const Contacts<S>& before, const Contacts<S>& now,
                  const std::vector<typename S::Vector>& old,
                  std::vector<typename S::Vector>& out) {
  out.assign(now.size(), S::Vector::Zero());
  return merge_join(now.keys, before.keys, [&](std::size_t i, std::size_t j) {
    out[i] = transposed_product(now.points[i].frame, product(before.points[j].frame, old[j]));
  });
}

/// Makes the impulses of the step before [N s] the first guess of this step.
/// @param before,now each sorted by its keys
/// @returns how many contacts have a predecessor
template <class S>
std::size_t warm_start(const Contacts<S>& before, Contacts<S>& now) {
  return carry(before, now, before.impulses, now.impulses);
}

/// Carries couples [N m s] over, as carry() does impulses: A numbers each, in the angular frame.
template <class S>
void carry_couples(const Contacts<S>& before, const Contacts<S>& now,
                   const std::vector<typename S::Angular>& old,
                   std::vector<typename S::Angular>& out) {
  out.assign(now.size(), S::Angular::Zero());
  merge_join(now.keys, before.keys, [&](std::size_t i, std::size_t j) {
    out[i] = S::angular_frame(now.points[i].frame).transpose() *
             (S::angular_frame(before.points[j].frame) * old[j]);
  });
}

}  // namespace moreau
