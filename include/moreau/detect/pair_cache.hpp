// SPDX-License-Identifier: MIT
// The memory of a pair between time steps: the features of two shapes that made their separating
// axis in the last query, a guess at the axis of the next one.
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"

namespace moreau {

namespace detail {

/// The features that make the separating axis of a pair. Edges of polygons count as faces.
enum class AxisKind : std::uint8_t {
  none,            ///< not known
  face_a,          ///< a face of a and the vertex of b that is deepest below it
  face_b,          ///< a face of b and the vertex of a that is deepest below it
  edges,           ///< an edge of each
  vertices,        ///< a vertex of each; the shapes are apart, as in all that follow
  vertex_edge,     ///< a vertex of a, an edge of b
  edge_vertex,     ///< an edge of a, a vertex of b
  nearest_points,  ///< the nearest points of pairs that are so aligned that rounding decides
};

}  // namespace detail

/// What the narrow phase remembers of a pair from one step to the next, to save time. Every answer
/// is the same, bit by bit, with an empty cache or with that of another pair: the features are only
/// a guess, which is proved anew for the present poses before it is used (polytope/prove_axis.hpp).
template <class S>
struct PairCache {
  /// The axis found last, unit, from a to b, world axes; it separated the shapes by more than the
  /// margin if kind is none. Zero if there is none.
  typename S::Vector axis = S::Vector::Zero();
  detail::AxisKind kind = detail::AxisKind::none;  ///< the features that made the axis
  std::uint32_t a = 0;                             ///< number of a's feature
  std::uint32_t b = 0;                             ///< number of b's feature
};

}  // namespace moreau
