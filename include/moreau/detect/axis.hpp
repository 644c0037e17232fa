// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"

namespace moreau::detail {

/// What an axis belongs to. Edges of polygons are their faces.
enum class AxisKind : std::uint8_t {
  none,
  face_a,          ///< a face of a, opposite the deepest vertex of b
  face_b,          ///< the reverse
  edges,           ///< an edge of each
  vertices,        ///< a vertex of each; the shapes are apart, as they are in what follows
  vertex_edge,     ///< a vertex of a, an edge of b
  edge_vertex,     ///< an edge of a, a vertex of b
  nearest_points,  ///< other features, which happen to be where rounding decides
};

/// The axis that gives a pair's signed gap.
template <class S>
struct Axis {
  typename S::Vector normal;  ///< unit, from a to b
  typename S::Scalar gap;     ///< the separation along it [m]
  AxisKind kind;
  std::uint32_t a, b;  ///< face, edge or vertex; opposite a face, the deepest vertex
};

}  // namespace moreau::detail
