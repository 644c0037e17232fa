// SPDX-License-Identifier: MIT
// The separating axis of a pair of polytopes: what find_axis and prove_axis return.
//
// The separation of the shapes A and B along a unit vector n is
//     s(n) = min over b in B of n . b - max over a in A of n . a.
// The signed gap of the pair is the largest s(n) over all n, and the axis is the n that has it. It
// belongs to a pair of features, for example a face of A and the vertex of B that is deepest below
// the face; AxisKind (pair_cache.hpp) says which kinds of features, Axis::a and Axis::b number
// them.
#pragma once

#include <cstdint>
#include <optional>

#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"

namespace moreau::detail {

enum class FeatureKind : std::uint8_t { vertex, edge, face };
/// The kind of feature that `Axis::a` numbers; a vertex for `nearest_points`.
constexpr FeatureKind feature_of_a(AxisKind kind) {
  if (kind == AxisKind::face_a) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::edge_vertex;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}
/// The kind of feature that `Axis::b` numbers.
constexpr FeatureKind feature_of_b(AxisKind kind) {
  if (kind == AxisKind::face_b) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::vertex_edge;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}

/// The axis that gives the signed gap of a pair.
template <class S>
struct Axis {
  typename S::Vector normal = S::Vector::Zero();  ///< unit, from a to b, world axes
  typename S::Scalar gap = 0;                     ///< separation along the normal [m]
  AxisKind kind = AxisKind::none;                 ///< the features that make the axis
  std::uint32_t a = 0;  ///< number of a's face, edge or vertex; opposite a face, the deepest vertex
  std::uint32_t b = 0;  ///< number of b's
};

/// The point of each surface that is nearest to the other shape along an axis, or deepest in it.
template <class S>
struct WitnessPoints {
  typename S::Vector on_a;  ///< relative to the centre of a, world axes [m]
  typename S::Vector on_b;  ///< relative to the centre of a, world axes [m]
  FeatureKey feature;       ///< of the contact point between the two
};

/// The answer of a search for the axis of a pair.
template <class S>
struct FoundAxis {
  Axis<S> axis;
  /// Whether the gap exceeds the margin of the search. The shapes are then separated along
  /// axis.normal by more than the margin; gap and features are not those of the signed gap.
  bool is_beyond = false;
  /// For an axis of kind nearest_points, of which no features are known, the nearest points.
  std::optional<WitnessPoints<S>> nearest = std::nullopt;
};

}  // namespace moreau::detail
