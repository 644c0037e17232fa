// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/core/space.hpp"

namespace moreau {

namespace detail {

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

}  // namespace detail

/// What the narrow phase remembers of a pair from one step to the next. It saves time and nothing
/// else: every answer is the same with an empty one, or with one that belongs to another pair,
/// because what it holds is only a guess that is proved anew each time
/// (polytope/detail/local_proof.hpp).
template <class S>
struct PairCache {
  /// The axis, unit, from a to b, world axes, that separated the pair last time; zero if none did.
  typename S::Vector axis = S::Vector::Zero();
  /// The features that made the axis last time.
  detail::AxisKind kind = detail::AxisKind::none;
  std::uint32_t a = 0;  ///< index of a's
  std::uint32_t b = 0;  ///< index of b's

  /// Keeps a detail::Axis for the next query.
  void remember(const auto& found) {
    axis = found.normal;
    kind = found.kind;
    a = found.a;
    b = found.b;
  }
};

}  // namespace moreau
