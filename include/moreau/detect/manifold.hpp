// SPDX-License-Identifier: MIT
// The results of the narrow phase for a pair of shapes (a, b): contact points with a common normal
// (Manifold), or the signed distance with the nearest points (SignedDistance).
//
// Convention, everywhere in the library: the normal is a unit vector in world axes from a to b. A
// gap is the signed distance along the normal [m], negative where the shapes overlap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// The kinds of the two features that touch, regardless of which feature belongs to which shape. A
/// half-space counts as a face, a sphere as a vertex. In the plane, a side of a polygon counts as
/// an edge. So in the plane vertex_edge and edge_edge are the regular classes.
enum class ContactClass : std::uint8_t {
  vertex_vertex,  ///< degenerate
  vertex_edge,    ///< degenerate in space; in the plane simple: one point
  vertex_face,    ///< simple: one point
  edge_edge,      ///< in space simple: one point; in the plane double: two points
  edge_face,      ///< double: two points
  face_face,      ///< triple: three points and more; with ContactPoints::few at most D
};

/// The name of a class, as its enumerator is written.
constexpr const char* name(ContactClass c) {
  constexpr const char* names[] = {"vertex_vertex", "vertex_edge", "vertex_face",
                                   "edge_edge",     "edge_face",   "face_face"};
  return names[static_cast<int>(c)];
}

/// Identifies a contact point of a pair from step to step by the two features that make the point,
/// for example a vertex of a and a face of b.
struct FeatureKey {
  /// The kind of a's feature, followed by the kind of b's feature.
  enum class Kind : std::uint8_t {
    vertex_face = 0,    ///< a vertex of a, a face of b
    face_vertex = 1,    ///< a face of a, a vertex of b
    edge_edge = 2,      ///< an edge of each
    vertex_vertex = 3,  ///< a vertex of each
    vertex_edge = 4,    ///< a vertex of a, an edge of b
    edge_vertex = 5     ///< an edge of a, a vertex of b
  };
  std::uint64_t value = 0;  ///< kind, a and b packed into one number; keys are ordered by kind,
                            ///< then a, then b

  constexpr FeatureKey() = default;  ///< the smallest key: vertex 0 of a, face 0 of b
  /// @param kind of the two features
  /// @param a,b  indices of the feature of a and of b, each below 2^28, which is not checked
  constexpr FeatureKey(Kind kind, std::size_t a, std::size_t b)
      : value(static_cast<std::uint64_t>(kind) << 56 | static_cast<std::uint64_t>(a) << 28 |
              static_cast<std::uint64_t>(b)) {}

  /// The kinds of the two features.
  constexpr Kind kind() const { return static_cast<Kind>(value >> 56); }
  constexpr std::size_t a() const { return value >> 28 & 0xfffffff; }  ///< index of a's feature
  constexpr std::size_t b() const { return value & 0xfffffff; }        ///< index of b's feature
  /// The key of the same point after the shapes a and b have exchanged their roles.
  constexpr FeatureKey swapped() const {
    constexpr Kind other[] = {Kind::face_vertex,   Kind::vertex_face, Kind::edge_edge,
                              Kind::vertex_vertex, Kind::edge_vertex, Kind::vertex_edge};
    return FeatureKey(other[value >> 56], b(), a());
  }
  auto serialized_members() { return std::tie(value); }  ///< see core/serialize.hpp
  friend constexpr auto operator<=>(const FeatureKey&, const FeatureKey&) = default;
};

namespace detail {

/// The class of a contact of one point.
constexpr ContactClass class_of_point(FeatureKey feature) {
  switch (feature.kind()) {
    case FeatureKey::Kind::vertex_vertex:
      return ContactClass::vertex_vertex;
    case FeatureKey::Kind::vertex_edge:
    case FeatureKey::Kind::edge_vertex:
      return ContactClass::vertex_edge;
    case FeatureKey::Kind::edge_edge:
      return ContactClass::edge_edge;
    default:
      return ContactClass::vertex_face;
  }
}

/// The kind of the key for a vertex of a on a face of b. In the plane the faces are called edges.
template <std::floating_point T>
constexpr FeatureKey::Kind vertex_on_face(Space<2, T>) {
  return FeatureKey::Kind::vertex_edge;
}
template <std::floating_point T>
constexpr FeatureKey::Kind vertex_on_face(Space<3, T>) {
  return FeatureKey::Kind::vertex_face;
}

}  // namespace detail

/// One point of a contact.
template <class S>
struct ManifoldPoint {
  typename S::Vector position;  ///< world axes, midway between the two surfaces [m]
  typename S::Scalar gap;  ///< signed gap along the manifold's normal [m]; < 0 means penetration
  FeatureKey feature;      ///< the features that make the point
};

/// The points at which a pair of shapes touches or has a gap of at most the margin, with one common
/// normal. Reuse one object for many pairs: clear() keeps its memory.
template <class S>
struct Manifold {
  typename S::Vector normal = S::Vector::Zero();             ///< unit, from a to b, world axes
  typename S::Scalar gap = 0;                                ///< signed gap of the pair [m]
  ContactClass contact_class = ContactClass::vertex_vertex;  ///< of the features that touch
  std::uint32_t part_a = 0;          ///< for a Compound: the part of a that touches, else 0
  std::uint32_t part_b = 0;          ///< for a Compound: the part of b that touches, else 0
  List<ManifoldPoint<S>> points;     ///< points with a gap of at most the margin, sorted by
                                     ///< feature
  List<typename S::Scalar> scratch;  ///< working memory of the function that fills the
                                     ///< manifold

  /// Removes the points; keeps the memory.
  void clear() { points.clear(); }
  /// Sets normal and gap and removes the points.
  void start(const typename S::Vector& new_normal, typename S::Scalar new_gap) {
    clear();
    normal = new_normal;
    gap = new_gap;
  }
  /// Makes this the manifold of a contact with one point.
  /// @param position  midway between the two surfaces, world axes [m]
  void set_single_point(const typename S::Vector& new_normal, typename S::Scalar new_gap,
                        const typename S::Vector& position, FeatureKey feature) {
    start(new_normal, new_gap);
    contact_class = detail::class_of_point(feature);
    points.push_back({position, new_gap, feature});
  }
  /// Sorts the points by feature.
  void sort() {
    sort_items(points, [](const auto& p, const auto& q) { return p.feature < q.feature; });
  }
  /// Turns the manifold of the pair (a, b) into the manifold of the pair (b, a).
  void swap_sides() {
    normal = -normal;
    std::swap(part_a, part_b);
    for (auto& point : points) point.feature = point.feature.swapped();
    sort();
  }
};

/// The signed distance of a pair. The witness points may lie off the surfaces if the shapes overlap
/// by a tenth of their size or more and one of the shapes is a segment or a shape of which only the
/// support function is known.
template <class S>
struct [[nodiscard]] SignedDistance {
  typename S::Scalar gap;        ///< signed gap [m]; if < 0, minus the depth of penetration
  typename S::Vector normal;     ///< unit, from a to b, world axes
  typename S::Vector witness_a;  ///< point of a's surface nearest to b or deepest in b, world axes
                                 ///< [m]
  typename S::Vector witness_b;  ///< witness_a + gap normal, on b's surface, world axes [m]
};

namespace detail {

/// Starts the manifold of a pair, without points, if the gap is at most the margin [m].
/// @returns whether the gap is at most the margin
template <class S>
bool start_if_touching(const SignedDistance<S>& found, typename S::Scalar margin,
                       Manifold<S>& out) {
  if (!(found.gap <= margin)) return false;
  out.start(found.normal, found.gap);
  return true;
}
/// Fills the manifold of a pair that touches at one point, midway between the witness points.
/// @param out  filled if the gap is at most the margin [m], unchanged otherwise
/// @returns whether the gap is at most the margin
template <class S>
bool touch_at_one_point(const SignedDistance<S>& found, typename S::Scalar margin,
                        FeatureKey feature, Manifold<S>& out) {
  if (!(found.gap <= margin)) return false;
  out.set_single_point(found.normal, found.gap, (found.witness_a + found.witness_b) / 2, feature);
  return true;
}

}  // namespace detail

}  // namespace moreau
