// SPDX-License-Identifier: MIT
#include "moreau/law/rolling_resistance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "law/random_blocks.hpp"
#include "types.hpp"

using namespace moreau;
using law_oracle::round_block;
using S = Space<3>;
using Row = RollingBlock<S>::Vector;
using Matrix6 = RollingBlock<S>::Matrix;

namespace {

/// W of two balls that touch off the line of their centres.
RollingBlock<S> eccentric_block(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  const double radii[] = {0.2 + part(random), 0.2 + part(random)};
  const double radius = 1 / (1 / radii[0] + 1 / radii[1]);
  Matrix6 w = Matrix6::Zero();
  for (const int sign : {1, -1}) {
    const double r = radii[sign < 0], mass = 4 * r * r * r;
    const Eigen::Vector3d lever(sign * r, 0.3 * r * normal(random), 0.3 * r * normal(random));
    const Eigen::Matrix3d arm = S::lever(lever);
    Matrix6 j = Matrix6::Zero(), by_mobility;
    for (int row = 0; row < 3; ++row) {
      j(row, row) = 1;
      j(3 + row, 3 + row) = radius;
      for (int column = 0; column < 3; ++column) j(row, 3 + column) = arm(row, column);
    }
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        by_mobility(row, column) = j(row, column) / (column < 3 ? mass : 0.4 * mass * r * r);
    add_product_transposed(w, by_mobility, j);
  }
  // In the frame in which the tangential part of W is diagonal.
  Eigen::Matrix2d turn;
  RollingBlock<S> block;
  Eigen::Matrix3d point;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) point(row, column) = w(row, column);
  block.point = align_tangents<S>(point, turn);
  Matrix6 q = Matrix6::Identity(), half = Matrix6::Zero(), turned = half;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column)
      q(1 + row, 1 + column) = q(4 + row, 4 + column) = turn(row, column);
  add_product(half, w, q);
  add_transposed_product(turned, q, half);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      block.cross(row, column) = turned(row, 3 + column);
      block.spin(row, column) = turned(3 + row, 3 + column);
    }
  return block;
}

/// The fixed point of visits of one contact.
template <class Any, class T = typename Any::Scalar>
std::array<T, Any::dofs> solve_alone(const RollingBlock<Any>& problem,
                                     const std::array<T, Any::dofs>& velocity, T friction,
                                     T rolling) {
  using Block = RoundBlock<Any, detail::OneNumber<T>>;
  Block block = Block::unit();
  block.set(0, problem);
  typename Block::Memory memory{};
  typename Block::Vector r{};
  for (int visit = 1; visit <= 600; ++visit)
    r = detail::RollingLanes<Any, Block>::solve(block, velocity, r, friction, rolling, memory,
                                                visit == 600);
  return r;
}

}  // namespace

TEST_CASE_TEMPLATE(
    "round contacts: lanes, and one contact alone, visited again and again have the scalar "
    "solution",
    Any, MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename Any::Scalar;
  using Block = RoundBlock<Any>;
  using Values = typename Block::Values;
  using Problem = RollingBlock<Any>;
  constexpr std::size_t lanes = Block::Number::lanes;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  double worst = 0;
  int open = 0, rolls = 0, slips = 0, both = 0, neither = 0;
  for (std::size_t done = 0; done < 3200; done += lanes) {
    Block block = Block::unit();
    typename Block::Vector b{}, r{};
    std::array<Values, 2> parameters{};
    std::array<typename Problem::Vector, lanes> exact;
    for (std::size_t l = 0; l < lanes; ++l) {
      const RollingResistance<T> law(T(part(random)), T(part(random) * part(random)));
      const Problem problem = round_block<Any>(random);
      typename Problem::Vector velocity;
      for (T& x : velocity) x = T(normal(random));
      velocity[0] -= 1;
      exact[l] = law.solve(problem, velocity, typename Problem::Vector(Problem::Vector::Zero()));
      block.set(l, problem);
      for (std::size_t d = 0; d < Block::rows; ++d) b[d][l] = velocity[Eigen::Index(d)];
      for (std::size_t k = 0; k < 2; ++k) parameters[k][l] = law.lane_parameters()[k];
      const typename Problem::Vector u = problem * exact[l] + velocity;
      const T small = T(1e-4) * velocity.norm();
      const bool slides = u.template segment<Any::dim - 1>(1).norm() > small;
      const bool turns = angular<Any>(u).norm() > small;
      (exact[l][0] == 0 ? open : slides ? (turns ? both : slips) : turns ? rolls : neither)++;
    }
    typename Block::Memory memory{};
    for (int visit = 1; visit <= 600; ++visit)
      r = RollingResistance<T>::template solve_lanes<Any>(block, b, r, parameters, memory,
                                                          visit == 600);
    const bool alone = done < 320;  // the same with one number in place of a register
    for (std::size_t l = 0; l < lanes; ++l) {
      std::array<T, Block::rows> single{};
      if (alone) {
        std::array<T, Block::rows> velocity;
        for (std::size_t d = 0; d < Block::rows; ++d) velocity[d] = b[d][l];
        single = solve_alone<Any>(block[l], velocity, parameters[0][l], parameters[1][l]);
      }
      for (std::size_t d = 0; d < Block::rows; ++d) {
        const double size = std::max(1., double(exact[l].norm())),
                     solution = double(exact[l][Eigen::Index(d)]);
        worst = std::max(worst, std::abs(double(r[d][l]) - solution) / size);
        if (alone) worst = std::max(worst, std::abs(double(single[d]) - solution) / size);
      }
    }
  }
  CHECK(worst < 1e3 * double(std::numeric_limits<T>::epsilon()));
  for (const int count : {open, rolls, slips, both, neither}) CHECK(count > 10);
}

TEST_CASE("a contact that does not roll is solved by one visit") {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  using Block = RoundBlock<S>;
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    const RollingBlock<S> problem = round_block<S>(random);
    const RollingResistance<> law(0.5, 3);
    Row b, exact;
    for (double& x : b) x = normal(random);
    b[0] -= 2;
    exact = law.solve(problem, b, Row(Row::Zero()));
    const Row u = problem * exact + b;
    if (angular<S>(u).norm() > 1e-10 || u.segment<2>(1).norm() > 1e-10) continue;
    ++count;
    Block block = Block::unit();
    block.set(0, problem);
    typename Block::Vector lanes{}, guess{};
    for (std::size_t d = 0; d < Block::rows; ++d) {
      lanes[d][0] = b[Eigen::Index(d)];
      guess[d][0] = normal(random);
    }
    Block::Memory memory{};
    const auto r = RollingResistance<>::solve_lanes<S>(
        block, lanes, guess, {Block::Number::broadcast(0.5), Block::Number::broadcast(3)}, memory,
        false);
    for (std::size_t d = 0; d < Block::rows; ++d)
      CHECK(std::abs(r[d][0] - exact[Eigen::Index(d)]) <= 1e-13 * (1 + exact.norm()));
  }
  CHECK(count > 100);
}

TEST_CASE("a round block stands for any other: the difference is not negative") {
  std::mt19937_64 random(8);
  for (int i = 0; i < 1000; ++i) {
    const RollingBlock<S> block = eccentric_block(random);
    RoundBlock<S> lanes = RoundBlock<S>::unit();
    lanes.set(0, block);
    const Matrix6 of_lanes = lanes[0].matrix(), of_block = block.matrix();
    Matrix6 above;
    for (int k = 0; k < 36; ++k) above.data()[k] = of_lanes.data()[k] - of_block.data()[k];
    for (int k = 0; k < 6; ++k) above(k, k) += 1e-12 * block.trace();
    CHECK(invert_definite(above));
  }
}

TEST_CASE("a point on the cone is its own projection") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.1, 1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k) {
    const RollingResistance<> law(part(random), part(random));
    Row x;
    for (double& v : x) v = normal(random);
    const Row p = law.project(x);
    CHECK((law.project(p) - p).norm() <= 1e-14 * p.norm());
    // The distance to the cone is orthogonal to it, and in its polar cone.
    CHECK(std::abs(p.dot(x - p)) < 1e-13 * x.squaredNorm());
  }
}

TEST_CASE("the local problem is solved for any friction and any levers") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int k = 0; k < 4000; ++k) {
    const RollingBlock<S> block = eccentric_block(random);
    const RollingResistance<> law(0.3 + 1.7 * part(random), 0.5 * part(random));
    Row b;
    for (double& v : b) v = normal(random);
    b[0] = -std::abs(b[0]);
    const Row r = law.solve<S>(block, b, Row::Zero());
    const double scale = (block.point.matrix().trace() + block.spin.trace()) / 6;
    // The map jumps at r = 0 and where a limit is met exactly: one of the neighbours solves it, too.
    double least = 1;
    for (const double factor : {1.0, 1 + 1e-13, 1 - 1e-13}) {
      const Row x = factor * r;
      least =
          std::min(least, law.natural_map(Row(block * x + b), Row(scale * x)).norm() / b.norm());
    }
    worst = std::max(worst, least);
  }
  CHECK(worst < 1e-8);
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("float: the local solution of bodies of 1e-6 m to 1e6 m is that of 1 m") {
  using F = Space<3, float>;
  RollingBlock<F> block;
  block.point.normal = 1;
  block.point.coupling.setZero();
  block.point.slip = {3.0f, 3.5f};
  block.cross = F::lever(F::Vector(0.5f * F::Vector::UnitX()));
  block.spin = 2 * F::Inertia::Identity();
  const RollingResistance<float> law(0.5f, 0.2f);
  RollingBlock<F>::Vector b;
  b << -1, 0.3f, 0.2f, 0.5f, -0.4f, 0.3f;
  const RollingBlock<F>::Vector none = RollingBlock<F>::Vector::Zero(),
                                one = law.solve<F>(block, b, none);
  CHECK(angular<F>(one).norm() == doctest::Approx(0.2f * one[0]).epsilon(1e-5));
  for (const int power : {-50, -30, 50, 70}) {
    CAPTURE(power);
    const float mass = std::ldexp(1.0f, power);
    RollingBlock<F> other = block;
    other *= 1 / mass;
    const RollingBlock<F>::Vector r = law.solve<F>(other, b, none) / mass;
    CHECK((r - one).norm() < 1e-5f * one.norm());
    // A block that is not round is doubled, whatever its unit.
    other.cross(0, 0) += 0.3f / mass;
    block.cross(0, 0) = 0.3f;
    LocalBlock<F> of_one = block.point, of_other = other.point;
    CHECK(detail::round_couple<F>(other, of_other)[1] * mass ==
          doctest::Approx(detail::round_couple<F>(block, of_one)[1]));
    CHECK(of_other.normal * mass == of_one.normal);
    block.cross(0, 0) = 0;
  }
}
#endif
