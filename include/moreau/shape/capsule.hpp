// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// A capsule in space or a stadium in the plane: all points whose distance from a segment on the x
/// axis is at most a radius. Programs for one dimension write Capsule<T> or Stadium<T>. It is
/// constructed from the half length of the segment and the radius, both in [m]. Its total length is
/// 2 (half_length + radius).
template <EuclideanSpace S>
using CapsuleIn = Rounded<Segment<S>>;
/// A stadium in the plane: a rectangle between two half disks.
template <std::floating_point T = double>
using Stadium = CapsuleIn<Space<2, T>>;
/// A capsule in space: a cylinder between two half balls.
template <std::floating_point T = double>
using Capsule = CapsuleIn<Space<3, T>>;

}  // namespace moreau
