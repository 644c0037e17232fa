// SPDX-License-Identifier: MIT
// What the tests of kinds share: small scenes whose answer is known, each in many variants.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

#include "world/assemblies.hpp"

namespace kinds {

using namespace moreau;
using scenes::World;

inline constexpr double pi = std::numbers::pi, weight = 9.81;

template <class ShapeT>
using LawOf = scenes::LawOf<ShapeT>;

/// A scene with gravity and one material.
/// @param size of a grain [m]
template <class ShapeT>
World<ShapeT> world_of(double size, double friction, const typename SpaceOf<ShapeT>::Vector& up) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  World<ShapeT> world(T(size), Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(T(friction))));
  world.set_gravity(T(-weight) * up);
  return world;
}
template <class ShapeT>
inline constexpr bool in_space = SpaceOf<ShapeT>::dim == 3;
template <class ShapeT>
inline constexpr bool is_double = std::is_same_v<typename SpaceOf<ShapeT>::Scalar, double>;
/// @returns the first bound in double precision, the second one in single precision
template <class ShapeT>
constexpr double bound(double in_double, double in_single) {
  return is_double<ShapeT> ? in_double : in_single;
}

/// In space a prism about the last axis with its base in an ellipse, its vertices in random order; in the plane a box.
/// @param half half axes; the last is half the height [m]
template <class ShapeT>
ShapeT prism(int sides, const std::vector<double>& half, std::mt19937& random) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  std::vector<typename SpaceOf<ShapeT>::Vector> corners;
  for (int k = 0; k < sides; ++k)
    for (const double z : {-1.0, 1.0}) {
      const double angle = 2 * pi * (k + 0.5) / sides;
      if constexpr (in_space<ShapeT>)
        corners.push_back(
            {T(half[0] * std::cos(angle)), T(half[1] * std::sin(angle)), T(z * half[2])});
      else if (k < 2)
        corners.push_back({T(k == 0 ? -half[0] : half[0]), T(z * half[1])});
    }
  std::shuffle(corners.begin(), corners.end(), random);
  return ShapeT(std::span<const typename SpaceOf<ShapeT>::Vector>(corners));
}
template <class S>
typename S::Angular about_up(double angle) {
  typename S::Angular w = S::Angular::Zero();
  if constexpr (S::dim == 3) w[2] = typename S::Scalar(angle);
  return w;
}
/// A rotation from the last axis to the normal of a floor.
template <class S>
typename S::Rotation tilt_to(std::mt19937& random, bool tilted) {
  using T = typename S::Scalar;
  if (!tilted) return S::identity();
  std::uniform_real_distribution<double> number(-2, 2);
  typename S::Angular w = S::Angular::Zero();
  for (int k = 0; k < std::min(S::angular_dim, 2); ++k) w[k] = T(number(random));
  return S::exp(w);
}

}  // namespace kinds
