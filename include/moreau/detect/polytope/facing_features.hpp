// SPDX-License-Identifier: MIT
// facing_features: the face of each polyhedron, or the edge of each polygon, that faces the other
// shape along the axis. The overlap of the two faces is the region of contact
// (contact_polygon.hpp).
//
// If a face makes the axis, that face is taken. If an edge or a vertex makes the axis, one of its
// adjacent faces is taken: the face with the most vertices near the top of the shape along the
// axis.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"

namespace moreau::detail {

/// The indices of a face of each polyhedron, or of an edge of each polygon.
struct FacingFeatures {
  std::uint32_t a, b;
};

/// Returns the edge of this polygon that faces the other polygon. `kind` and `id` are this polygon's
/// feature of the separating axis. If the feature is an edge (FeatureKind::face in the plane), this
/// edge is returned. If it is a vertex, one of the two edges at the vertex is returned: the edge of
/// which both ends lie at most `slab` [m] below the vertex, or, if both or neither edge does, the
/// edge whose normal is more aligned with the direction.
/// @param id  index of the feature: an edge, or the top vertex in the direction
template <std::floating_point T>
std::uint32_t facing_feature(const Placed<Polygon<T>>& shape, FeatureKind kind, std::uint32_t id,
                             const typename Space<2, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto [before, after] = neighbours(shape, id);
  const T height = direction.dot(shape.vertices()[id]) - slab;
  const bool has_before = direction.dot(shape.vertices()[before]) >= height;
  const bool has_after = direction.dot(shape.vertices()[after]) >= height;
  if (has_before != has_after) return has_before ? before : id;
  return direction.dot(shape.normals()[before]) > direction.dot(shape.normals()[id]) ? before : id;
}

/// The candidate face whose normal is most aligned with the direction.
template <std::floating_point T>
std::uint32_t most_aligned(const Placed<Polyhedron<T>>& shape,
                           std::span<const std::uint32_t> candidates,
                           const typename Space<3, T>::Vector& direction) {
  std::uint32_t best = candidates[0];
  T most = -2;
  for (const std::uint32_t f : candidates)
    if (const T aligned = direction.dot(shape.normals()[f]); aligned > most) {
      best = f;
      most = aligned;
    }
  return best;
}

/// The candidate face with the most vertices, counted up to three, at or above a height [m] along
/// the direction. Of equal candidates, the face whose normal is most aligned with the direction.
/// @param is_high  function: index of a vertex -> whether it is at or above the height
template <std::floating_point T>
std::uint32_t topmost_face(const Placed<Polyhedron<T>>& shape,
                           std::span<const std::uint32_t> candidates,
                           const typename Space<3, T>::Vector& direction, const auto& is_high) {
  std::uint32_t best = candidates[0];
  int most = -1;
  T most_aligned = 0;
  for (const std::uint32_t f : candidates) {
    int count = 0;
    for (const std::uint32_t v : shape.shape().face(f))
      if (count < 3 && is_high(v)) ++count;
    const T aligned = direction.dot(shape.normals()[f]);
    if (count < most || (count == most && aligned <= most_aligned)) continue;
    best = f;
    most = count;
    most_aligned = aligned;
  }
  return best;
}

/// The face of a polyhedron that faces the direction. It is the feature that makes the axis or is
/// adjacent to it.
/// @param id    index of the feature: a face, an edge, or the top vertex in the direction
/// @param slab  vertices more than this below the top vertex cannot be within the margin [m]
template <std::floating_point T>
std::uint32_t facing_feature(const Placed<Polyhedron<T>>& shape, FeatureKind kind, std::uint32_t id,
                             const typename Space<3, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto height = [&](std::uint32_t v) { return direction.dot(shape.vertices()[v]); };
  const auto choose = [&](std::span<const std::uint32_t> candidates, T top, int own) {
    // If no vertices but those of the feature are that high, all candidates have the same number of
    // high vertices.
    if (shape.vertices().size() <= 64) {
      const std::uint64_t high = shape.vertices().bits_above(direction, top - slab);
      std::uint64_t others = high;
      for (int k = 0; k < own; ++k) others &= others - 1;  // without its lowest bit
      return others == 0 ? most_aligned(shape, candidates, direction)
                         : topmost_face(shape, candidates, direction,
                                        [&](std::uint32_t v) { return (high >> v & 1) != 0; });
    }
    return shape.vertices().count_above(direction, top - slab) <= own
               ? most_aligned(shape, candidates, direction)
               : topmost_face(shape, candidates, direction,
                              [&](std::uint32_t v) { return height(v) >= top - slab; });
  };
  if (kind == FeatureKind::vertex) return choose(shape.shape().vertex_faces(id), height(id), 1);
  const auto& edge = shape.shape().edges()[id];
  return choose(edge.face, std::max(height(edge.vertex[0]), height(edge.vertex[1])), 2);
}

/// The two features whose overlap is the region of contact. Only vertices at most margin - gap
/// below the top of their shape can have a gap of at most the margin.
/// @param margin  largest gap of a contact point [m]
template <class ShapeT>
FacingFeatures facing_features(const PolytopePair<ShapeT>& pair, const Axis<SpaceOf<ShapeT>>& axis,
                               typename SpaceOf<ShapeT>::Scalar margin) {
  using S = SpaceOf<ShapeT>;
  const typename S::Scalar slab = margin - axis.gap + pair.rounding();
  std::uint32_t a = axis.a, b = axis.b;
  if (axis.kind == AxisKind::nearest_points) {
    a = pair.a.vertices().farthest(axis.normal).index;
    b = pair.b.vertices().farthest(-axis.normal).index;
  }
  return {
      facing_feature(pair.a, feature_of_a(axis.kind), a, axis.normal, slab),
      facing_feature(pair.b, feature_of_b(axis.kind), b, typename S::Vector(-axis.normal), slab)};
}

}  // namespace moreau::detail
