// SPDX-License-Identifier: MIT
// Which functions of the narrow phase a shape is for.
#pragma once

#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// Whether a shape is a Ball or a Disk.
template <class ShapeT>
inline constexpr bool is_sphere = false;
template <class S>
inline constexpr bool is_sphere<BallIn<S>> = true;

/// Whether a shape is a Segment.
template <class ShapeT>
inline constexpr bool is_segment = false;
template <class S>
inline constexpr bool is_segment<Segment<S>> = true;

/// Whether a shape is a Rounded one.
template <class ShapeT>
inline constexpr bool is_rounded = false;
template <class Core>
inline constexpr bool is_rounded<Rounded<Core>> = true;

/// Whether a shape is a OneOf.
template <class ShapeT>
inline constexpr bool is_one_of = false;
template <class... Shapes>
inline constexpr bool is_one_of<OneOf<Shapes...>> = true;

/// Judged for itself, not by what it is made of.
template <class ShapeT>
concept Elementary = !is_rounded<ShapeT> && !is_one_of<ShapeT>;

/// Convex, with nothing known but its support.
template <class ShapeT>
concept SupportOnly =
    ConvexCore<ShapeT> && Elementary<ShapeT> && !Polytope<ShapeT> && !is_sphere<ShapeT>;

/// A pair of elementary shapes that only the general algorithms can judge. Spheres and segments
/// come first, as everywhere.
template <class A, class B>
concept GeneralPair =
    ConvexCore<A> && ConvexCore<B> && Elementary<A> && Elementary<B> && !is_sphere<B> &&
    !is_segment<B> && (SupportOnly<A> || SupportOnly<B>);

/// A pair with a rounded shape.
template <class A, class B>
concept RoundedPair = !is_one_of<A> && !is_one_of<B> && (is_rounded<A> || is_rounded<B>);

/// A pair with a shape that has to be asked which kind it is.
template <class A, class B>
concept MixedPair = is_one_of<A> || is_one_of<B>;

}  // namespace moreau
