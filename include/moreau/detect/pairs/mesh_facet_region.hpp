// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/detect/pairs/mesh_neighbours.hpp"
#include "moreau/detect/pairs/nearest_on_facet.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau::detail {

/// Whether the segment from one point to another passes a facet of a mesh wall, from the front to the back.
/// @param near lengths below it count as 0 [m]
template <class S>
bool goes_through(const MeshWall<S>& wall, std::uint32_t f, const typename S::Vector& from,
                  const typename S::Vector& to, typename S::Scalar near) {
  const auto& side = wall.side(f);
  const auto above = side.normal.dot(from) - side.offset, below = side.normal.dot(to) - side.offset;
  if (!(above > 0 && below < 0)) return false;
  const typename S::Vector at_plane = from + above / (above - below) * (to - from);
  for (std::size_t c = 0; c < side.inward.size(); ++c)
    if (side.inward[c].dot(at_plane) < side.inward_offset[c] - near) return false;
  return true;
}

/// The vertices of a shape that touch a facet of a mesh wall.
///
///   1. A vertex touches a facet onto which it projects.
///   2. Beyond a concave ridge, of whose two facets the shape is in front, a vertex touches the facet,
///      too, if it lies behind the surface: at two half-spaces it would touch both. It is not deeper
///      below the facet than it is behind the nearest point of the surface, and it lies beside the facet
///      and below it by at most `beside`.
///   3. A vertex below a facet does not touch it if it is nearer to the other facet of a convex ridge,
///      out of which it would be pushed.
///   4. A vertex below a facet does not touch it if it came around it: if the segment from the centre of
///      the shape to the vertex passes the face beyond a rim, beyond a concave ridge behind whose other
///      facet the centre is, or beyond a convex ridge to whose other facet the vertex is nearer; and if the
///      segment ends in front of the surface, as from a centre beside a thin wall to a vertex on the same side.
///
/// Each of 2, 3 and 4 looks at one facet and its neighbours: of a vertex that is deep below a floor of small
/// facets each facet can say that another has it. Therefore a vertex that no facet has, although the way
/// from the centre of the shape to it ends behind the surface, touches the nearest facets in front of
/// which the centre is; see passes() and touches_nearest().
template <class S>
struct FacetRegion {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Wall = MeshWall<S>;

  const Wall& wall;
  std::span<const NearFacet> facets;  ///< with boxes within the margin of the box of the shape
  const Vector& center;  ///< of the shape, or a point beside it in front of the wall [m]
  T size;                ///< of the shape around its centre [m]
  T near;                ///< lengths below it count as 0 [m]
  T beside;              ///< see above [m]

  /// Whether a vertex of the shape touches a facet.
  /// @param gap of the vertex above the plane of the facet [m]
  bool holds(const NearFacet& facet, const Vector& x, T gap) const {
    const auto& side = wall.side(facet.place);
    T inside = std::numeric_limits<T>::infinity();
    for (std::size_t c = 0; c < side.inward.size(); ++c) {
      const T from_ridge = side.inward[c].dot(x) - side.inward_offset[c];
      if (from_ridge < -near && (!facet.has_concave || !is_beside(facet.place, c, from_ridge)))
        return false;
      inside = std::min(inside, from_ridge);
    }
    if (inside < -near && (gap < -beside || std::max(-gap, T(0)) > depth(facet.place, x) + near))
      return false;
    if (gap >= 0) return true;
    if (is_nearer_to_another(side, facet.place, x, gap)) return false;
    if (gap >= -near) return true;
    // The segment to the centre moves aside by at most size |gap| / (height of the centre - gap).
    const T height = height_above(side, center);
    return inside * (height - gap) > -gap * size ||
           (!came_around(facet.place, x, gap, height) && is_behind(x));
  }
  /// Whether a point is beyond a rim of a facet.
  bool is_beyond_rim(std::uint32_t f, const Vector& x) const {
    const Side& side = wall.side(f);
    bool is = false;
    for (std::size_t c = 0; c < side.inward.size(); ++c)
      is = is || (wall.neighbour(f, c) == Wall::none &&
                  side.inward[c].dot(x) < side.inward_offset[c] - near);
    return is;
  }
  /// Whether the segment from the centre to a point passes a facet, from the front to the back.
  bool passes(std::uint32_t f, const Vector& x) const { return goes_through(f, center, x); }
  /// Calls use(facet, gap) for the facets nearest to a point that lies below them, if the segment from the
  /// centre to it leaves the surface behind.
  /// @param use with the number of the facet and the height of the point above its plane [m], < 0
  template <class Use>
  void touches_nearest(const Vector& x, const Use& use) const {
    if (!is_behind(x)) return;
    T least = std::numeric_limits<T>::infinity();
    const auto find = [&](std::uint32_t f, T) {
      least = std::min(least, std::sqrt(distance2(f, x)));
    };
    for_each_over(x, find);
    for_each_over(x, [&](std::uint32_t f, T gap) {
      if (std::sqrt(distance2(f, x)) <= least + near) use(f, gap);
    });
  }

 private:
  using Side = typename Wall::Side;

  static T height_above(const Side& side, const Vector& x) {
    return side.normal.dot(x) - side.offset;
  }
  bool goes_through(std::uint32_t f, const Vector& from, const Vector& to) const {
    return detail::goes_through(wall, f, from, to, near);
  }
  /// Whether the segment from the centre to a point goes through the surface once more inwards than
  /// outwards. A surface with two sides has each facet twice: of it the inwards alone count.
  bool is_behind(const Vector& x) const {
    int inwards = 0;
    for (const NearFacet& facet : facets) {
      inwards += goes_through(facet.place, center, x);
      if (wall.sides() == WallSides::outside) inwards -= goes_through(facet.place, x, center);
    }
    return inwards > 0;
  }
  /// Calls use(facet, gap) for the facets with the centre in front and a point behind.
  template <class Use>
  void for_each_over(const Vector& x, const Use& use) const {
    for (const NearFacet& facet : facets) {
      const T gap = height_above(wall.side(facet.place), x);
      if (gap < -near && height_above(wall.side(facet.place), center) > 0) use(facet.place, gap);
    }
  }
  /// Whether a point below a facet would be pushed out of a facet that joins it.
  bool is_nearer_to_another(const Side& side, std::uint32_t f, const Vector& x, T gap) const {
    for (const std::uint32_t r : side.ridge) {
      if (r == Wall::none) continue;
      const auto& pair = wall.ridge(r).facet;
      const Side& other = wall.side(pair[0] == f ? pair[1] : pair[0]);
      if (pair[0] == pair[1] || other.normal.dot(side.normal) < T(-0.99)) continue;  // a rim
      if (is_nearer(other, x, gap)) return true;
    }
    return false;
  }
  /// Whether a point is in front of a facet, or less deep behind it than another, and the shape is in
  /// front of it.
  bool is_nearer(const Side& other, const Vector& x, T gap) const {
    const T above = height_above(other, x);
    return above > near || (above > gap + near && height_above(other, center) > 0);
  }
  /// Whether a vertex lies little beyond a concave ridge, in front of whose other facet the shape is.
  bool is_beside(std::uint32_t f, std::size_t c, T from_ridge) const {
    return from_ridge >= -beside && wall.is_concave(f, c) &&
           height_above(wall.side(wall.neighbour(f, c)), center) > 0;
  }
  /// Distance of a point behind the surface near a facet, < 0 in front of it and beyond its rim [m]. Of
  /// several facets that are nearest, the one that the point sees under the largest angle says on which
  /// side it is.
  T depth(std::uint32_t f, const Vector& x) const {
    T least = std::sqrt(distance2(f, x)), height = height_above(wall.side(f), x);
    bool is_beyond = is_beyond_rim(f, x);
    for (const NearFacet& facet : facets) {
      const auto& box = wall.box(facet.place);
      if (!box.inflated(least + near).contains(x)) continue;
      const Side& side = wall.side(facet.place);
      // A thin wall has two surfaces: the one counts in front of which the shape is.
      if (wall.sides() == WallSides::both && !(height_above(side, center) > 0)) continue;
      const T distance = std::sqrt(distance2(facet.place, x)), above = height_above(side, x);
      if (distance > least + near) continue;
      if (distance < least - near || std::abs(above) > std::abs(height)) height = above;
      is_beyond = (is_beyond && distance >= least - near) || is_beyond_rim(facet.place, x);
      least = std::min(least, distance);
    }
    return is_beyond || height > 0 ? -least : least;
  }
  T distance2(std::uint32_t f, const Vector& x) const {
    return nearest_on_facet(typename S::Matrix(wall.side(f).corners.colwise() - x)).squaredNorm();
  }
  /// Whether the segment from a vertex below a facet to the centre passes beyond the surface; see 4. From
  /// facet to facet it follows the segment, until a facet has its point in the plane of this facet.
  bool came_around(std::uint32_t f, const Vector& x, T gap, T height) const {
    Vector at_plane = x - gap / (height - gap) * (center - x);
    for (std::size_t count = 0; count <= wall.size(); ++count) {
      const Side& side = wall.side(f);
      const std::size_t exit = exit_of(side, x, at_plane);
      if (exit == side.inward.size()) return false;
      f = wall.neighbour(f, exit);
      if (f == Wall::none) return true;
      const Side& next = wall.side(f);
      if (next.face == side.face) continue;
      if (side.ridge[exit] != Wall::none) return is_nearer(next, x, gap);
      const T to = height_above(next, center), from = height_above(next, x);
      if (!(to > 0)) return true;
      if (!(from < 0)) return false;
      at_plane = x - from / (to - from) * (center - x);
    }
    return false;
  }
  /// The ridge beyond which the way from x to a point of the plane first leaves a facet, by its corner; if
  /// it ends on the facet, the number of corners.
  std::size_t exit_of(const Side& side, const Vector& x, const Vector& end) const {
    std::size_t exit = side.inward.size();
    T first = std::numeric_limits<T>::infinity();
    for (std::size_t c = 0; c < side.inward.size(); ++c) {
      const T from = side.inward[c].dot(x) - side.inward_offset[c];
      const T to = side.inward[c].dot(end) - side.inward_offset[c];
      if (to >= -near || to >= from || !(from / (from - to) < first)) continue;
      first = from / (from - to);
      exit = c;
    }
    return exit;
  }
};

}  // namespace moreau::detail
