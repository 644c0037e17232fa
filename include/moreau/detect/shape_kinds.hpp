// SPDX-License-Identifier: MIT
// Concepts and traits by which overload resolution selects the narrow-phase functions of a pair of
// shapes.
#pragma once

#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// A shape with narrow-phase functions of its own: neither a Rounded nor a OneOf, nor a Compound.
template <class ShapeT>
concept Elementary = !is_rounded<ShapeT> && !is_one_of<ShapeT> && !CompoundShape<ShapeT>;

/// A convex shape of which only the support function is known.
template <class ShapeT>
concept SupportOnly =
    ConvexCore<ShapeT> && Elementary<ShapeT> && !Polytope<ShapeT> && !is_ball<ShapeT>;

/// A pair of elementary shapes that only the general algorithms GJK and EPA can treat
/// (convex/collide_convex.hpp). A sphere or a segment must be the first shape of the pair
/// (collide_rank in collide.hpp).
template <class A, class B>
concept GeneralPair =
    ConvexCore<A> && ConvexCore<B> && Elementary<A> && Elementary<B> && !is_ball<B> &&
    !is_segment<B> && (SupportOnly<A> || SupportOnly<B>);

/// A pair that has a Rounded shape and no OneOf.
template <class A, class B>
concept RoundedPair = !is_one_of<A> && !is_one_of<B> && (is_rounded<A> || is_rounded<B>);

/// A pair with a OneOf. The type of the shape that it holds is known only at run time.
template <class A, class B>
concept MixedPair = is_one_of<A> || is_one_of<B>;

}  // namespace moreau
