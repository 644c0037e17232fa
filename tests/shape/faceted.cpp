// SPDX-License-Identifier: MIT
// Faceted<Shape>: the polytope lies inside the shape, its error is a bound and falls with n as theory
// says (n^-2 in the plane, n^-1 in space for smooth shapes).
#include "moreau/shape/faceted.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/shape/ball.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/support_box.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

/// An ellipsoid, in the plane an ellipse, with semi-axes 1, 2, 3 cm that is not centred at its origin.
template <class S>
struct ShiftedEllipsoid {
  using Space = S;
  using Vector = typename S::Vector;
  typename S::Scalar radius(int k) const { return static_cast<typename S::Scalar>(0.01 * (k + 1)); }
  Vector support(const Vector& direction) const {
    Vector x;
    for (int k = 0; k < S::dim; ++k) x[k] = radius(k) * direction[k];
    x.normalize();
    for (int k = 0; k < S::dim; ++k) x[k] *= radius(k);
    return x + Vector::Constant(typename S::Scalar(0.005));
  }
  Aabb<S> bounding_box(const Pose<S>& pose) const { return support_box(*this, pose); }
  MassProperties<S> mass_properties(typename S::Scalar) const { return {}; }
};

template <class S>
typename S::Vector random_direction(std::mt19937& random) {
  std::normal_distribution<typename S::Scalar> number;
  typename S::Vector direction;
  for (int k = 0; k < S::dim; ++k) direction[k] = number(random);
  return direction.normalized();
}

/// The largest h_K(d) - h_P(d) over random directions, and the smallest.
template <class ShapeT>
std::pair<double, double> differences(const ShapeT& shape, const Faceted<ShapeT>& faceted) {
  using S = SpaceOf<ShapeT>;
  std::mt19937 random(1);
  double most = -1, least = 1;
  for (int k = 0; k < 4000; ++k) {
    const typename S::Vector d = random_direction<S>(random);
    const typename S::Vector corner =
        faceted.polytope().support(d) + faceted.polytope().centroid_of_input();
    const double difference = double(d.dot(shape.support(d) - corner));
    most = std::max(most, difference);
    least = std::min(least, difference);
  }
  return {most, least};
}

}  // namespace

TEST_CASE_TEMPLATE("the polytope lies inside the shape and is as close as its error says", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  const ShiftedEllipsoid<S> shape;
  const double rounding = 1e-6 * 0.03 * (sizeof(typename S::Scalar) == 4 ? 1 : 1e-8);
  double before = 1;
  for (const std::size_t n : {14u, 40u, 160u}) {
    const Faceted<ShiftedEllipsoid<S>> faceted(shape, n);
    const auto [most, least] = differences(shape, faceted);
    CHECK(faceted.polytope().vertex_count() <= n);
    CHECK(least >= -rounding);
    CHECK(most <= double(faceted.error()) + rounding);
    // The bound is not far from the truth, the less so the wider the normal cones are.
    CHECK(double(faceted.error()) <= (n < 40 ? 4 : 2) * most + rounding);
    CHECK(double(faceted.error()) < before);
    before = double(faceted.error());
  }
}

TEST_CASE_TEMPLATE("the error of a smooth shape falls as n^(-2/(D-1))", S, Space<2>, Space<3>) {
  const BallIn<S> ball(0.01);
  const double coarse = Faceted<BallIn<S>>(ball, 50).error();
  const double fine = Faceted<BallIn<S>>(ball, 200).error();
  const double exponent = std::log(coarse / fine) / std::log(4.0);
  CHECK(exponent == doctest::Approx(2.0 / (S::dim - 1)).epsilon(0.2));
}

TEST_CASE_TEMPLATE("a polytope is reproduced", ShapeT, Polygon<double>, Polyhedron<double>) {
  using S = SpaceOf<ShapeT>;
  const ShapeT cube = regular_shape<ShapeT>(0.02);
  const Faceted<ShapeT> faceted(cube, 50);
  CHECK(faceted.polytope().vertex_count() == (std::size_t{1} << S::dim));
  CHECK(faceted.polytope().volume() == doctest::Approx(cube.volume()));
  CHECK(faceted.error() < 1e-15);
}

TEST_CASE("the mass of a faceted ball tends to that of the ball") {
  const Ball<double> ball(0.01);
  const Faceted<Ball<double>> faceted(ball, 300);  // at most 300 vertices
  const Polyhedron<double>& polyhedron = faceted.polytope();
  CHECK(faceted.error() < 3e-4);  // [m], of the surface
  CHECK(polyhedron.volume() == doctest::Approx(ball.volume()).epsilon(0.03));
  CHECK(faceted.polytope().volume() < ball.volume());
}

TEST_CASE("too few vertices are refused") {
  CHECK_THROWS_WITH_AS(Faceted<Ball<double>>(Ball<double>(0.01), 13),
                       "Faceted: n = 13 must be at least 2 D + 2^D, in space 14",
                       std::invalid_argument);
}
