// SPDX-License-Identifier: MIT
// make_manifold: computes the contact points of two polytopes from their separating axis.
//
//   1. If a test shows that the pair touches at a single point, the contact point is the witness
//      point of the axis (detail/single_contact_point.hpp, detail/witness_points.hpp).
//   2. Otherwise the contact points are the corners of the contact polygon whose gap is at most the
//      margin. In the plane they are the ends of the contact segment (facing_features.hpp,
//      contact_polygon.hpp). Each contact point has its own gap.
//   3. If no corner of the polygon is as deep as the gap of the axis, the witness point is added.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/core/list.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/polytope/contact_polygon.hpp"
#include "moreau/detect/polytope/detail/single_contact_point.hpp"
#include "moreau/detect/polytope/detail/witness_points.hpp"
#include "moreau/detect/polytope/facing_features.hpp"

namespace moreau::detail {

/// Step 3 for polyhedra. If the contact polygon is narrower than the distance below which two
/// points count as one, it may lack the deepest point. The deepest point is then the witness point.
/// If the witness point does not lie on both features of the separating axis and the polygon has a
/// corner, the deepest corner is used instead, and its gap is set to the signed gap of the pair.
/// @param deepest  the deepest corner of the contact polygon; its gap is infinite if the polygon
///                 has no corners
template <std::floating_point T>
void add_deepest(const PolytopePair<Polyhedron<T>>& pair, const FoundAxis<Space<3, T>>& found,
                 const ManifoldPoint<Space<3, T>>& deepest, Manifold<Space<3, T>>& out) {
  if (!std::isfinite(deepest.gap) || witness_is_on_both(pair, found)) {
    out.points.push_back(witness_point(pair, found));
    return;
  }
  if (out.points.empty()) out.points.push_back(deepest);
  for (auto& point : out.points)
    if (point.feature == deepest.feature) point.gap = found.axis.gap;
}
/// Step 3 for polygons. The witness point is always added, because the contact segment has no width
/// that could be too small.
template <std::floating_point T>
void add_deepest(const PolytopePair<Polygon<T>>& pair, const FoundAxis<Space<2, T>>& found,
                 const ManifoldPoint<Space<2, T>>&, Manifold<Space<2, T>>& out) {
  out.points.push_back(witness_point(pair, found));
}

/// Step 2: adds the corners of the contact polygon.
/// @returns the deepest corner of the polygon; its gap is infinite if the polygon has no corners
template <class ShapeT>
ManifoldPoint<SpaceOf<ShapeT>> take_corners(const PolytopePair<ShapeT>& pair, const auto& polygon,
                                            typename SpaceOf<ShapeT>::Scalar margin,
                                            Manifold<SpaceOf<ShapeT>>& out) {
  using S = SpaceOf<ShapeT>;
  constexpr auto infinity = std::numeric_limits<typename S::Scalar>::infinity();
  ManifoldPoint<S> deepest{S::Vector::Zero(), infinity, FeatureKey()};
  polygon.for_each_corner([&](const ManifoldPoint<S>& corner) {
    if (corner.gap < deepest.gap) deepest = corner;
    if (corner.gap <= margin + pair.rounding()) out.points.push_back(corner);
  });
  return deepest;
}

/// Steps 2 and 3: adds the contact points of the facing features, sorted by feature key.
/// @param look  called with the contact polygon and the gap of its deepest corner [m]
template <class ShapeT>
void add_corners(const PolytopePair<ShapeT>& pair, const FoundAxis<SpaceOf<ShapeT>>& found,
                 const FacingFeatures& facing, typename SpaceOf<ShapeT>::Scalar margin,
                 Manifold<SpaceOf<ShapeT>>& out, const auto& look) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  const Axis<S>& axis = found.axis;
  const auto polygon = contact_polygon(pair, facing, axis.normal, out.scratch);
  const ManifoldPoint<S> deepest = take_corners(pair, polygon, margin, out);
  look(polygon, facing, deepest.gap);
  // Two nearest vertices, or a nearest vertex and edge, lie opposite each other. If they are the
  // only contact point, the point gets the key of these features, not of a face.
  const bool has_face = axis.kind == AxisKind::face_a || axis.kind == AxisKind::face_b;
  const bool is_degenerate = !has_face && axis.kind != AxisKind::edges && out.points.size() == 1;
  if (is_degenerate) out.points.clear();
  if (out.points.empty() || !(deepest.gap <= axis.gap + T(64) * pair.rounding()))
    add_deepest(pair, found, deepest, out);
  out.sort();
}

/// The contact class of a set of contact points.
/// @param has_face  whether a face makes the separating axis
template <std::floating_point T>
ContactClass class_of_points(const List<ManifoldPoint<Space<3, T>>>& points, bool has_face) {
  if (points.size() == 1) return class_of_point(points[0].feature);
  if (points.size() > 2) return ContactClass::face_face;
  return has_face ? ContactClass::edge_face : ContactClass::edge_edge;
}
template <std::floating_point T>
ContactClass class_of_points(const List<ManifoldPoint<Space<2, T>>>& points, bool) {
  return points.size() == 1 ? class_of_point(points[0].feature) : ContactClass::edge_edge;
}

/// Fills the manifold of a pair.
/// @param found   the separating axis of the pair, with a gap of at most the margin
/// @param margin  largest gap of a contact point [m], >= 0
/// @param look    as for add_corners(); not called if the pair touches at one point
template <class ShapeT>
void make_manifold(const PolytopePair<ShapeT>& pair, const FoundAxis<SpaceOf<ShapeT>>& found,
                   typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
                   const auto& look) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  const auto& axis = found.axis;
  out.start(axis.normal, axis.gap);
  const T near = pair.size * DetectionTolerance<T>::coincident;
  const T slab = margin - axis.gap + pair.rounding();
  if (touches_only_at_vertex(pair, axis, slab, near)) {
    out.points.push_back(witness_point(pair, found));
  } else if (const auto facing = facing_features(pair, axis, margin);
             touches_at_one_corner(pair, axis, facing, slab, near)) {
    out.points.push_back(witness_point(pair, found));
  } else {
    add_corners(pair, found, facing, margin, out, look);
  }
  const bool has_face = axis.kind == AxisKind::face_a || axis.kind == AxisKind::face_b;
  out.contact_class = class_of_points(out.points, has_face);
}

template <class ShapeT>
void make_manifold(const PolytopePair<ShapeT>& pair, const FoundAxis<SpaceOf<ShapeT>>& found,
                   typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out) {
  make_manifold(pair, found, margin, out, [](const auto&, const FacingFeatures&, auto) {});
}

/// The point midway between the surfaces where they are nearest or deepest, relative to the centre
/// of a, world axes [m]. It is the witness point or, if the witness point lies beside a feature,
/// the deepest corner of the contact polygon.
template <class ShapeT>
typename SpaceOf<ShapeT>::Vector middle_of_contact(const PolytopePair<ShapeT>& pair,
                                                   const FoundAxis<SpaceOf<ShapeT>>& found) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  typename S::Vector middle = witness_middle(pair, found);
  if (witness_is_on_both(pair, found)) return middle;
  List<T> scratch;
  const auto facing = facing_features(pair, found.axis, std::max(found.axis.gap, T(0)));
  T deepest = std::numeric_limits<T>::infinity();
  contact_polygon(pair, facing, found.axis.normal, scratch)
      .for_each_corner([&](const ManifoldPoint<S>& corner) {
        if (!(corner.gap < deepest)) return;
        deepest = corner.gap;
        middle = corner.position - pair.a.center();
      });
  return middle;
}

}  // namespace moreau::detail
