// SPDX-License-Identifier: MIT
// Impulses of the step before, as the first guess of this one.
#pragma once

#include <cstddef>

#include "moreau/contact/contact.hpp"

namespace moreau {

/// Carries each impulse in world axes from the contact of the same key and projects it on the new
/// frame; contacts without a predecessor start from zero. Both lists are sorted by key: one merge.
/// @returns how many contacts found their predecessor
template <class S>
std::size_t warm_start(const Contacts<S>& before, Contacts<S>& now) {
  now.impulses.assign(now.size(), S::Vector::Zero());
  std::size_t found = 0;
  for (std::size_t i = 0, j = 0; i < now.size() && j < before.size();) {
    if (now.keys[i] < before.keys[j]) {
      ++i;
    } else if (before.keys[j] < now.keys[i]) {
      ++j;
    } else {
      now.impulses[i] =
          now.points[i].frame.transpose() * (before.points[j].frame * before.impulses[j]);
      ++i, ++j, ++found;
    }
  }
  return found;
}

}  // namespace moreau
