// SPDX-License-Identifier: MIT
// Pairs of different types of shapes in single precision.
#include "detect/queries.hpp"

using namespace queries;

namespace {

template <class S, class PolytopeT>
void check() {
  using Mixed = OneOf<BallIn<S>, CapsuleIn<S>, Rounded<PolytopeT>>;
  std::mt19937_64 random(23);
  check_pair<Mixed, Mixed>(random, 1000);
  check_pair<Mixed, HalfSpace<S>>(random, 200);
}

TEST_CASE("every query for pairs of kinds, in single precision") {
  check<Space<3, float>, Polyhedron<float>>();
  check<Space<2, float>, Polygon<float>>();
}

}  // namespace
