// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/space.hpp"
#include "moreau/detect/axis.hpp"

namespace moreau {

/// What the narrow phase remembers of a pair from one step to the next. It saves time and nothing
/// else: every answer is the same with an empty one, or with one that belongs to another pair,
/// because what it holds is only a guess that is proved anew each time (local_proof.hpp).
template <class S>
struct PairCache {
  /// The axis, unit, from a to b, world axes, that separated the pair last time; zero if none did.
  typename S::Vector axis = S::Vector::Zero();
  /// The features that made the axis last time.
  detail::AxisKind kind = detail::AxisKind::none;
  std::uint32_t a = 0;  ///< index of a's
  std::uint32_t b = 0;  ///< index of b's

  /// Keeps an axis for the next query.
  void remember(const detail::Axis<S>& found) {
    axis = found.normal;
    kind = found.kind;
    a = found.a;
    b = found.b;
  }
};

}  // namespace moreau
