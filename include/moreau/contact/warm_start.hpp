// SPDX-License-Identifier: MIT
// What contacts carry over from the step before.
#pragma once

#include <cstddef>
#include <vector>

#include "moreau/contact/contact.hpp"

namespace moreau {

namespace detail {

/// found(now, before) for every contact of both steps. Both lists are sorted by key: one merge.
/// @returns how many
template <class S>
std::size_t for_same_contacts(const Contacts<S>& before, const Contacts<S>& now,
                              const auto& found) {
  std::size_t count = 0;
  for (std::size_t i = 0, j = 0; i < now.size() && j < before.size();) {
    if (now.keys[i] < before.keys[j]) {
      ++i;
    } else if (before.keys[j] < now.keys[i]) {
      ++j;
    } else {
      found(i++, j++);
      ++count;
    }
  }
  return count;
}

}  // namespace detail

/// Carries vectors of the contact frames, in world axes, from the contacts of the same keys and
/// projects them on the new frames; contacts without a predecessor get zero.
/// @param before,now each sorted by its keys
/// @param old        in: one per contact of `before`
/// @param out        one per contact of `now`
/// @returns how many contacts found their predecessor
template <class S>
std::size_t carry(const Contacts<S>& before, const Contacts<S>& now,
                  const std::vector<typename S::Vector>& old,
                  std::vector<typename S::Vector>& out) {
  out.assign(now.size(), S::Vector::Zero());
  return detail::for_same_contacts(before, now, [&](std::size_t i, std::size_t j) {
    out[i] = now.points[i].frame.transpose() * (before.points[j].frame * old[j]);
  });
}

/// The impulses of the step before [N s] as the first guess of this one.
/// @param before,now each sorted by its keys
/// @returns how many contacts found their predecessor
template <class S>
std::size_t warm_start(const Contacts<S>& before, Contacts<S>& now) {
  return carry(before, now, before.impulses, now.impulses);
}

/// The same for couples [N m s], vectors of the angular frame; A numbers each.
template <class S>
void carry_couples(const Contacts<S>& before, const Contacts<S>& now,
                   const std::vector<typename S::Angular>& old,
                   std::vector<typename S::Angular>& out) {
  out.assign(now.size(), S::Angular::Zero());
  detail::for_same_contacts(before, now, [&](std::size_t i, std::size_t j) {
    out[i] = S::angular_frame(now.points[i].frame).transpose() *
             (S::angular_frame(before.points[j].frame) * old[j]);
  });
}

}  // namespace moreau
