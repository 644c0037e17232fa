// SPDX-License-Identifier: MIT
// The inverse square root of the mass matrix of one body.
#pragma once

#include "moreau/core/space.hpp"

namespace moreau {

/// M^-1/2 of one body in world axes, where M is its mass matrix. It is symmetric, and zero along
/// axes along which the motion is prescribed.
template <class S>
struct MobilityRoot {
  typename S::Matrix linear;    ///< for forces, D x D [kg^-1/2]
  typename S::Inertia angular;  ///< for torques, A x A [kg^-1/2 m^-1]
  /// Whether the body is a grain, whose surface is curved for the laws with an effective radius; also
  /// if `angular` is zero because the motion is prescribed. A body that torques rotate counts as a
  /// grain without it.
  bool grain = false;
};

}  // namespace moreau
