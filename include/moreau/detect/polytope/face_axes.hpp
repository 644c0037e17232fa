// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"

namespace moreau::detail {

/// Calls use(axis) for the axis of each face of a and of b.
template <class ShapeT>
void for_each_face_axis(const PolytopePair<ShapeT>& pair, const auto& use) {
  for (std::uint32_t f = 0; f < pair.a.normals().size(); ++f) use(axis_of_face_a(pair, f));
  for (std::uint32_t f = 0; f < pair.b.normals().size(); ++f) use(axis_of_face_b(pair, f));
}

}  // namespace moreau::detail
