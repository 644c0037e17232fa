// SPDX-License-Identifier: MIT
// What the narrow phase says of a pair (a, b).
//
// Convention, everywhere in the library: the normal is a unit vector in world axes from a to b; a
// gap is the signed distance along it, negative where the shapes overlap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "moreau/core/space.hpp"

namespace moreau {

/// The kind of the features that touch, each pair named once whichever of a and b holds which.
/// Half-spaces count as a face. A sphere counts as a vertex. In the plane an edge of a polygon is
/// an edge: vertex_edge and edge_edge are the regular classes there.
enum class ContactClass : std::uint8_t {
  vertex_vertex,  ///< degenerate
  vertex_edge,    ///< degenerate in space, the simple contact in the plane
  vertex_face,    ///< simple: one point
  edge_edge,      ///< simple in space: one point; in the plane double: two
  edge_face,      ///< double: two points
  face_face,      ///< triple: three points
};

/// The name of a class, as its enumerator is written.
constexpr const char* name(ContactClass c) {
  constexpr const char* names[] = {"vertex_vertex", "vertex_edge", "vertex_face",
                                   "edge_edge",     "edge_face",   "face_face"};
  return names[static_cast<int>(c)];
}

/// Identifies a contact point within its pair from step to step by the features that make it:
/// (vertex of a, face of b), (face of a, vertex of b), (edge of a, edge of b). It does not depend
/// on which of the two faces served as reference of the clipping.
struct FeatureKey {
  /// Of the feature of a, then of b.
  enum class Kind : std::uint8_t {
    vertex_face = 0,    ///< a vertex of a, a face of b
    face_vertex = 1,    ///< a face of a, a vertex of b
    edge_edge = 2,      ///< an edge of each
    vertex_vertex = 3,  ///< a vertex of each
    vertex_edge = 4,    ///< a vertex of a, an edge of b
    edge_vertex = 5     ///< an edge of a, a vertex of b
  };
  std::uint64_t value = 0;  ///< kind, a and b in one number, ordered so

  constexpr FeatureKey() = default;  ///< the least of all: vertex 0, face 0
  /// @param kind of the two features
  /// @param a,b  indices of the feature of a and of b, each below 2^28, which is not checked
  constexpr FeatureKey(Kind kind, std::size_t a, std::size_t b)
      : value(static_cast<std::uint64_t>(kind) << 56 | static_cast<std::uint64_t>(a) << 28 |
              static_cast<std::uint64_t>(b)) {}

  constexpr Kind kind() const { return static_cast<Kind>(value >> 56); }  ///< of the two features
  constexpr std::size_t a() const { return value >> 28 & 0xfffffff; }     ///< index of a's feature
  constexpr std::size_t b() const { return value & 0xfffffff; }           ///< index of b's feature
  /// The same point with the roles of a and b exchanged.
  constexpr FeatureKey swapped() const {
    constexpr Kind other[] = {Kind::face_vertex,   Kind::vertex_face, Kind::edge_edge,
                              Kind::vertex_vertex, Kind::edge_vertex, Kind::vertex_edge};
    return FeatureKey(other[value >> 56], b(), a());
  }
  auto serialized_members() { return std::tie(value); }  ///< see core/serialize.hpp
  friend constexpr auto operator<=>(const FeatureKey&, const FeatureKey&) = default;
};

/// One point of a contact.
template <class S>
struct ManifoldPoint {
  typename S::Vector position;  ///< world axes, midway between the two surfaces [m]
  typename S::Scalar gap;       ///< along the manifold's normal [m], < 0 is penetration
  FeatureKey feature;           ///< what makes it the same point in the next step
};

/// The points where a pair touches or is about to, with one common normal.
/// Reused from pair to pair: clear() keeps the memory.
template <class S>
struct Manifold {
  typename S::Vector normal = S::Vector::Zero();             ///< unit, from a to b, world axes
  typename S::Scalar gap = 0;                                ///< signed distance [m], < 0 overlaps
  ContactClass contact_class = ContactClass::vertex_vertex;  ///< of the features that touch
  std::vector<ManifoldPoint<S>> points;     ///< gap at most the margin; sorted by feature
  std::vector<typename S::Scalar> scratch;  ///< working memory of whoever fills the points

  /// Takes out the points; keeps the memory.
  void clear() { points.clear(); }
  /// Points into the order of their keys.
  void sort() {
    std::sort(points.begin(), points.end(),
              [](const auto& p, const auto& q) { return p.feature < q.feature; });
  }
  /// The manifold of (b, a), made of that of (a, b).
  void swap_sides() {
    normal = -normal;
    for (auto& point : points) point.feature = point.feature.swapped();
    sort();
  }
};

/// The signed distance of a pair. Of shapes that overlap deeply, by a tenth of their size, and one
/// of which is a segment or is known by its support alone, the witnesses may lie beside the
/// surfaces.
template <class S>
struct SignedDistance {
  typename S::Scalar gap;        ///< [m], < 0: the depth of penetration
  typename S::Vector normal;     ///< unit, from a to b, world axes
  typename S::Vector witness_a;  ///< a point of a's surface, world axes [m]
  typename S::Vector witness_b;  ///< of b's surface: witness_a + gap normal, world axes [m]
};

}  // namespace moreau
