// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/space.hpp"

namespace moreau {

/// What the equations of motion need of a shape at a uniform density.
/// The inertia is about the centre of mass, in the axes of the shape's own frame. In the plane the
/// density is per area [kg/m^2].
template <class S>
struct MassProperties {
  typename S::Scalar mass = 0;                       ///< [kg]
  typename S::Vector center = S::Vector::Zero();     ///< centre of mass in the shape's frame [m]
  typename S::Inertia inertia = S::Inertia::Zero();  ///< A x A, about the centre [kg m^2]
};

}  // namespace moreau
