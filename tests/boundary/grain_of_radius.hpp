// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "world/assemblies.hpp"

/// A ball of this radius, or the cube (square) inscribed in it.
template <class ShapeT>
ShapeT grain_of_radius(double radius) {
  using Vector = typename moreau::SpaceOf<ShapeT>::Vector;
  if constexpr (std::is_constructible_v<ShapeT, double>)
    return ShapeT(radius);
  else
    return scenes::cuboid<ShapeT>(radius * Vector::Ones().normalized());
}
