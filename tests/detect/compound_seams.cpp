// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <random>

#include "moreau/detect/collide.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/polyhedron.hpp"

using namespace moreau;

// Two concave stones that overlap by a thousandth of their size near a seam. A pair of parts whose least overlap is at a
// seam touched along a face outside, along which it overlaps by up to 0.044. Of 4,000 random pairs 5 were such.
TEST_CASE("parts that touch beside a seam do not overlap by much more than the grains do") {
  using S = Space<3, double>;
  std::mt19937_64 random(2);
  const auto shapes = ballast_shapes<Compound<Polyhedron<>>>(6, random);
  struct Case {
    std::size_t a, b;
    S::Angular turn_a, turn_b;
    S::Vector apart;
  };
  const std::array<Case, 3> cases{Case{0,
                                       0,
                                       {2.4545, 0.4431, -2.9852},
                                       {-2.5722, 1.0707, 2.2131},
                                       {0.647715, 0.989335, -0.952694}},
                                  Case{3,
                                       1,
                                       {0.5102, -1.2669, 0.8175},
                                       {-0.4343, 0.7250, 1.0226},
                                       {1.229401, -0.667747, -0.222582}},
                                  Case{4,
                                       3,
                                       {0.8532, 2.2889, -2.2881},
                                       {-0.6224, -2.7886, 2.5718},
                                       {-1.076559, 0.781014, 0.902107}}};
  for (const Case& one : cases)
    for (const bool swapped : {false, true}) {
      const Placed<Compound<Polyhedron<>>> first(shapes[one.a],
                                                 {S::Vector::Zero(), S::exp(one.turn_a)}),
          second(shapes[one.b], {one.apart, S::exp(one.turn_b)});
      const auto &a = swapped ? second : first, &b = swapped ? first : second;
      const double gap = distance(a, b).gap;
      double deepest = 0;
      Manifold<S> manifold;
      const bool touch = collide_parts(a, b, 0.02, manifold, [&] {
        for (const auto& point : manifold.points) deepest = std::min(deepest, point.gap);
      });
      CAPTURE(one.a);
      CAPTURE(swapped);
      CHECK(touch == (gap <= 0.02));
      CHECK(deepest >= 10 * std::min(gap, 0.0));
      CHECK(deepest <= 0.99 * std::min(gap, 0.0));
    }
}
