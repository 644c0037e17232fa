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

enum class FeatureKind : std::uint8_t { vertex, edge, face };
/// What `Axis::a` counts; for `nearest_points`, a vertex.
constexpr FeatureKind feature_of_a(AxisKind kind) {
  if (kind == AxisKind::face_a) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::edge_vertex;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}
/// What `Axis::b` counts.
constexpr FeatureKind feature_of_b(AxisKind kind) {
  if (kind == AxisKind::face_b) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::vertex_edge;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}

/// The axis that gives a pair's signed gap.
template <class S>
struct Axis {
  typename S::Vector normal = S::Vector::Zero();  ///< unit, from a to b
  typename S::Scalar gap = 0;                     ///< the separation along it [m]
  AxisKind kind = AxisKind::none;
  std::uint32_t a = 0, b = 0;  ///< face, edge or vertex; opposite a face, the deepest vertex
};

}  // namespace moreau::detail
