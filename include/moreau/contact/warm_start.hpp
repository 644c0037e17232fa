// SPDX-License-Identifier: MIT
// Values that contacts keep from the step before. A contact is the same in two steps if its key is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/merge_join.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau {

/// How impulses change from step to step: not at all in world axes. They are the first guess of rigid contacts.
template <class S>
struct ImpulseTurn {
  /// The frame of a contact of the step before.
  const typename S::Matrix& axes(const Contact<S>& before, const Contact<S>&) const {
    return before.frame;
  }
  /// A vector in the frame of a contact of the step before, in the frame of the contact in this step.
  MOREAU_COMPILED_ONCE typename S::Vector operator()(const Contact<S>& before,
                                                     const Contact<S>& now,
                                                     const typename S::Vector& vector) const {
    return detail::inlined_transposed_product(now.frame,
                                              detail::inlined_product(before.frame, vector));
  }
};

/// How the springs of contacts turn between two detections. A spring in the tangential plane turns
/// with the mean of the rotations of the two bodies, about the normal as well, and then by the least
/// rotation that takes its normal to that of this step. A common rotation of both bodies therefore
/// changes no component of a spring in the contact frame. To first order this is the rotation of the
/// tangential force in P. A. Cundall, Int. J. Rock Mech. Min. Sci. 25 (1988) 107. The component along
/// the normal is kept: as a vector of the world it would become a tangential component wherever the
/// normal turns.
template <class S>
struct SpringTurn {
  std::span<const typename S::Twist> velocity;  ///< one per body, world axes [m/s, rad/s]
  typename S::Scalar duration;                  ///< between the detections, at this velocity [s]

  /// The frame of a contact of the step before after the rotation: orthonormal columns, the first is
  /// the normal of `now`.
  typename S::Matrix axes(const Contact<S>& before, const Contact<S>& now) const {
    using Scalar = typename S::Scalar;
    const typename S::Angular mean =
        (angular<S>(velocity[now.a]) + angular<S>(velocity[now.b])) * (duration / 2);
    typename S::Matrix axes = S::exp(mean).toRotationMatrix() * before.frame;
    const typename S::Vector normal = now.frame.col(0), sum = axes.col(0) + normal;
    // |sum|^2 = 2 (1 + cos of the angle between the normals)
    const Scalar square = std::max(sum.squaredNorm(), std::numeric_limits<Scalar>::epsilon());
    for (int k = 1; k < S::dim; ++k) axes.col(k) -= 2 * axes.col(k).dot(normal) / square * sum;
    axes.col(0) = normal;
    return axes;
  }
  /// A vector in the frame of a contact of the step before, in the frame of the contact in this step.
  MOREAU_COMPILED_ONCE typename S::Vector operator()(const Contact<S>& before,
                                                     const Contact<S>& now,
                                                     const typename S::Vector& vector) const {
    if (vector.template tail<S::dim - 1>().isZero(0)) return vector;
    typename S::Vector carried = transposed_product(now.frame, product(axes(before, now), vector));
    carried[0] = vector[0];  // to the last bit
    return carried;
  }
};

namespace detail {

/// An impulse with a couple in the frame of a contact of the step before, in the frame of this step.
/// @param turn ImpulseTurn or SpringTurn
template <class S>
MOREAU_COMPILED_ONCE typename S::Twist carried_twist(const auto& turn, const Contact<S>& before,
                                                     const Contact<S>& now,
                                                     const typename S::Twist& row) {
  typename S::Twist result = S::Twist::Zero();
  linear<S>(result) = turn(before, now, typename S::Vector(linear<S>(row)));
  if (!angular<S>(row).isZero(0))
    angular<S>(result) = S::angular_frame(now.frame).transpose() *
                         (S::angular_frame(turn.axes(before, now)) * angular<S>(row));
  return result;
}

/// A vector in the frame of a contact of the step before, or an impulse with a couple, in the frame of this step.
/// @param turn ImpulseTurn or SpringTurn
template <class S, class Row>
Row carried(const auto& turn, const Contact<S>& before, const Contact<S>& now, const Row& row) {
  if constexpr (std::is_same_v<Row, typename S::Vector>)
    return turn(before, now, row);
  else
    return carried_twist<S>(turn, before, now, row);
}

}  // namespace detail

/// Carries vectors in contact frames, or impulses with couples, and the variants of the laws, if `before` has any, over to
/// the contacts of the same keys. Contacts without a predecessor get zero.
/// @param before,now each sorted by its keys
/// @param old        one per contact of `before`
/// @param out        out: one per contact of `now`
/// @param turn       ImpulseTurn or SpringTurn
/// @param team       threads that share the work
/// @returns how many contacts have a predecessor
template <class S, int Rows, class Row>
std::size_t carry(const Contacts<S, Rows>& before, Contacts<S, Rows>& now, const List<Row>& old,
                  List<Row>& out, const auto& turn, const Team& team = {}) {
  struct Count {
    std::size_t value = 0;
    void add(const Count& other) { value += other.value; }
  };
  out.resize(now.size());
  now.variants.resize(now.size());
  return detail::sum_of_parts<Count>(
             team, now.size(),
             [&](std::size_t begin, std::size_t end) -> Count {
               std::fill(out.begin() + std::ptrdiff_t(begin), out.begin() + std::ptrdiff_t(end),
                         Row(Row::Zero()));
               if (begin == end) return {};
               const auto first =
                   std::lower_bound(before.keys.begin(), before.keys.end(), now.keys[begin]);
               const auto skipped = std::size_t(first - before.keys.begin());
               const std::span some = std::span(now.keys).subspan(begin, end - begin);
               return {merge_join(some, std::span(before.keys).subspan(skipped),
                                  [&](std::size_t i, std::size_t j) {
                                    i += begin;
                                    j += skipped;
                                    out[i] = detail::carried<S>(turn, before.points[j],
                                                                now.points[i], old[j]);
                                    if (!before.variants.empty())
                                      now.variants[i] = before.variants[j];
                                  })};
             })
      .value;
}

/// Makes the impulses of the step before [N s] the first guess of this step.
/// @param before,now each sorted by its keys
/// @returns how many contacts have a predecessor
template <class S, int Rows>
std::size_t warm_start(const Contacts<S, Rows>& before, Contacts<S, Rows>& now,
                       const Team& team = {}) {
  return carry(before, now, before.impulses, now.impulses, ImpulseTurn<S>(), team);
}

namespace detail {

/// Calls receive(i, j) for each contact j of the step before that has a memory and whose key is gone: i is
/// the nearest contact of the same pair of bodies for which may_receive(key of i). Nothing is called if
/// there is none.
/// @param before,now each sorted by its keys
/// @param memory     vectors, one per contact of `before`
template <class S>
void for_each_heir(const DetectedContacts<S>& before, const DetectedContacts<S>& now,
                   const auto& memory, const auto& may_receive, const auto& receive) {
  const auto begin = now.keys.begin(), end = now.keys.end();
  auto next = begin;  // the first contact whose key is not below
  for (std::size_t j = 0; j < before.size(); ++j) {
    const ContactKey& key = before.keys[j];
    // Most contacts are still there: comparing for equality first takes less time.
    if (next != end && *next == key) {
      ++next;
      continue;
    }
    while (next != end && *next < key) ++next;
    if ((next != end && *next == key) || memory[j].isZero(0)) continue;
    auto first = next, last = next;
    while (first != begin && (first - 1)->bodies() == key.bodies()) --first;
    while (last != end && last->bodies() == key.bodies()) ++last;
    const auto distance = [&](auto it) {
      return (now.points[std::size_t(it - now.keys.begin())].lever_a - before.points[j].lever_a)
          .squaredNorm();
    };
    auto nearest = last;
    for (auto it = first; it != last; ++it)
      if (may_receive(*it) && (nearest == last || distance(it) < distance(nearest))) nearest = it;
    if (nearest != last) receive(std::size_t(nearest - now.keys.begin()), j);
  }
}

}  // namespace detail

/// Hands the impulses of contacts whose key is gone to the nearest contact of the same pair of
/// bodies, if there is one: feature keys of contacts between faces change while the faces stay in
/// contact. A contact without an impulse of its own takes the variant of the law, too.
/// @param before,now each sorted by its keys
/// @param old        one per contact of `before`
/// @param out        in and out: one per contact of `now`, as carry() left it
/// @param turn       ImpulseTurn or SpringTurn
/// @param hands_over function: key of a contact of the step before -> whether it hands its impulse over
/// @returns how many contacts handed their impulse over
template <class S, int Rows, class Row>
std::size_t hand_over(const Contacts<S, Rows>& before, Contacts<S, Rows>& now, const List<Row>& old,
                      List<Row>& out, const auto& turn, const auto& hands_over) {
  std::size_t count = 0;
  detail::for_each_heir<S>(
      before, now, old, [](const ContactKey&) { return true; },
      [&](std::size_t i, std::size_t j) {
        if (!hands_over(before.keys[j])) return;
        if (out[i].isZero(0) && !before.variants.empty()) now.variants[i] = before.variants[j];
        out[i] += detail::carried<S>(turn, before.points[j], now.points[i], old[j]);
        ++count;
      });
  return count;
}

/// The same for all contacts.
template <class S, int Rows, class Row>
std::size_t hand_over(const Contacts<S, Rows>& before, Contacts<S, Rows>& now, const List<Row>& old,
                      List<Row>& out, const auto& turn) {
  return hand_over(before, now, old, out, turn, [](const ContactKey&) { return true; });
}

/// Hands the memory of contacts whose key is gone to the nearest contact of the same pair of bodies
/// that is new and has no memory yet. Unlike impulses, stretches of springs are not added: a sum would
/// have more energy than its parts.
/// @param before,now each sorted by its keys
/// @param old        memory, one per contact of `before`
/// @param out        in and out: one per contact of `now`, as carry() left it
template <class S>
void hand_over_stretches(const DetectedContacts<S>& before, const DetectedContacts<S>& now,
                         const List<typename S::Vector>& old, List<typename S::Vector>& out,
                         const SpringTurn<S>& turn) {
  detail::for_each_heir<S>(
      before, now, old,
      [&](const ContactKey& key) {
        const auto i = std::size_t(&key - now.keys.data());
        return out[i].isZero(0) && !std::binary_search(before.keys.begin(), before.keys.end(), key);
      },
      [&](std::size_t i, std::size_t j) {
        out[i] = turn(before.points[j], now.points[i], old[j]);
      });
}

}  // namespace moreau
