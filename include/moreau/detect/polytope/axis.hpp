// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"
#include "moreau/detect/pair_cache.hpp"

namespace moreau::detail {

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
