// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// A capsule in space, a stadium in the plane: Capsule<T> or Stadium<T> where the dimension is
/// known. All points at most the radius away from a segment of the x axis. Constructed from the
/// half length of the segment and the radius, both in metres, so that the whole is
/// 2 (half_length + radius) long.
template <EuclideanSpace S>
using CapsuleIn = Rounded<Segment<S>>;
/// The capsule of the plane: a rectangle between two half disks.
template <std::floating_point T = double>
using Stadium = CapsuleIn<Space<2, T>>;
/// The capsule of space: a cylinder between two half balls.
template <std::floating_point T = double>
using Capsule = CapsuleIn<Space<3, T>>;

}  // namespace moreau
