// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "moreau/core/components.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

namespace detail {

/// A shape that can be constructed from points, as their convex hull.
template <class T>
concept HullOfPoints =
    Polytope<T> && std::constructible_from<T, std::span<const typename T::Space::Vector>>;

}  // namespace detail

/// The simplest grain of each shape: for polyhedra a cube, for polygons a square. With this
/// function a program can change its shape in one line.
/// @param size edge length [m], > 0
/// @throws std::invalid_argument if the size is not finite or not positive
template <detail::HullOfPoints Shape>
Shape regular_shape(typename Shape::Space::Scalar size) {
  using S = SpaceOf<Shape>;
  require_positive(size, "regular_shape", "size");
  std::vector<typename S::Vector> corners(std::size_t{1} << S::dim);
  for (std::size_t bits = 0; bits < corners.size(); ++bits)
    for (int axis = 0; axis < S::dim; ++axis)
      corners[bits][axis] = size * static_cast<typename S::Scalar>(bits >> axis & 1);
  return Shape(std::span<const typename S::Vector>(corners));
}

/// A ball, or in the plane a disk.
/// @param size diameter [m], > 0
/// @throws std::invalid_argument if the size is not finite or not positive
template <class Shape>
requires std::same_as<Shape, BallIn<SpaceOf<Shape>>> Shape
regular_shape(typename Shape::Space::Scalar size) {
  require_positive(size, "regular_shape", "size");
  return Shape(size / 2);
}

/// A cuboid, in the plane a rectangle. Its centre is the origin and its edges are parallel to the axes
/// of the body.
/// @param half_lengths half the length of the edges along each axis [m], D components, > 0
/// @throws std::invalid_argument if a half length is not finite or not positive
template <detail::HullOfPoints Shape>
Shape cuboid(const VectorArgument<SpaceOf<Shape>>& half_lengths) {
  using S = SpaceOf<Shape>;
  for (int axis = 0; axis < S::dim; ++axis)
    require_positive(half_lengths[axis], "cuboid", "half length");
  std::vector<typename S::Vector> corners(std::size_t{1} << S::dim, half_lengths);
  for (std::size_t bits = 0; bits < corners.size(); ++bits)
    for (int axis = 0; axis < S::dim; ++axis)
      if ((bits >> axis & 1) != 0) corners[bits][axis] = -half_lengths[axis];
  return Shape(std::span<const typename S::Vector>(corners));
}

}  // namespace moreau
