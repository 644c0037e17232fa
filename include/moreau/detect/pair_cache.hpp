// SPDX-License-Identifier: MIT
// The data that the narrow phase stores of a pair from one time step to the next: the separating axis of the
// last search and the features that define it. They are the first guess of the next query.
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"

namespace moreau {

namespace detail {

/// The kinds of features that make the separating axis of a pair. Edges of polygons count as faces.
enum class AxisKind : std::uint8_t {
  none,         ///< the features are not known
  face_a,       ///< a face of a and the vertex of b that is deepest below it
  face_b,       ///< a face of b and the vertex of a that is deepest below it
  edges,        ///< an edge of a and an edge of b
  vertices,     ///< a vertex of a and a vertex of b; for this kind and those below, the shapes are
                ///< apart
  vertex_edge,  ///< a vertex of a and an edge of b
  edge_vertex,  ///< an edge of a and a vertex of b
  nearest_points,  ///< the nearest points; for pairs so nearly parallel that rounding decides on
                   ///< the features
};

}  // namespace detail

/// The data that the narrow phase stores of a pair from one step to the next, to save time. It is only a
/// guess, which is proved for the present poses before it is used. For two polytopes an empty cache,
/// or the cache of another pair, gives the same results bit by bit (polytope/prove_axis.hpp). For
/// shapes of which only the support function is known, gaps agree to 1e-9 of the size of the shapes
/// (convex/smooth_axis.hpp).
template <class S>
struct PairCache {
  /// The axis that the last search found: a unit vector from a to b, world axes; zero before the
  /// first search. Polytopes: if `kind` is not none, it is the separating axis of the features a and
  /// b; if `kind` is none, a direction along which the shapes were separated by more than the margin.
  typename S::Vector axis = S::Vector::Zero();
  detail::AxisKind kind = detail::AxisKind::none;  ///< the kinds of features that made the axis
  std::uint32_t a = 0;                             ///< index of a's feature
  std::uint32_t b = 0;                             ///< index of b's feature
};

}  // namespace moreau
