// SPDX-License-Identifier: MIT
// Concepts and traits that select the functions of the narrow phase for a pair of shapes.
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

/// A shape with functions of its own: neither rounded nor a OneOf.
template <class ShapeT>
concept Elementary = !is_rounded<ShapeT> && !is_one_of<ShapeT>;

/// A convex shape of which only the support function is known.
template <class ShapeT>
concept SupportOnly =
    ConvexCore<ShapeT> && Elementary<ShapeT> && !Polytope<ShapeT> && !is_sphere<ShapeT>;

/// A pair of elementary shapes for which there are only the general algorithms GJK and EPA
/// (convex/collide_convex.hpp). Spheres and segments come first, see collide_rank.
template <class A, class B>
concept GeneralPair =
    ConvexCore<A> && ConvexCore<B> && Elementary<A> && Elementary<B> && !is_sphere<B> &&
    !is_segment<B> && (SupportOnly<A> || SupportOnly<B>);

/// A pair with a rounded shape and no OneOf.
template <class A, class B>
concept RoundedPair = !is_one_of<A> && !is_one_of<B> && (is_rounded<A> || is_rounded<B>);

/// A pair with a OneOf, the kind of which is known at run time only.
template <class A, class B>
concept MixedPair = is_one_of<A> || is_one_of<B>;

}  // namespace moreau
