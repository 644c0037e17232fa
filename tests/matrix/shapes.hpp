// SPDX-License-Identifier: MIT
// Every shape of the library, one centimetre wide. check(shapes, size) is called for one shape or a mixture of them;
// size is the diameter of a ball that contains any of them [m].
#pragma once

#include <random>
#include <vector>

#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/support_only.hpp"

namespace matrix {

/// Half the lengths of a cuboid's edges, all different [m].
/// @param middle their mean [m]
template <class S>
typename S::Vector half_lengths(double middle) {
  using T = typename S::Scalar;
  typename S::Vector half = S::Vector::Constant(T(middle));
  half[0] += T(0.0005), half[S::dim - 1] -= T(0.0005);
  return half;
}

template <class S>
void balls(const auto& check) {
  using T = typename S::Scalar;
  check(std::vector{moreau::BallIn<S>(T(0.005))}, T(0.01));
}
template <class S>
void capsules(const auto& check) {
  using T = typename S::Scalar;
  check(std::vector{moreau::CapsuleIn<S>(T(0.0025), T(0.0025))}, T(0.01));
}
/// @tparam Sharp Polygon or Polyhedron
template <class Sharp>
void polytopes(const auto& check) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  check(std::vector{moreau::cuboid<Sharp>(half_lengths<S>(0.0027))}, T(0.01));
}
template <class Sharp>
void rounded(const auto& check) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  check(
      std::vector{moreau::Rounded<Sharp>(moreau::cuboid<Sharp>(half_lengths<S>(0.002)), T(0.001))},
      T(0.01));
}
/// Balls, polytopes and capsules.
template <class Sharp>
void mixtures(const auto& check) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  using Grain = moreau::OneOf<moreau::BallIn<S>, Sharp, moreau::CapsuleIn<S>>;
  check(std::vector<Grain>{moreau::BallIn<S>(T(0.005)),
                           moreau::cuboid<Sharp>(half_lengths<S>(0.0027)),
                           moreau::CapsuleIn<S>(T(0.0025), T(0.0025))},
        T(0.01));
}
/// Polytopes with sharp and with rounded corners.
template <class Sharp>
void sharp_and_rounded(const auto& check) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  using Grain = moreau::OneOf<Sharp, moreau::Rounded<Sharp>>;
  check(std::vector<Grain>{moreau::cuboid<Sharp>(half_lengths<S>(0.0027)),
                           moreau::Rounded<Sharp>(moreau::cuboid<Sharp>(half_lengths<S>(0.0017)),
                                                  T(0.001))},
        T(0.01));
}
/// A shape that is known by its farthest points only.
template <class S>
void support_only(const auto& check) {
  using T = typename S::Scalar;
  using Grain = conformance::SupportOnly<moreau::CapsuleIn<S>>;
  static_assert(moreau::ConvexShape<Grain> && !moreau::HasCircumradius<Grain>);
  check(std::vector{Grain(moreau::CapsuleIn<S>(T(0.0025), T(0.0025)))}, T(0.01));
}
/// Concave stones.
template <class Sharp>
void ballast(const auto& check) {
  using T = typename moreau::SpaceOf<Sharp>::Scalar;
  std::mt19937_64 random(2);
  std::vector<moreau::Compound<Sharp>> grains;
  for (const auto& grain : moreau::ballast_shapes<moreau::Compound<Sharp>>(3, random))
    grains.push_back(grain.scaled(T(0.005)));
  check(grains, T(0.01));
}
template <class S>
void dumbbells(const auto& check) {
  using T = typename S::Scalar;
  using Ball = moreau::BallIn<S>;
  const typename S::Vector x = T(0.0025) * S::Vector::UnitX();
  check(std::vector{moreau::Compound<Ball>({{Ball(T(0.0025)), {x}}, {Ball(T(0.0025)), {-x}}})},
        T(0.01));
}

}  // namespace matrix
