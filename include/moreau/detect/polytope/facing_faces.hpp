// SPDX-License-Identifier: MIT
// The axis of two polyhedra of which two faces lie on each other, nearly parallel, as those of stacked boxes. The
// proof of a single vertex or edge (prove_axis.hpp) fails there, because several features have nearly the same
// separation. So all features of the two faces are compared, as the full search does, and it is proved that no
// other feature matters.
//
// Let n be the normal of a's face f, s <= 0 the largest separation of the features of the two faces, and
// d = -s. In directions perpendicular to n, C = B - A contains the polygon P of all differences between a point of
// b's face g and a point of f. All points of P have a height along n of at most h, the height of the highest vertex
// of g above the plane of f. If the origin, seen along n, lies in P at a distance of at least r from its rim, then
// for every m at an angle theta from n
//     F(m) <= h cos theta - r sin theta <= s + (h - s) + d (1 - cos theta) - r sin theta.
// This is the first bound of prove_axis.hpp with h - s + doubt in place of doubt. So no axis at an angle larger
// than 2 (h - s + doubt) / (r - d tau_0) separates by s - doubt. The features that can make an axis at a smaller
// angle have their vertices near the top of their shape along n, and it is required that these are vertices of f
// and g. So they are f, g and the edges of f and g.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "moreau/detect/polytope/detail/face_edge_search.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/detect/polytope/prove_axis.hpp"

namespace moreau::detail {

template <std::floating_point T>
class FacingFaces {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polyhedron<T>>;
  using Loop = std::span<const std::uint32_t>;

  /// @param features that made the axis in the previous step; features of another pair are allowed
  FacingFaces(const PolytopePair<Polyhedron<T>>& pair, const PairCache<S>& features)
      : pair_(pair),
        face_a_(face_of(pair.a, feature_of_a(features.kind), features.a, features.axis)),
        face_b_(face_of(pair.b, feature_of_b(features.kind), features.b, Vector(-features.axis))),
        loop_a_(pair.a.shape().face(face_a_)),
        loop_b_(pair.b.shape().face(face_b_)),
        normal_(pair.a.normals()[face_a_]) {}

  /// Whether the proof can be tried: the faces are nearly parallel, and the shapes are small.
  bool are_facing() const {
    return normal_.dot(pair_.b.normals()[face_b_]) < T(-0.9992) && loop_a_.size() <= most &&
           loop_b_.size() <= most && pair_.a.vertices().size() <= 64 &&
           pair_.b.vertices().size() <= 64;
  }
  /// The axis, if it is proved that the full search would find it.
  std::optional<Axis<S>> prove() const {
    PointSet<T> none_a, none_b;
    FaceEdgeSearch<T> search(pair_, none_a, none_b, std::numeric_limits<T>::infinity());
    const ShortList edges_a = edges_of(pair_.a, face_a_), edges_b = edges_of(pair_.b, face_b_);
    search.search_facing(face_a_, edges_a, face_b_, edges_b);
    const Axis<S>& axis = search.axis();
    if (!(axis.gap <= T(0))) return std::nullopt;
    const T inside = distance_from_rim();
    if (!(inside > T(0))) return std::nullopt;
    const T angle = excluded_beyond(pair_, along_normal(axis.gap), inside, spread(axis.gap));
    if (!std::isfinite(angle) || !has_only(pair_.a, loop_a_, normal_, angle) ||
        !has_only(pair_.b, loop_b_, Vector(-normal_), angle))
      return std::nullopt;
    return axis;
  }

 private:
  static constexpr std::size_t most = 16;  // vertices of a face

  /// The face that faces the direction: the feature itself, or the face at it whose normal is most aligned.
  static std::uint32_t face_of(const Shape& shape, FeatureKind kind, std::uint32_t id,
                               const Vector& direction) {
    if (kind == FeatureKind::face) return id;
    if (kind == FeatureKind::vertex)
      return most_aligned(shape, shape.shape().vertex_faces(id), direction);
    return most_aligned(shape, shape.shape().edges()[id].face, direction);
  }
  /// The edges of a face, ascending, in the order in which the full search takes them.
  static ShortList edges_of(const Shape& shape, std::uint32_t face) {
    std::array<std::uint32_t, most> sorted;
    const auto own = shape.shape().face_edges(face);
    const auto end = std::copy(own.begin(), own.end(), sorted.begin());
    std::sort(sorted.begin(), end);
    ShortList edges(shape.shape().edges().size());
    for (auto it = sorted.begin(); it != end; ++it) edges.add(*it);
    return edges;
  }
  Axis<S> along_normal(T gap) const {
    Axis<S> axis;
    axis.normal = normal_;
    axis.gap = gap;
    return axis;
  }
  /// h - s [m].
  T spread(T gap) const {
    T highest = -std::numeric_limits<T>::infinity();
    for (const std::uint32_t v : loop_b_)
      highest = std::max(
          highest, height_above(pair_.a, face_a_, Vector(pair_.b.vertices()[v] + pair_.offset)));
    return std::max(highest - gap, T(0));
  }
  /// The distance r [m]; not positive if the origin does not lie in P. The edges of P are those of the two faces.
  T distance_from_rim() const {
    return std::min(distance_along(pair_.a, loop_a_, normal_, pair_.b, loop_b_, pair_.offset),
                    distance_along(pair_.b, loop_b_, Vector(-normal_), pair_.a, loop_a_,
                                   Vector(-pair_.offset)));
  }
  /// The smallest depth of the face `other` behind the edges of the face `own`, whose vertices are
  /// counter-clockwise about `up`, in directions perpendicular to `up`.
  static T distance_along(const Shape& own, Loop loop, const Vector& up, const Shape& other,
                          Loop other_loop, const Vector& offset) {
    T least = std::numeric_limits<T>::infinity();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector from = own.vertices()[loop[k]];
      const Vector along = own.vertices()[loop[k + 1 < loop.size() ? k + 1 : 0]] - from;
      const Vector inward = up.cross(along);
      T deepest = -std::numeric_limits<T>::infinity();
      for (const std::uint32_t v : other_loop)
        deepest = std::max(deepest, inward.dot(other.vertices()[v] + offset - from));
      if (!(deepest > T(0))) return T(0);
      least = std::min(least, deepest * deepest / inward.squaredNorm());
    }
    return std::sqrt(least);
  }
  /// Whether all vertices near the top of a shape, as count_top counts them, are vertices of the face.
  static bool has_only(const Shape& shape, Loop loop, const Vector& direction, T angle) {
    std::uint64_t of_face = 0;
    for (const std::uint32_t v : loop) of_face |= std::uint64_t{1} << v;
    const T lowest = shape.vertices().reach(direction) - T(2) * angle * shape.radius();
    return (shape.vertices().bits_above(direction, lowest) & ~of_face) == 0;
  }

  const PolytopePair<Polyhedron<T>>& pair_;
  const std::uint32_t face_a_, face_b_;
  const Loop loop_a_, loop_b_;
  const Vector normal_;
};

/// The axis of two polyhedra of which two faces lie on each other, if it is proved that find_axis would find it. It
/// then equals the result of find_axis bit by bit.
/// @param features of the axis in the previous step; features of another pair are allowed
template <std::floating_point T>
std::optional<Axis<Space<3, T>>> prove_facing(const PolytopePair<Polyhedron<T>>& pair,
                                              const PairCache<Space<3, T>>& features) {
  const bool overlapped = features.kind == AxisKind::face_a || features.kind == AxisKind::face_b ||
                          features.kind == AxisKind::edges;
  if (!overlapped || !has_feature(pair.a, feature_of_a(features.kind), features.a) ||
      !has_feature(pair.b, feature_of_b(features.kind), features.b))
    return std::nullopt;
  const FacingFaces<T> faces(pair, features);
  return faces.are_facing() ? faces.prove() : std::nullopt;
}
/// Polygons: the full search is as fast.
template <std::floating_point T>
std::optional<Axis<Space<2, T>>> prove_facing(const PolytopePair<Polygon<T>>&,
                                              const PairCache<Space<2, T>>&) {
  return std::nullopt;
}

}  // namespace moreau::detail
