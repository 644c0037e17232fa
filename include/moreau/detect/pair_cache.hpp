// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/space.hpp"

namespace moreau {

/// What the narrow phase remembers of a pair from one step to the next. It saves time and nothing
/// else: every answer is the same with an empty one.
template <class S>
struct PairCache {
  /// The axis, from a to b, that separated the pair last time or was its normal; zero if none.
  typename S::Vector axis = S::Vector::Zero();
};

}  // namespace moreau
