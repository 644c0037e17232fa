// SPDX-License-Identifier: MIT
// Values that contacts keep from the step before. A contact is the same in two steps if its key is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/detail/compiled_once.hpp"
#include "moreau/core/detail/merge_join.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/team.hpp"

namespace moreau {

/// A vector in the frame of a contact of the step before, in the frame of the contact in this step:
/// through world axes.
template <class S>
MOREAU_COMPILED_ONCE typename S::Vector turned(const Contact<S>& before, const Contact<S>& now,
                                               const typename S::Vector& vector) {
  return transposed_product(now.frame, product(before.frame, vector));
}

/// Returns the impulse that the springs of a contact carry over from the step before, in the contact
/// frame of this step [N s]. The normal component is kept. The tangential component is transformed
/// through world axes. (law/compliant.hpp explains its use.) Transforming the whole vector would change a part of the normal impulse into a tangential impulse
/// wherever the normal turns.
template <class S>
typename S::Vector turned_memory(const Contact<S>& before, const Contact<S>& now,
                                 const typename S::Vector& impulse) {
  typename S::Vector tangential = impulse;
  tangential[0] = 0;
  typename S::Vector memory = turned(before, now, tangential);
  memory[0] = impulse[0];
  return memory;
}

/// Carries vectors in contact frames, and the variants of the laws, over to the contacts of the same keys.
/// Contacts without a predecessor get zero.
/// @param before,now each sorted by its keys
/// @param old        one per contact of `before`
/// @param out        out: one per contact of `now`
/// @param turn       turned() or turned_memory()
/// @param team       threads that share the work
/// @returns how many contacts have a predecessor
template <class S, class Turn>
std::size_t carry(const Contacts<S>& before, Contacts<S>& now,
                  const std::vector<typename S::Vector>& old, std::vector<typename S::Vector>& out,
                  const Turn& turn, const Team& team = {}) {
  struct Count {
    std::size_t value = 0;
    void add(const Count& other) { value += other.value; }
  };
  out.resize(now.size());
  return detail::sum_of_parts<Count>(
             team, now.size(),
             [&](std::size_t begin, std::size_t end) -> Count {
               std::fill(out.begin() + std::ptrdiff_t(begin), out.begin() + std::ptrdiff_t(end),
                         S::Vector::Zero());
               if (begin == end) return {};
               const auto first =
                   std::lower_bound(before.keys.begin(), before.keys.end(), now.keys[begin]);
               const auto skipped = std::size_t(first - before.keys.begin());
               const std::span some = std::span(now.keys).subspan(begin, end - begin);
               return {merge_join(some, std::span(before.keys).subspan(skipped),
                                  [&](std::size_t i, std::size_t j) {
                                    i += begin;
                                    j += skipped;
                                    out[i] = turn(before.points[j], now.points[i], old[j]);
                                    now.points[i].variant = before.points[j].variant;
                                  })};
             })
      .value;
}

/// Makes the impulses of the step before [N s] the first guess of this step.
/// @param before,now each sorted by its keys
/// @returns how many contacts have a predecessor
template <class S>
std::size_t warm_start(const Contacts<S>& before, Contacts<S>& now, const Team& team = {}) {
  return carry(before, now, before.impulses, now.impulses, turned<S>, team);
}

/// Makes the impulses of the step before [N s] the memory of the springs in this step.
/// @param before,now each sorted by its keys
/// @returns how many contacts have a predecessor
template <class S>
std::size_t remember_springs(const Contacts<S>& before, Contacts<S>& now, const Team& team = {}) {
  return carry(before, now, before.impulses, now.impulses, turned_memory<S>, team);
}

/// Hands the impulses of contacts whose key is gone to the nearest contact of the same pair of
/// bodies, if there is one: feature keys of contacts between faces change while the faces stay in
/// contact. A contact without an impulse of its own takes the variant of the law, too.
/// @param before,now each sorted by its keys; the impulses of `now` are those of
///                   remember_springs()
/// @returns how many contacts handed their impulse over
template <class S>
std::size_t hand_over(const Contacts<S>& before, Contacts<S>& now) {
  const auto pair_of = [](const ContactKey& key) { return std::pair(key.a, key.b); };
  std::size_t count = 0;
  auto first = now.keys.begin();  // the first contact of the pair; pairs are in ascending order
  for (std::size_t j = 0; j < before.size(); ++j) {
    if (before.impulses[j].isZero(0)) continue;
    const ContactKey& key = before.keys[j];
    while (first != now.keys.end() && pair_of(*first) < pair_of(key)) ++first;
    auto last = first;
    while (last != now.keys.end() && pair_of(*last) == pair_of(key)) ++last;
    if (first == last || std::binary_search(first, last, key)) continue;
    const auto distance = [&](auto it) {
      return (now.points[std::size_t(it - now.keys.begin())].lever_a - before.points[j].lever_a)
          .squaredNorm();
    };
    auto nearest = first;
    for (auto it = first; it != last; ++it)
      if (distance(it) < distance(nearest)) nearest = it;
    const auto i = std::size_t(nearest - now.keys.begin());
    if (now.impulses[i].isZero(0)) now.points[i].variant = before.points[j].variant;
    now.impulses[i] += turned_memory(before.points[j], now.points[i], before.impulses[j]);
    ++count;
  }
  return count;
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
