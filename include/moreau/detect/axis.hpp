// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"

namespace moreau::detail {

/// What an axis belongs to. Edges of polygons are their faces.
enum class AxisKind : std::uint8_t { face_a, face_b, edges, nearest_points };

/// The axis that gives a pair's signed gap.
template <class S>
struct Axis {
  typename S::Vector normal;  ///< unit, from a to b
  typename S::Scalar gap;     ///< the separation along it [m]
  AxisKind kind;
  std::uint32_t a, b;  ///< face, edge or vertex; opposite a face, the deepest vertex
};

}  // namespace moreau::detail
