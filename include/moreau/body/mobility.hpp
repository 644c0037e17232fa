// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/space.hpp"

namespace moreau {

/// M^-1/2 of one body in world axes: symmetric, zero along axes whose motion is prescribed.
template <class S>
struct MobilityRoot {
  typename S::Matrix linear;    ///< D x D [kg^-1/2]
  typename S::Inertia angular;  ///< A x A [kg^-1/2 m^-1]
};

}  // namespace moreau
