// SPDX-License-Identifier: MIT
// facing_features: which faces of two polyhedra, or edges of two polygons, look at each other along
// the axis. Their overlap is the region of contact (contact_polygon.hpp).
//
// A face that makes the axis is taken itself. At an edge or a vertex that makes it, the adjacent
// face is taken that has most vertices near the top of the shape along the axis.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"

namespace moreau::detail {

/// Faces of two polyhedra or edges of two polygons, by their numbers.
struct FacingFeatures {
  std::uint32_t a, b;
};

/// The edge of a polygon that faces the direction: the edge that makes the axis itself; or of the
/// two at the top vertex the one with both ends less than the slab [m] below the top, if there is
/// one such edge, else the one whose normal is more aligned with the direction.
/// @param id  the feature that makes the axis: an edge or the top vertex along the direction
template <std::floating_point T>
std::uint32_t facing_feature(const Placed<Polygon<T>>& shape, FeatureKind kind, std::uint32_t id,
                             const typename Space<2, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto count = static_cast<std::uint32_t>(shape.vertices().size());
  const std::uint32_t before = (id > 0 ? id : count) - 1, after = id + 1 < count ? id + 1 : 0;
  const T height = direction.dot(shape.vertices()[id]) - slab;
  const bool has_before = direction.dot(shape.vertices()[before]) >= height;
  const bool has_after = direction.dot(shape.vertices()[after]) >= height;
  if (has_before != has_after) return has_before ? before : id;
  return direction.dot(shape.normals()[before]) > direction.dot(shape.normals()[id]) ? before : id;
}

/// The candidate whose normal is most aligned with the direction.
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

/// The candidate with the most vertices (three are enough) at or above a height [m] along the
/// direction; among equals the one whose normal is most aligned with the direction.
template <std::floating_point T>
std::uint32_t topmost_face(const Placed<Polyhedron<T>>& shape,
                           std::span<const std::uint32_t> candidates,
                           const typename Space<3, T>::Vector& direction, T height) {
  std::uint32_t best = candidates[0];
  int most = -1;
  T most_aligned = 0;
  for (const std::uint32_t f : candidates) {
    int count = 0;
    for (const std::uint32_t v : shape.shape().face(f))
      if (count < 3 && direction.dot(shape.vertices()[v]) >= height) ++count;
    const T aligned = direction.dot(shape.normals()[f]);
    if (count < most || (count == most && aligned <= most_aligned)) continue;
    best = f;
    most = count;
    most_aligned = aligned;
  }
  return best;
}

/// The face of a polyhedron that faces the direction, at the feature that makes the axis.
/// @param id    the feature: a face, an edge or the top vertex along the direction
/// @param slab  only vertices less than this below the top one can be within the margin [m]
template <std::floating_point T>
std::uint32_t facing_feature(const Placed<Polyhedron<T>>& shape, FeatureKind kind, std::uint32_t id,
                             const typename Space<3, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto height = [&](std::uint32_t v) { return direction.dot(shape.vertices()[v]); };
  const auto choose = [&](std::span<const std::uint32_t> candidates, T top, int own) {
    // If no vertices but those of the feature are that high, all candidates have as many.
    return shape.vertices().count_above(direction, top - slab) <= own
               ? most_aligned(shape, candidates, direction)
               : topmost_face(shape, candidates, direction, top - slab);
  };
  if (kind == FeatureKind::vertex) return choose(shape.shape().vertex_faces(id), height(id), 1);
  const auto& edge = shape.shape().edges()[id];
  return choose(edge.face, std::max(height(edge.vertex[0]), height(edge.vertex[1])), 2);
}

/// The two features whose overlap is the region of contact. Only vertices within margin - gap of
/// the top of a shape can be within the margin of the other shape.
/// @param margin  points up to this gap are in contact [m]
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
