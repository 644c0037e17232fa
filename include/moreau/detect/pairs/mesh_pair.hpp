// SPDX-License-Identifier: MIT
// A convex shape in front of a mesh wall, in the frame of the wall: lengths, and the tests that all kinds of their
// contacts share. Vectors begin at the centre of the shape.
#pragma once

#include <algorithm>
#include <cmath>

#include "moreau/detect/pairs/mesh_core.hpp"
#include "moreau/detect/pairs/mesh_scratch.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau::detail {

/// A convex shape and a mesh wall.
template <class ShapeT>
struct MeshPair {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Wall = MeshWall<S>;

  static constexpr T aligned = T(1e-6);  ///< sine of the largest angle outside of a normal cone [-]

  const MeshCore<ShapeT> core;
  const Wall& wall;
  const Vector center;
  Vector reference;  ///< says on which side of a facet the shape is
  const T radius;    ///< of the rounding around the core [m]
  const T margin;    ///< of the core: how far the facets that decide are from the shape [m]
  const T largest;   ///< gap of the core at a contact, <= margin [m]
  const T rounding;  ///< error of a position [m]
  const T near;      ///< positions closer to each other are the same [m]
  const T beside;  ///< how far beyond a concave ridge, or the end of a ridge, an overlap counts [m]
  MeshScratch& scratch;

  /// @param thickness of the rounding around the core [m]
  /// @param around    how far the facets that decide are from the shape [m]
  /// @param most      largest gap of a contact, <= around [m]
  MeshPair(const Placed<ShapeT>& shape, T thickness, const Wall& mesh, T around, T most,
           MeshScratch& memory)
      : core(shape),
        wall(mesh),
        center(core.center()),
        reference(center),
        radius(thickness),
        margin(around + thickness),
        largest(most + thickness),
        rounding((core.size() + thickness) * DetectionTolerance<T>::rounding),
        near((core.size() + thickness) * DetectionTolerance<T>::coincident),
        beside(std::max(around, core.deepest() / 8)),
        scratch(memory) {}

  /// Height of the centre above the plane of a facet [m].
  T height(const typename Wall::Side& side) const { return side.normal.dot(center) - side.offset; }
  /// Height of the reference point above the plane of a facet [m].
  T reference_height(const typename Wall::Side& side) const {
    return side.normal.dot(reference) - side.offset;
  }
  /// Whether a convex set, of which `nearest` is the point nearest to the centre, may be as near to the core as
  /// `gap`: the plane through this point, perpendicular to its direction, separates the set.
  /// @param nearest relative to the centre [m]
  bool is_within(const Vector& nearest, T gap) {
    const T distance2 = nearest.squaredNorm(), farthest = core.size() + gap;
    if (distance2 > farthest * farthest) return false;
    if (!(distance2 > gap * gap)) return true;
    const T distance = std::sqrt(distance2);
    return distance - reach(nearest / distance) <= gap;
  }
  /// How far the core reaches along a unit vector. Above a flat floor it is often the same vector.
  T reach(const Vector& d) {
    if (d != last_direction_) {
      last_direction_ = d;
      last_reach_ = core.reach(d);
    }
    return last_reach_;
  }
  /// Whether a gap of the core is at most the largest one, and its overlap not deeper than is treated.
  bool is_near(T gap) const { return gap <= largest && gap >= -core.deepest(); }
  /// Whether a contact point x of the shape with a ridge counts: where a face comes down on the ridge, each end
  /// of the line of contact is a point while the gap is small, and not only the lower one, as on a face of the
  /// wall. The shape may reach below the plane through the ridge by 1 % of its width, and by more if x is its
  /// lowest point.
  bool is_low(const Vector& x, T gap, const Vector& d) const {
    return core.reach(-d) <= -d.dot(x) + std::max(near, gap - radius + core.deepest() / 50);
  }
  /// Whether no point of the shape lies below x along d.
  bool is_lowest(const Vector& x, const Vector& d) const {
    return core.reach(-d) <= -d.dot(x) + near;
  }
  /// Whether the motion of the shape that ends the overlap of a contact takes the shape off a point of the wall.
  bool leads_off(const KnownContacts::Contact<Vector>& contact, const Vector& on_wall) const {
    return contact.to_shape.dot(on_wall - contact.x) <= near - contact.gap &&
           is_lowest(contact.x, contact.to_shape);
  }

 private:
  Vector last_direction_ = Vector::Zero();
  T last_reach_ = 0;
};

}  // namespace moreau::detail
