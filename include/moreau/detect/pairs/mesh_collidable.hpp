// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/detect/shape_kinds.hpp"
#include "moreau/shape/compound.hpp"

namespace moreau {

namespace detail {

/// Whether a shape can touch a mesh wall.
template <class ShapeT>
inline constexpr bool touches_mesh = false;
template <class S>
inline constexpr bool touches_mesh<BallIn<S>> = true;
template <class S>
inline constexpr bool touches_mesh<Segment<S>> = true;
template <class T>
inline constexpr bool touches_mesh<Polygon<T>> = true;
template <class T>
inline constexpr bool touches_mesh<Polyhedron<T>> = true;
template <class Core>
inline constexpr bool touches_mesh<Rounded<Core>> = touches_mesh<Core>;
template <class... Shapes>
inline constexpr bool touches_mesh<OneOf<Shapes...>> = (touches_mesh<Shapes> && ...);
template <class Part>
inline constexpr bool touches_mesh<Compound<Part>> = touches_mesh<Part>;

}  // namespace detail

/// A shape that can touch a mesh wall: balls, polygons, polyhedra, capsules, rounded shapes of these,
/// OneOf and Compound of these.
template <class ShapeT>
concept MeshCollidable = detail::touches_mesh<ShapeT>;

}  // namespace moreau
