// SPDX-License-Identifier: MIT
#include "moreau/measure/velocity_field.hpp"

#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "moreau/measure/grid_field.hpp"

namespace {

using namespace moreau;

/// Grains distributed over a box, with the velocity flow(x, z) in the section.
template <class S, class Flow>
VelocityField<S> sampled(const Flow& flow) {
  using V = typename S::Vector;
  const Aabb<S> box{V::Constant(1), V::Constant(3)};
  VelocityField<S> field(box, 8, 6);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.5, 3.5);
  for (int i = 0; i < 30000; ++i) {
    V x, v = V::Constant(100);  // the velocity perpendicular to the section must have no influence
    for (auto& component : x) component = uniform(random);
    const Eigen::Vector2d u = flow(x[0] - 2, x[S::dim - 1] - 2);
    v[0] = u.x();
    v[S::dim - 1] = u.y();
    field.add(x, v);
  }
  return field;
}

}  // namespace

TEST_CASE_TEMPLATE("a rigid rotation is a perfect roll with its own angular velocity", S, Space<2>,
                   Space<3>) {
  // With x to the right and the last axis upwards, counter-clockwise is positive.
  for (const double spin : {2.0, -0.5}) {
    const auto field = sampled<S>([&](double x, double z) {
      // The field also has a translation, which must have no influence.
      return Eigen::Vector2d(7 - spin * z, -3 + spin * x);
    });
    const auto roll = field.roll();
    CHECK(roll.angular_velocity == doctest::Approx(spin).epsilon(0.03));
    CHECK(std::abs(roll.strength) > 0.99);
    CHECK(roll.strength * spin > 0);
    CHECK(roll.agreement == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("a convection roll that dies out at the walls has the sign of its middle") {
  const auto field = sampled<Space<3>>([](double x, double z) {
    const double pi = std::acos(-1.0);  // stream function cos cos, clockwise
    return Eigen::Vector2d(std::cos(pi * x / 2) * std::sin(pi * z / 2),
                           -std::sin(pi * x / 2) * std::cos(pi * z / 2));
  });
  CHECK(field.roll().angular_velocity < 0);
  CHECK(field.roll().strength < -0.8);
  CHECK(field.roll().agreement > 0.99);
}

TEST_CASE("pure strain and translation are no roll") {
  const auto strain = sampled<Space<2>>([](double x, double z) { return Eigen::Vector2d(-x, z); });
  CHECK(std::abs(strain.roll().strength) < 0.05);
  const auto rest = sampled<Space<2>>([](double, double) { return Eigen::Vector2d(5, 4); });
  CHECK(std::abs(rest.roll().angular_velocity) < 1e-12);
  CHECK(VelocityField<Space<2>>({{0, 0}, {1, 1}}, 2, 2).roll().strength == 0);
}

TEST_CASE("cells hold means, outsiders are left out") {
  using V = Space<3>::Vector;
  VelocityField<Space<3>> field({V(0, 0, 0), V(4, 1, 2)}, 4, 2);
  field.add(V(2.5, 0.5, 1.5), V(1, 9, 2));
  field.add(V(2.9, 0.1, 1.1), V(3, 9, 4));
  field.add(V(2.5, 1.5, 1.5), V(50, 50, 50));  // a grain outside of the box
  const auto cell = field.sample(2, 1);
  CHECK(cell.position == Eigen::Vector2d(2.5, 1.5));
  CHECK(cell.velocity == Eigen::Vector2d(2, 3));
  CHECK(cell.grains == 2);
  CHECK(field.sample(0, 0).grains == 0);
  field.clear();
  CHECK(field.sample(2, 1).grains == 0);
  CHECK_THROWS_AS(VelocityField<Space<3>>({V(0, 0, 0), V(4, 1, 2)}, 0, 2), std::invalid_argument);
  CHECK_THROWS_AS(VelocityField<Space<3>>({V(0, 0, 0), V(4, 1, 2)}, 2, 0), std::invalid_argument);
  CHECK_THROWS_AS(VelocityField<Space<3>>({V(0, 0, 0), V(4, 0, 2)}, 2, 2), std::invalid_argument);
}

TEST_CASE_TEMPLATE("a grid holds the weighted means of its cells, along every axis", S, Space<2>,
                   Space<3>) {
  using V = typename S::Vector;
  typename GridField<S>::Cells cells;
  for (int k = 0; k < S::dim; ++k) cells[k] = std::size_t(k) + 2;
  const Aabb<S> box{V::Zero(), V::Constant(6)};
  GridField<S> field(box, cells);
  // The displacement of a homogeneous strain, with one grain at the centre of each cell.
  typename S::Matrix gradient = S::Matrix::Identity();
  gradient(0, S::dim - 1) = 0.5;
  for (std::size_t k = 0; k < field.size(); ++k) {
    const V x = field.sample(k).position;
    field.add(x, gradient * x);
    field.add(x, gradient * x + V::UnitX(), 2);
  }
  std::size_t count = 1;
  for (const std::size_t n : cells) count *= n;
  REQUIRE(field.size() == count);
  for (std::size_t k = 0; k < field.size(); ++k) {
    const auto sample = field.sample(k);
    CHECK(sample.grains == 2);
    CHECK(sample.weight == 3);
    CHECK((sample.value - gradient * sample.position - 2 * V::UnitX() / 3).norm() < 1e-14);
  }
  CHECK(field.sample(0).position == V(box.upper.cwiseQuotient(2 * V::LinSpaced(2, S::dim + 1))));
  CHECK(field.sample(1).position[0] == 4.5);  // consecutive indices run along the first axis
  field.clear();
  field.add(V::Constant(6), V::Ones());  // the upper bounds do not belong to the box
  for (std::size_t k = 0; k < field.size(); ++k) CHECK(field.sample(k).grains == 0);
  PeriodicCell<S> cell;
  for (int k = 0; k < S::dim; ++k) cell.set(k, 0, 6);
  field.add(V::Constant(6.5), V::Ones(), 1, cell);  // counted at its image at 0.5
  CHECK(field.sample(0).value == V(V::Ones()));
  CHECK_THROWS_AS(field.add(V::Zero(), V::Zero(), 0), std::invalid_argument);
  CHECK_THROWS_AS(field.sample(field.size()), std::invalid_argument);
  typename GridField<S>::Cells endless;
  endless.fill(std::size_t(1) << 33);
  CHECK_THROWS_AS(GridField<S>(box, endless), std::invalid_argument);
  VelocityField<S> section(box, 2, 3);
  CHECK_THROWS_AS(section.sample(2, 0), std::invalid_argument);
  CHECK_THROWS_AS(section.sample(0, 3), std::invalid_argument);
  CHECK_THROWS_AS(VelocityField<S>(box, endless[0], endless[0]), std::invalid_argument);
  const V nowhere = V::Constant(std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(field.add(nowhere, V::Zero()), std::invalid_argument);
  CHECK_THROWS_AS(field.add(V::Zero(), nowhere), std::invalid_argument);
  CHECK_THROWS_AS(section.add(V::Zero(), nowhere), std::invalid_argument);
  cells[0] = 0;
  CHECK_THROWS_AS(GridField<S>(box, cells), std::invalid_argument);
  CHECK_THROWS_AS(GridField<S>({}, field.cells()), std::invalid_argument);
}

TEST_CASE_TEMPLATE("a field refuses a control volume that is longer than the periodic cell", S,
                   Space<2>, Space<3>) {
  using V = typename S::Vector;
  typename GridField<S>::Cells cells;
  cells.fill(4);
  const Aabb<S> box{V::Zero(), V::Ones()};
  GridField<S> field(box, cells);
  VelocityField<S> section(box, 4, 4);
  const auto refuses = [&](const PeriodicCell<S>& cell) {
    CHECK_THROWS_WITH_AS(field.add(V::Zero(), V::Zero(), 1, cell),
                         doctest::Contains("GridField::add: control_volume = [(0, 0"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(section.add(V::Zero(), V::Zero(), cell),
                         doctest::Contains("must not be longer than the periodic cell"),
                         std::invalid_argument);
  };
  PeriodicCell<S> half;
  half.set(0, 0, 0.5);
  refuses(half);
  // A lattice that is sheared: the box fits no more. Of a smaller box each grain has one image in it.
  PeriodicCell<S> sheared;
  typename S::Matrix vectors = S::Matrix::Identity();
  sheared.set_vectors(vectors, V::Zero());
  field.add(V::Constant(1.25), V::Ones(), 1, sheared);
  CHECK(field.sample(field.size() - 1).grains + field.sample(0).grains <= 1);
  vectors(0, 1) = 0.3;
  sheared.set_vectors(vectors, V::Zero());
  refuses(sheared);
  GridField<S> small({V::Zero(), V::Constant(0.7)}, cells);
  std::size_t within = 0, added = 0;
  for (int k = 0; k < 100; ++k) {
    V x = V::Constant(0.35);
    x[0] = 0.01 * k + 0.005;
    small.add(V(x + vectors * V::LinSpaced(1, S::dim)), V::Ones(), 1, sheared);
    within += x[0] < 0.7 ? 1u : 0u;
  }
  for (std::size_t k = 0; k < small.size(); ++k) added += small.sample(k).grains;
  CHECK(added == within);
}
