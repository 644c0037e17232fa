// SPDX-License-Identifier: MIT
#include "moreau/shape/capsule.hpp"

#include <doctest/doctest.h>
#include <numbers>
#include <vector>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using namespace moreau;
constexpr double pi = std::numbers::pi;

static_assert(ConvexShape<moreau::Stadium<>> && ConvexShape<moreau::Capsule<float>>);
static_assert(ConvexCore<Segment<Space<3>>> && !Shape<Segment<Space<3>>>);

TEST_CASE_TEMPLATE("a stadium in closed form", T, MOREAU_TYPES((double), (float))) {
  const double h = 1.5, r = 0.5;
  const moreau::Stadium<T> stadium(T(1.5), T(0.5));
  CHECK(stadium.volume() == doctest::Approx(4 * h * r + pi * r * r).epsilon(1e-6));
  const double inertia =
      4 * h * r * (h * h + r * r) / 3 + pi * r * r * (r * r / 2 + h * h + 2 * h * 4 * r / (3 * pi));
  CHECK(stadium.mass_properties(2).inertia(0, 0) == doctest::Approx(2 * inertia).epsilon(1e-6));
  CHECK(stadium.circumradius() == 2);
  CHECK(stadium.inradius() == T(0.5));
}

TEST_CASE_TEMPLATE("a capsule in closed form", T, MOREAU_TYPES((double), (float))) {
  const double h = 1.5, r = 0.5;
  const moreau::Capsule<T> capsule(T(1.5), T(0.5));
  const double tube = 2 * h * pi * r * r, ball = 4 * pi / 3 * r * r * r;
  const auto mass = capsule.mass_properties(1);
  CHECK(mass.mass == doctest::Approx(tube + ball).epsilon(1e-6));
  const double along = tube * r * r / 2 + ball * 0.4 * r * r;
  const double across =
      tube * (r * r / 4 + h * h / 3) + ball * (0.4 * r * r + h * h + 0.75 * h * r);
  CHECK(mass.inertia(0, 0) == doctest::Approx(along).epsilon(1e-6));
  CHECK(mass.inertia(1, 1) == doctest::Approx(across).epsilon(1e-6));
  CHECK(mass.inertia(2, 2) == doctest::Approx(across).epsilon(1e-6));
  CHECK(mass.inertia(0, 1) == 0);
}

TEST_CASE("a rounded needle is nearly a capsule") {
  using Vector = Space<3>::Vector;
  const double w = 1e-4;
  const Polyhedron<double> needle(std::vector<Vector>{
      {-1.5, w, 0}, {-1.5, -w, w}, {-1.5, -w, -w}, {1.5, w, 0}, {1.5, -w, w}, {1.5, -w, -w}});
  const auto near = Rounded(needle, 0.5).mass_properties(1);
  const auto exact = moreau::Capsule<>(1.5, 0.5).mass_properties(1);
  CHECK(near.mass == doctest::Approx(exact.mass).epsilon(1e-3));
  CHECK((near.inertia - exact.inertia).norm() < 1e-3 * exact.inertia.norm());
}

TEST_CASE("bad arguments are named") {
  using Stadium = moreau::Stadium<>;
  CHECK(message_of([] { Stadium(0, 1); }) == "Segment: half_length = 0 must be finite and > 0");
  CHECK(message_of([] { Stadium(1, -1); }) == "Rounded: radius = -1 must be finite and > 0");
  CHECK(message_of([] { return Segment<Space<2>>(1).scaled(-2); }) ==
        "Segment::scaled: factor = -2 must be finite and > 0");
}

}  // namespace
