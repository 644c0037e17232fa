// SPDX-License-Identifier: MIT
#include <random>
#include <vector>

#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/ball.hpp"

#include "conformance/matrix.hpp"

using namespace moreau;

TEST_CASE_TEMPLATE("concave ballast under every law", Part, Polygon<>, Polyhedron<>) {
  std::mt19937_64 random(2);
  std::vector<Compound<Part>> grains;
  for (const auto& grain : ballast_shapes<Compound<Part>>(3, random))
    grains.push_back(grain.scaled(0.005));
  conformance::all_laws(grains, 0.01);
}

TEST_CASE_TEMPLATE("dumbbells under every law", S, Space<2>, Space<3, float>) {
  using T = typename S::Scalar;
  const typename S::Vector x = T(0.0025) * S::Vector::UnitX();
  conformance::all_laws(
      Compound<BallIn<S>>({{BallIn<S>(T(0.0025)), {x}}, {BallIn<S>(T(0.0025)), {-x}}}), T(0.01));
}
