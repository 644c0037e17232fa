// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// All points at most the radius away from a segment of the x axis: a cylinder between two half
/// balls, in the plane a stadium. Capsule<S>(half_length, radius), both in metres; the half length
/// is that of the segment, so the whole is 2 (half_length + radius) long.
template <class S>
using Capsule = Rounded<Segment<S>>;

}  // namespace moreau
