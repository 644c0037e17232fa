// SPDX-License-Identifier: MIT
#include "moreau/detect/placed.hpp"

#include <doctest/doctest.h>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/shape/ball.hpp"

#include "conformance/support_only.hpp"
#include "detect/shapes.hpp"

using namespace moreau;

namespace {

template <class S>
void check_polytope(std::mt19937_64& random) {
  const auto shape = samples::grain(S{}, random);
  using ShapeT = std::remove_const_t<decltype(shape)>;
  const Pose<S> pose{10 * samples::direction<S>(random), samples::rotation(S{}, random)};
  Placed<ShapeT> placed(shape);
  placed.update(shape, pose);
  const double tiny = 1e-13;
  for (std::size_t i = 0; i < shape.vertex_count(); ++i) {
    const typename S::Vector x = shape.vertices().row(static_cast<Eigen::Index>(i)).transpose();
    CHECK((placed.center() + placed.vertices()[i] - pose(x)).norm() < tiny);
  }
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    const auto row = static_cast<Eigen::Index>(f);
    const typename S::Vector n = shape.face_normals().row(row).transpose();
    CHECK((placed.normals()[f] - pose.rotation * n).norm() < tiny);
    CHECK(placed.offset(f) == shape.face_offsets()[row]);
  }
  const auto box = placed.bounding_box(), expected = shape.bounding_box(pose);
  CHECK((box.lower - expected.lower).norm() < tiny);
  CHECK((box.upper - expected.upper).norm() < tiny);
  for (int k = 0; k < 20; ++k) {
    const typename S::Vector d = 3 * samples::direction<S>(random);
    const typename S::Vector body = pose.rotation.inverse() * d;
    CHECK(d.dot(placed.support(d)) ==
          doctest::Approx(body.dot(shape.support(body))).epsilon(1e-12));
  }
  placed.move_to(S::Vector::Zero());
  CHECK((placed.bounding_box().lower + pose.position - expected.lower).norm() < tiny);
}

template <class S>
void check_scans() {
  // All numbers of rows from one row to several registers, with the extreme value in each row in
  // turn.
  for (Eigen::Index count = 1; count < 20; ++count)
    for (Eigen::Index top = 0; top < count; ++top) {
      Eigen::Matrix<typename S::Scalar, Eigen::Dynamic, S::dim> matrix(count, S::dim);
      matrix.setZero();
      matrix.row(top).setConstant(1);
      detail::PointRows<S> rows;
      rows.assign(matrix, S::Matrix::Identity());
      const auto found = rows.farthest(S::Vector::Ones());
      CHECK(found.index == top);
      CHECK(found.value == S::dim);
      std::vector<std::uint32_t> above;
      rows.for_each_above(S::Vector::Ones(), 0.5, [&](std::uint32_t i) { above.push_back(i); });
      CHECK(above == std::vector<std::uint32_t>{static_cast<std::uint32_t>(top)});
      // If several rows are equal, the first one is reported.
      matrix.row(count - 1).setConstant(1);
      rows.assign(matrix, S::Matrix::Identity());
      CHECK(rows.farthest(S::Vector::Ones()).index == top);
    }
}

}  // namespace

TEST_CASE("placed polytopes: vertices, normals, support and box in world axes") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    check_polytope<Space<2>>(random);
    check_polytope<Space<3>>(random);
  }
}

TEST_CASE("scans over rows find the first of the largest") {
  check_scans<Space<2, double>>();
  check_scans<Space<3, double>>();
  check_scans<Space<3, float>>();
}

TEST_CASE("a shape of one's own is placed by its support") {
  using S = Space<3>;
  using Shape = conformance::SupportOnly<Ball<>>;
  const Shape shape(Ball<>(2));
  const Pose<S> pose{S::Vector(1, 2, 3), S::exp(S::Angular(0.3, 0.2, 0.1))};
  const Placed<Shape> placed(shape, pose);
  CHECK((placed.support(S::Vector(0, 0, 5)) - S::Vector(0, 0, 2)).norm() < 1e-14);
  CHECK(placed.center() == pose.position);
  CHECK(placed.bounding_box().upper == S::Vector(3, 4, 5));
}
