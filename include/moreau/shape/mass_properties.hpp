// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "moreau/core/components.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// Mass, centre of mass and inertia of a shape at a uniform density. The inertia is about the
/// centre of mass, in the axes of the shape's frame. In the plane the density is a mass per area
/// [kg/m^2].
template <EuclideanSpace S>
struct MassProperties {
  typename S::Scalar mass = 0;                       ///< [kg]
  typename S::Vector center = S::Vector::Zero();     ///< centre of mass in the shape's frame [m]
  typename S::Inertia inertia = S::Inertia::Zero();  ///< A x A, about the centre of mass [kg m^2]

  MassProperties() = default;  ///< no mass, no inertia
  /// @param m       mass [kg]
  /// @param c       centre of mass in the shape's frame [m]
  /// @param about_c inertia, A x A, about the centre of mass [kg m^2]
  MassProperties(typename S::Scalar m, const VectorArgument<S>& c,
                 const typename S::Inertia& about_c)
      : mass(m), center(c), inertia(about_c) {}
  auto serialized_members() { return std::tie(mass, center, inertia); }  ///< see core/serialize.hpp
};

}  // namespace moreau
