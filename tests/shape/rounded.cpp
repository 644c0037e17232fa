// SPDX-License-Identifier: MIT
#include "moreau/shape/rounded.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "detect/shapes.hpp"
#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using namespace moreau;
constexpr double pi = std::numbers::pi;

/// The integral of A(x) x^power dx for a rounded box, where A(x) is the area of the section at x.
double from_sections(const Eigen::Vector3d& half, double r, int power) {
  const auto section = [&](double rho) {
    return 4 * half.y() * half.z() + 4 * (half.y() + half.z()) * rho + pi * rho * rho;
  };
  double sum = 2 * section(r) * std::pow(half.x(), power + 1) / (power + 1);
  const int n = 2000;  // Simpson's rule in the angle, with x = half + r sin(angle)
  for (int i = 0; i <= n; ++i) {
    const double angle = pi / 2 * i / n, weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
    const double x = half.x() + r * std::sin(angle), rho = r * std::cos(angle);
    sum += 2 * weight * pi / (6 * n) * section(rho) * std::pow(x, power) * rho;
  }
  return sum;
}

TEST_CASE("a rounded box, turned, in closed form") {
  using S = Space<3>;
  const Eigen::Vector3d half(0.5, 0.8, 0.3);
  const double r = 0.4;
  const Polyhedron<double> box = samples::box(1.0, 1.6, 0.6);
  const Rounded rounded(box, r);
  const double sides = 1 + 1.6 + 0.6, area = 2 * (1.6 + 0.96 + 0.6);
  const double steiner = 0.96 + area * r + pi * sides * r * r + 4 * pi / 3 * r * r * r;
  CHECK(rounded.volume() == doctest::Approx(steiner).epsilon(1e-14));
  CHECK(from_sections(half, r, 0) == doctest::Approx(steiner).epsilon(1e-12));
  CHECK(rounded.core_position().norm() < 1e-15);
  CHECK(rounded.circumradius() == doctest::Approx(half.norm() + r));
  CHECK(rounded.inradius() == doctest::Approx(0.3 + r));
  Eigen::Vector3d second;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d turned(half[axis], half[(axis + 1) % 3], half[(axis + 2) % 3]);
    second[axis] = from_sections(turned, r, 2);
  }
  const Eigen::Matrix3d inertia = Eigen::Matrix3d(second.sum() * Eigen::Matrix3d::Identity()) -
                                  Eigen::Matrix3d(second.asDiagonal());
  CHECK((rounded.mass_properties(1).inertia - inertia).norm() < 1e-12 * inertia.norm());

  const Eigen::Matrix3d turn = S::exp({0.3, -0.7, 1.1}).toRotationMatrix();
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index i = 0; i < 8; ++i)
    corners.emplace_back(turn * box.vertices().row(i).transpose() + Eigen::Vector3d(3, 4, 5));
  const auto its = Rounded(Polyhedron<double>(corners), r).mass_properties(1).inertia;
  CHECK((its - turn * inertia * turn.transpose()).norm() < 1e-12 * inertia.norm());
}

TEST_CASE_TEMPLATE("a rounded rectangle in closed form", T, MOREAU_TYPES((double), (float))) {
  const Rounded rounded(samples::box(T(2), T(1)), T(0.5));
  // The shape consists of a rectangle 2 x 1, two rectangles 2 x 0.5, two rectangles 0.5 x 1, and
  // four quarters of a disk.
  const double quarter = 4 * 0.5 / (3 * pi), disk = pi * 0.25;
  const double inertia = 2 * (4 + 1) / 12. + 2 * (4 + 0.25) / 12 + 2 * 0.75 * 0.75 +
                         1 * (0.25 + 1) / 12 + 1 * 1.25 * 1.25 +
                         disk * (0.25 / 2 + 1 + 0.25 + 2 * quarter * (1 + 0.5));
  CHECK(rounded.volume() == doctest::Approx(2 + 3 + disk).epsilon(1e-6));
  CHECK(rounded.mass_properties(2).inertia(0, 0) == doctest::Approx(2 * inertia).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("with a radius that vanishes a rounded grain is its core", S, Space<2>,
                   Space<3>) {
  std::mt19937_64 random(13);
  const auto core = samples::grain(S{}, random);
  const Rounded rounded(core, 1e-9);
  const auto truth = core.mass_properties(1), its = rounded.mass_properties(1);
  CHECK(its.mass == doctest::Approx(truth.mass).epsilon(1e-7));
  CHECK((its.inertia - truth.inertia).norm() < 1e-7 * truth.inertia.norm());
  CHECK(rounded.core_position().norm() < 1e-8);
}

TEST_CASE("the frame is at the centre of mass of the sum") {
  // The core is a long triangle. Rounding adds more mass at its blunt end.
  using Vector = Space<2>::Vector;
  const Polygon<double> core(std::vector<Vector>{{0, -1}, {4, 0}, {0, 1}});
  const Rounded rounded(core, 1.0);
  CHECK(rounded.core_position().x() < -0.1);
  CHECK(std::abs(rounded.core_position().y()) < 1e-14);
  const Vector top = rounded.support(Vector(0, 1));
  CHECK(top.y() == doctest::Approx(2));
  CHECK(top.x() == doctest::Approx(rounded.core_position().x() + core.vertices()(2, 0)));
}

/// Inertia of a rounded simplex over its mass and the square of its size.
template <class ShapeT>
Eigen::MatrixXd shape_of_inertia(double size) {
  using T = typename ShapeT::Space::Scalar;
  using Vector = typename ShapeT::Vector;
  std::vector<Vector> corners{Vector::Zero()};
  for (int k = 0; k < ShapeT::Space::dim; ++k) {
    Vector x = Vector::Constant(T(0.1 * size));
    x[k] = T((1 - 0.2 * k) * size);
    corners.push_back(x);
  }
  const ShapeT core{std::span<const Vector>(corners)};
  const auto mass = Rounded<ShapeT>(core, T(0.1 * size)).mass_properties(T(1));
  return mass.inertia.template cast<double>() / double(mass.mass) / (size * size);
}

TEST_CASE("in single precision the moments of every size are those of double precision") {
  for (const double size : {1e-6, 1e-5, 1e-3, 1.0, 1e3, 1e5, 1e6}) {
    CAPTURE(size);
    const Eigen::MatrixXd solid = shape_of_inertia<Polyhedron<>>(1),
                          flat = shape_of_inertia<Polygon<>>(1);
    CHECK((shape_of_inertia<Polyhedron<float>>(size) - solid).norm() < 1e-5 * solid.norm());
    CHECK((shape_of_inertia<Polygon<float>>(size) - flat).norm() < 1e-5 * flat.norm());
  }
}

TEST_CASE("bad arguments are named") {
  const auto core = samples::box(1.0, 1.0);
  CHECK(message_of([&] { Rounded(core, 0.0); }) == "Rounded: radius = 0 must be finite and > 0");
  CHECK(message_of([&] { Rounded(core, std::numeric_limits<double>::quiet_NaN()); }) ==
        "Rounded: radius = nan must be finite and > 0");
  CHECK(message_of([&] { Rounded(core, 1e200); }) ==
        "Rounded: volume = inf m^D must be positive and finite");
  const Rounded rounded(core, 0.1);
  CHECK(message_of([&] { rounded.mass_properties(-1); }) ==
        "Rounded::mass_properties: density = -1 must be finite and > 0");
  CHECK(message_of([&] { return rounded.scaled(0); }) ==
        "Rounded::scaled: factor = 0 must be finite and > 0");
}

}  // namespace
