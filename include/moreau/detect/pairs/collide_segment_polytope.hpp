// SPDX-License-Identifier: MIT
// A segment, the core of a capsule, against a polyhedron or polygon.
//
// The separating axis and the gap are computed by the general algorithms for convex shapes
// (convex/collide_convex.hpp). They are exact, because both shapes are flat. The contact points are
// the two ends of that part of the segment which lies above the facing face. If neither of them is
// as deep as the gap, the point midway between the nearest points is added.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "moreau/detect/convex/collide_convex.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/contact_polygon.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau {

namespace detail {

/// The part of a segment that lies above a face of a polyhedron, seen along the normal. Each end of
/// this part is stored as a fraction of the segment from its vertex 0, with the edge of the face
/// that the segment crosses there, if any.
template <std::floating_point T>
class SegmentOnFace {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;

  SegmentOnFace(const Placed<Segment<S>>& a, const Placed<Polyhedron<T>>& b, std::uint32_t face,
                const Vector& normal)
      : a_(a), b_(b), face_(face), normal_(normal), offset_(b.center() - a.center()) {}

  /// Cuts the segment at the edges of the face. Call it before for_each_corner.
  /// @param near  a point closer to an edge than this lies on the edge [m]
  void clip(T near) {
    const auto loop = b_.shape().face(face_);
    for (std::size_t k = 0; k < loop.size() && !is_empty(); ++k) {
      const Vector from = b_.vertices()[loop[k]] + offset_;
      const Vector along = b_.vertices()[loop[k + 1 < loop.size() ? k + 1 : 0]] + offset_ - from;
      const Vector inward = along.cross(normal_).normalized();
      lowest_ = std::min(lowest_, normal_.dot(from));
      cut(inward.dot(a_.vertex(0) - from), inward.dot(a_.vertex(1) - from), near, k);
    }
    steepness_ = b_.normals()[face_].dot(normal_);
    if (!(steepness_ < T(-0.1))) ends_[0].fraction = T(2);
  }
  /// Calls use(ManifoldPoint) for each end of the part above the face, or once if the ends
  /// coincide.
  template <class Use>
  void for_each_corner(T near, Use&& use) const {
    if (is_empty()) return;
    use(point(0));
    if ((ends_[1].fraction - ends_[0].fraction) * T(2) * a_.radius() > near) use(point(1));
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  struct End {
    T fraction;
    std::size_t edge;
  };

  bool is_empty() const { return ends_[0].fraction > ends_[1].fraction; }
  /// @param from,to  signed distances of the two vertices from the line of an edge, > 0 inside of
  ///                 the face [m]
  void cut(T from, T to, T near, std::size_t edge) {
    if (from >= -near && to >= -near) return;
    const T fraction = from / (from - to);
    if (from < -near && to < -near)
      ends_[0].fraction = T(2);
    else if (from < -near && fraction > ends_[0].fraction)
      ends_[0] = {fraction, edge};
    else if (to < -near && fraction < ends_[1].fraction)
      ends_[1] = {fraction, edge};
  }
  ManifoldPoint<S> point(std::size_t i) const {
    const Vector x = (T(2) * ends_[i].fraction - T(1)) * a_.half();
    // Up to `near` beyond an edge the plane of a steep face continued would be far deeper than the surface.
    const T gap = std::max((b_.offset(face_) - b_.normals()[face_].dot(x - offset_)) / steepness_,
                           lowest_ - normal_.dot(x));
    const FeatureKey key = ends_[i].edge == none
                               ? FeatureKey(FeatureKey::Kind::vertex_face, i, face_)
                               : FeatureKey(FeatureKey::Kind::edge_edge, 0,
                                            b_.shape().face_edges(face_)[ends_[i].edge]);
    return {a_.center() + (x + gap / 2 * normal_), gap, key};
  }

  const Placed<Segment<S>>& a_;
  const Placed<Polyhedron<T>>& b_;
  const std::size_t face_;
  const Vector normal_, offset_;
  T steepness_ = 0;
  T lowest_ = std::numeric_limits<
      T>::infinity();  // height of the face's vertex nearest to the segment, along the normal [m]
  std::array<End, 2> ends_{End{T(0), none}, End{T(1), none}};
};

/// Adds the contact points with a gap of at most the margin.
/// @returns whether a face makes the contact. In space it is a face of the polyhedron; in the plane
///          it is a side of the polygon or the segment itself
template <std::floating_point T>
bool add_corners(const Placed<Segment<Space<3, T>>>& a, const Placed<Polyhedron<T>>& b,
                 const SignedDistance<Space<3, T>>& found, T margin, T near,
                 Manifold<Space<3, T>>& out) {
  using Vector = typename Space<3, T>::Vector;
  const Vector towards_a = -found.normal;
  const auto face = facing_feature(b, FeatureKind::vertex, b.vertices().farthest(towards_a).index,
                                   towards_a, margin - found.gap);
  SegmentOnFace<T> segment(a, b, face, found.normal);
  segment.clip(near);
  segment.for_each_corner(near, [&](const auto& corner) {
    if (corner.gap <= margin) out.points.push_back(corner);
  });
  return (b.normals()[face] - towards_a).norm() < DetectionTolerance<T>::aligned;
}
template <std::floating_point T>
bool add_corners(const Placed<Segment<Space<2, T>>>& a, const Placed<Polygon<T>>& b,
                 const SignedDistance<Space<2, T>>& found, T margin, T near,
                 Manifold<Space<2, T>>& out) {
  using Vector = typename Space<2, T>::Vector;
  constexpr T aligned = DetectionTolerance<T>::aligned;
  const Vector towards_a = -found.normal, offset = b.center() - a.center();
  const auto edge = facing_feature(b, FeatureKind::vertex, b.vertices().farthest(towards_a).index,
                                   towards_a, margin - found.gap);
  ContactLine<T>(a, 0, b, edge, offset, found.normal, near)
      .for_each_corner([&](const auto& corner) {
        if (corner.gap <= margin) out.points.push_back(corner);
      });
  return (b.normals()[edge] - towards_a).norm() < aligned ||
         std::abs(found.normal.dot(a.half())) < aligned * a.radius();
}

/// The contact point if no face makes the contact: the point midway between the nearest points. Its
/// key has an end of the segment, or the segment itself as edge 0, and the support vertex of the
/// polytope in the direction of the segment.
template <class ShapeT>
ManifoldPoint<SpaceOf<ShapeT>> witness_point(const Placed<Segment<SpaceOf<ShapeT>>>& a,
                                             const Placed<ShapeT>& b,
                                             const SignedDistance<SpaceOf<ShapeT>>& found) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  using Kind = FeatureKey::Kind;
  const T along = (found.witness_a - a.center()).dot(a.half()) / a.half().squaredNorm();
  const bool is_end = std::abs(along) > T(1) - DetectionTolerance<T>::coincident;
  return {(found.witness_a + found.witness_b) / 2, found.gap,
          FeatureKey(is_end ? Kind::vertex_vertex : Kind::edge_vertex, is_end && along > 0 ? 1 : 0,
                     b.vertices().farthest(-found.normal).index)};
}

/// The class of a contact with two points along the segment.
template <std::floating_point T>
constexpr ContactClass class_of_edge(Space<2, T>, bool) {
  return ContactClass::edge_edge;
}
template <std::floating_point T>
constexpr ContactClass class_of_edge(Space<3, T>, bool has_face) {
  return has_face ? ContactClass::edge_face : ContactClass::edge_edge;
}

}  // namespace detail

/// Contact points of a segment and a polytope: two if the segment lies along a face, otherwise one.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Polytope<ShapeT>
bool collide(const Placed<Segment<SpaceOf<ShapeT>>>& a, const Placed<ShapeT>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>&) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  MOREAU_ASSERT(margin >= 0);
  const T size = a.radius() + b.radius(), reach = size + margin;
  if ((b.center() - a.center()).squaredNorm() > reach * reach) return false;
  const auto found = detail::ConvexPair<Segment<S>, ShapeT>(a, b).distance(margin);
  if (!detail::start_if_touching(found, margin, out)) return false;
  const T rounding = size * DetectionTolerance<T>::rounding;
  const bool has_face = detail::add_corners(a, b, found, margin + rounding,
                                            size * DetectionTolerance<T>::coincident, out);
  T deepest = std::numeric_limits<T>::infinity();
  for (const auto& point : out.points) deepest = std::min(deepest, point.gap);
  const bool is_degenerate = !has_face && out.points.size() == 1 &&
                             out.points[0].feature.kind() != FeatureKey::Kind::edge_edge;
  if (is_degenerate) out.points.clear();
  if (is_degenerate || !(deepest <= found.gap + T(64) * rounding))
    out.points.push_back(detail::witness_point(a, b, found));
  out.sort();
  out.contact_class = out.points.size() == 1 ? detail::class_of_point(out.points[0].feature)
                                             : detail::class_of_edge(S{}, has_face);
  return true;
}

}  // namespace moreau
