// SPDX-License-Identifier: MIT
// The separating axis of a pair of polytopes, as find_axis and prove_axis return it.
//
// The separation of the shapes A and B along a unit vector n is
//     s(n) = min over b in B of n . b - max over a in A of n . a.
// The signed gap of the pair is the largest s(n) over all n. The separating axis is the n with the
// largest s(n). A pair of features makes the axis, for example a face of A and the vertex of B that
// is deepest below the face. AxisKind (pair_cache.hpp) lists the possible kinds of features, and
// Axis::a and Axis::b are the indices of the two features.
#pragma once

#include <cstdint>
#include <optional>

#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"

namespace moreau::detail {

enum class FeatureKind : std::uint8_t { vertex, edge, face };
/// The kind of feature that `Axis::a` is the index of. For `nearest_points` it is a vertex.
constexpr FeatureKind feature_of_a(AxisKind kind) {
  if (kind == AxisKind::face_a) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::edge_vertex;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}
/// The kind of feature that `Axis::b` is the index of. For `nearest_points` it is a vertex.
constexpr FeatureKind feature_of_b(AxisKind kind) {
  if (kind == AxisKind::face_b) return FeatureKind::face;
  const bool is_edge = kind == AxisKind::edges || kind == AxisKind::vertex_edge;
  return is_edge ? FeatureKind::edge : FeatureKind::vertex;
}

/// The axis that gives the signed gap of a pair.
template <class S>
struct Axis {
  typename S::Vector normal = S::Vector::Zero();  ///< unit, from a to b, world axes
  typename S::Scalar gap = 0;                     ///< separation of the shapes along the normal [m]
  AxisKind kind = AxisKind::none;                 ///< the kinds of the features that make the axis
  std::uint32_t a = 0;  ///< index of a's feature; if b's feature is a face, a's feature is the
                        ///< vertex deepest below it
  std::uint32_t b = 0;  ///< index of b's feature; if a's feature is a face, b's feature is the
                        ///< vertex deepest below it
  /// Whether all members are equal, bit by bit.
  friend bool operator==(const Axis& l, const Axis& r) {
    return l.normal == r.normal && l.gap == r.gap && l.kind == r.kind && l.a == r.a && l.b == r.b;
  }
};

/// For each surface, its point nearest to the other shape along an axis; the deepest point if the
/// shapes overlap.
template <class S>
struct WitnessPoints {
  typename S::Vector on_a;  ///< relative to the centre of a, world axes [m]
  typename S::Vector on_b;  ///< relative to the centre of a, world axes [m]
  FeatureKey feature;       ///< the features on which the two points lie
};

/// The result of a search for the axis of a pair.
template <class S>
struct FoundAxis {
  Axis<S> axis;
  /// Whether the gap exceeds the margin of the search. In this case the shapes are separated by
  /// more than the margin along axis.normal, but axis.gap may be smaller than the signed gap, and
  /// the features may be other than those that make the signed gap.
  bool is_beyond = false;
  /// The nearest points. Set only for an axis of kind nearest_points, for which no features are
  /// known.
  std::optional<WitnessPoints<S>> nearest = std::nullopt;
};

}  // namespace moreau::detail
