// SPDX-License-Identifier: MIT
// Polyhedra in single precision against the exhaustive search.
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "detect/oracle.hpp"
#include "detect/shapes.hpp"
#include "sanitized.hpp"

using namespace moreau;

TEST_CASE("polyhedra in float: gap to a few roundings") {
  std::mt19937_64 random(10);
  using F = Space<3, float>;
  for (int i = 0; i < rounds(200); ++i) {
    const auto shape_a = samples::grain(F{}, random), shape_b = samples::grain(F{}, random);
    const Pose<F> pose_a{F::Vector::Zero(), samples::rotation(F{}, random)};
    const Pose<F> pose_b{1.2f * samples::direction<F>(random), samples::rotation(F{}, random)};
    const auto truth = oracle::signed_gap(shape_a, pose_a, shape_b, pose_b);
    const auto found = distance(Placed<Polyhedron<float>>(shape_a, pose_a),
                                Placed<Polyhedron<float>>(shape_b, pose_b));
    CHECK(std::abs(found.gap - truth.gap) < 1e-5f);
    Manifold<F> manifold;
    CHECK(collide(Placed<Polyhedron<float>>(shape_a, pose_a),
                  Placed<Polyhedron<float>>(shape_b, pose_b), 0.05f,
                  manifold) == (found.gap <= 0.05f));
  }
}
