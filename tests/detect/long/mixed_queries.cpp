// SPDX-License-Identifier: MIT
// All pairs of types of shapes, in both orders. The shape types are chosen at run time (OneOf).
#include "detect/queries.hpp"

using namespace queries;

namespace {

template <class S>
using PolytopeOf = decltype(samples::grain(S{}, std::declval<std::mt19937_64&>()));
template <class S>
using Mixed = OneOf<BallIn<S>, PolytopeOf<S>, CapsuleIn<S>, Rounded<PolytopeOf<S>>>;

TEST_CASE("every query for every pair of kinds in space") {
  std::mt19937_64 random(21);
  check_pair<Mixed<Space<3>>, Mixed<Space<3>>>(random, 2500);
  check_pair<Mixed<Space<3>>, HalfSpace<Space<3>>>(random, 500);
  check_pair<Ellipsoid<Space<3>>, Mixed<Space<3>>>(random, 500);
}

TEST_CASE("every query for every pair of kinds in the plane") {
  std::mt19937_64 random(22);
  check_pair<Mixed<Space<2>>, Mixed<Space<2>>>(random, 2500);
  check_pair<Mixed<Space<2>>, HalfSpace<Space<2>>>(random, 500);
  check_pair<Ellipsoid<Space<2>>, Mixed<Space<2>>>(random, 500);
}

}  // namespace
