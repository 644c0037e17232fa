// SPDX-License-Identifier: MIT
// Every shape of the library, in every space it lives in.
#include "detect/shapes.hpp"

#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/sphere.hpp"

#include "conformance/shape.hpp"

using moreau::Capsule;
using moreau::OneOf;
using moreau::Rounded;
using moreau::Space;
using moreau::Sphere;

namespace {

template <class S>
using Polytope = decltype(samples::grain(S{}, std::declval<std::mt19937_64&>()));

template <class S>
void check_all() {
  using T = typename S::Scalar;
  std::mt19937_64 random(7);
  const auto grain = samples::grain(S{}, random);
  conformance::check_shape(Sphere<S>(T(0.7)));
  conformance::check_shape(grain);
  conformance::check_shape(Capsule<S>(T(1), T(0.3)));
  conformance::check_shape(Rounded(grain, T(0.2)));
  conformance::check_shape(OneOf<Sphere<S>, Polytope<S>>(grain));
  conformance::check_shape(OneOf<Sphere<S>, Capsule<S>>(Sphere<S>(T(0.5))));
}

TEST_CASE_TEMPLATE("every shape", S, Space<2>, Space<3>, Space<2, float>, Space<3, float>) {
  check_all<S>();
}

}  // namespace
