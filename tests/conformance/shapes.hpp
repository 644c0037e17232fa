// SPDX-License-Identifier: MIT
// Tests every shape of the library in one space, with one line per shape.
#pragma once

#include <random>
#include <utility>

#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/shape.hpp"
#include "detect/shapes.hpp"

namespace conformance {

template <class S>
void check_all_shapes() {
  using namespace moreau;
  using T = typename S::Scalar;
  std::mt19937_64 random(7);
  const auto grain = samples::grain(S{}, random);
  using Grain = std::remove_const_t<decltype(grain)>;
  const auto check = [](const auto& shape) {
    check_shape(shape);
    check_box_is_tight(shape);
  };
  check(BallIn<S>(T(0.7)));
  check(grain);
  check(CapsuleIn<S>(T(1), T(0.3)));
  check(Rounded<Grain>(grain, T(0.2)));
  check(OneOf<BallIn<S>, Grain>(grain));
}

}  // namespace conformance
