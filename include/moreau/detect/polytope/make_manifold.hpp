// SPDX-License-Identifier: MIT
// The points of contact of two polyhedra, once the axis is known.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "moreau/detect/polytope/contact_class.hpp"
#include "moreau/detect/polytope/contact_polygon.hpp"
#include "moreau/detect/polytope/polyhedron_witness.hpp"
#include "moreau/detect/polytope/projection.hpp"
#include "moreau/detect/polytope/single_contact_point.hpp"

namespace moreau::detail {

/// Of some faces the one that faces the direction most.
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

/// Of the faces at a vertex, the one with most of its vertices (three are enough) at or above the
/// height along the direction; of those the one that faces it most.
template <std::floating_point T>
std::uint32_t facing_face(const Placed<Polyhedron<T>>& shape,
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

/// The face of one shape that looks along the direction at the feature that made the axis.
/// @param id    the feature: a face, an edge or the top vertex along the direction
/// @param slab  only vertices less than this below the top one can be within the margin [m]
template <std::floating_point T>
std::uint32_t facing_face(const Placed<Polyhedron<T>>& shape, FeatureKind kind, std::uint32_t id,
                          const typename Space<3, T>::Vector& direction, T slab) {
  if (kind == FeatureKind::face) return id;
  const auto height = [&](std::uint32_t v) { return direction.dot(shape.vertices()[v]); };
  const auto choose = [&](std::span<const std::uint32_t> candidates, T top, int own) {
    // Where no vertex but the feature's is so high, all candidates have as many.
    return shape.vertices().count_above(direction, top - slab) <= own
               ? most_aligned(shape, candidates, direction)
               : facing_face(shape, candidates, direction, top - slab);
  };
  if (kind == FeatureKind::vertex) return choose(shape.shape().vertex_faces(id), height(id), 1);
  const auto& edge = shape.shape().edges()[id];
  return choose(edge.face, std::max(height(edge.vertex[0]), height(edge.vertex[1])), 2);
}

/// The two faces whose overlap is the region of contact. Only vertices within margin - gap of a
/// shape's support plane can be within the margin of the other shape.
template <std::floating_point T>
std::array<std::uint32_t, 2> facing_faces(const PolyhedronPair<T>& pair,
                                          const Axis<Space<3, T>>& axis, T margin) {
  const T slab = margin - axis.gap + pair.rounding();
  std::uint32_t a = axis.a, b = axis.b;
  if (axis.kind == AxisKind::nearest_points) {
    a = pair.a.vertices().farthest(axis.normal).index;
    b = pair.b.vertices().farthest(-axis.normal).index;
  }
  return {facing_face(pair.a, feature_of_a(axis.kind), a, axis.normal, slab),
          facing_face(pair.b, feature_of_b(axis.kind), b,
                      typename Space<3, T>::Vector(-axis.normal), slab)};
}

/// Whether the witness is a point of both features that make the axis. Of several vertices that are
/// equally deep, or of edges so parallel that they separate wherever they end, one that lies beside
/// the other feature proves nothing.
template <std::floating_point T>
bool is_on_both(const PolyhedronPair<T>& pair, const Axis<Space<3, T>>& axis,
                const Witness<typename Space<3, T>::Vector>& witness) {
  using Vector = typename Space<3, T>::Vector;
  if (axis.kind == AxisKind::face_a) return projects_onto(pair.a, axis.a, witness.b);
  const Vector on_b = witness.b - pair.offset;
  if (axis.kind == AxisKind::face_b)
    return projects_onto(pair.b, axis.b, Vector(witness.a - pair.offset));
  if (axis.kind != AxisKind::edges) return true;
  const T near = pair.size * DetectionTolerance<T>::coincident;
  const T along = std::clamp(fraction_along(pair.b, axis.b, on_b), T(0), T(1));
  return (point_along(pair.b, axis.b, along) - on_b).squaredNorm() <= near * near;
}

/// Midway between the surfaces where they are nearest or deepest, relative to the centre of a.
/// Where the witness does not say it, the polygon in which the faces overlap does.
template <std::floating_point T>
typename Space<3, T>::Vector middle_of_contact(const PolyhedronPair<T>& pair,
                                               const Axis<Space<3, T>>& axis,
                                               const Simplex<T>* simplex) {
  using Vector = typename Space<3, T>::Vector;
  const Witness<Vector> witness = witness_of(pair, axis, simplex);
  Vector middle = T(0.5) * (witness.a + witness.b);
  if (is_on_both(pair, axis, witness)) return middle;
  std::vector<T> scratch;
  const auto [face_a, face_b] = facing_faces(pair, axis, std::max(axis.gap, T(0)));
  const ContactPolygon<T> polygon(pair.a, face_a, pair.b, face_b, pair.offset, axis.normal,
                                  pair.size * DetectionTolerance<T>::coincident, scratch);
  T deepest = std::numeric_limits<T>::infinity();
  polygon.for_each_corner([&](const ManifoldPoint<Space<3, T>>& corner) {
    if (!(corner.gap < deepest)) return;
    deepest = corner.gap;
    middle = corner.position - pair.a.center();
  });
  return middle;
}

/// Whether the overlap of the facing faces has one corner within the slab.
template <std::floating_point T>
bool touches_at_one_corner(const PolyhedronPair<T>& pair, const Axis<Space<3, T>>& axis,
                           std::uint32_t face_a, std::uint32_t face_b, T slab, T near) {
  using Vector = typename Space<3, T>::Vector;
  switch (axis.kind) {
    case AxisKind::face_a:
      return touches_only_at_corner(pair.b, axis.b, face_b, axis.normal, pair.a, face_a,
                                    Vector(pair.b.vertices()[axis.b] + pair.offset), slab, near);
    case AxisKind::face_b:
      return touches_only_at_corner(pair.a, axis.a, face_a, Vector(-axis.normal), pair.b, face_b,
                                    Vector(pair.a.vertices()[axis.a] - pair.offset), slab, near);
    case AxisKind::edges:
      return touches_only_at_crossing(pair, axis, face_a, face_b, slab, near);
    default:
      return false;
  }
}

/// Fills the manifold of a pair whose axis is known.
template <std::floating_point T>
void fill(const PolyhedronPair<T>& pair, const Axis<Space<3, T>>& axis, const Simplex<T>* simplex,
          T margin, Manifold<Space<3, T>>& out) {
  out.clear();
  out.normal = axis.normal;
  out.gap = axis.gap;
  const auto add_witness = [&] {
    const auto witness = witness_of(pair, axis, simplex);
    out.points.push_back(
        {pair.a.center() + T(0.5) * (witness.a + witness.b), axis.gap, witness.feature});
    out.contact_class = class_of_point(witness.feature);
  };
  const T near = pair.size * DetectionTolerance<T>::coincident;
  const T slab = margin - axis.gap + pair.rounding();
  if (touches_only_at_vertex(pair, axis, slab, near)) return add_witness();
  const auto [face_a, face_b] = facing_faces(pair, axis, margin);
  if (touches_at_one_corner(pair, axis, face_a, face_b, slab, near)) return add_witness();
  const ContactPolygon<T> polygon(pair.a, face_a, pair.b, face_b, pair.offset, axis.normal, near,
                                  out.scratch);
  ManifoldPoint<Space<3, T>> deepest{{}, std::numeric_limits<T>::infinity(), FeatureKey()};
  polygon.for_each_corner([&](const ManifoldPoint<Space<3, T>>& corner) {
    if (corner.gap < deepest.gap) deepest = corner;
    if (corner.gap <= margin + pair.rounding()) out.points.push_back(corner);
  });
  // Nearest vertices lie above each other, but no face takes part.
  const bool has_face = axis.kind == AxisKind::face_a || axis.kind == AxisKind::face_b;
  const bool is_degenerate = !has_face && axis.kind != AxisKind::edges && out.points.size() == 1;
  if (is_degenerate) out.points.clear();
  if (is_degenerate || !(deepest.gap <= axis.gap + T(64) * pair.rounding())) {
    // A polygon narrower than what counts as one point may miss the deepest. The witness is that,
    // unless it is beside the face: then the polygon's deepest corner is as near as can be told.
    if (std::isfinite(deepest.gap) && !is_on_both(pair, axis, witness_of(pair, axis, simplex))) {
      if (out.points.empty()) out.points.push_back(deepest);
      for (auto& point : out.points)
        if (point.feature == deepest.feature) point.gap = axis.gap;
    } else {
      add_witness();
    }
  }
  out.sort();
  switch (out.points.size()) {
    case 1:
      out.contact_class = class_of_point(out.points[0].feature);
      break;
    case 2:
      out.contact_class = has_face ? ContactClass::edge_face : ContactClass::edge_edge;
      break;
    default:
      out.contact_class = ContactClass::face_face;
  }
}

}  // namespace moreau::detail
