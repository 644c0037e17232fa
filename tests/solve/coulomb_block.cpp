// SPDX-License-Identifier: MIT
// One contact with any block, including asymmetric ones: the solution satisfies the law, and for
// symmetric blocks it equals the solution of SignoriniCoulomb.
#include "moreau/solve/detail/coulomb_block.hpp"

#include <doctest/doctest.h>
#include <random>

#include "moreau/law/signorini_coulomb.hpp"

using namespace moreau;

namespace {

template <class S>
struct Case {
  typename S::Matrix w;
  typename S::Vector b;
  double friction;
};

/// A random block whose symmetric part is positive definite, with a condition number of at most
/// about 1e4, plus a skew part.
template <class S>
Case<S> random_case(std::mt19937_64& random, double skew) {
  std::uniform_real_distribution<double> unit(-1, 1);
  typename S::Matrix root, turn, w;
  typename S::Vector b;
  for (int i = 0; i < S::dim; ++i) {
    b[i] = unit(random);
    for (int j = 0; j < S::dim; ++j) {
      root(i, j) = unit(random);
      turn(i, j) = skew * unit(random);
    }
  }
  for (int i = 0; i < S::dim; ++i)
    for (int j = 0; j < S::dim; ++j) {
      w(i, j) = turn(i, j) - turn(j, i) + (i == j ? 1e-4 : 0);
      for (int k = 0; k < S::dim; ++k) w(i, j) += root(i, k) * root(j, k);
    }
  return {w, b, std::abs(unit(random)) * 2};
}

}  // namespace

TEST_CASE_TEMPLATE("the impulse satisfies the law", S, Space<2>, Space<3>) {
  std::mt19937_64 random(1);
  int slips = 0;
  for (int k = 0; k < 20000; ++k) {
    const Case<S> c = random_case<S>(random, 1e-2);
    const typename S::Vector r =
        detail::CoulombBlock<typename S::Matrix>(c.w).solve(c.b, c.friction);
    const typename S::Vector u = c.w * r + c.b;
    const double error = SignoriniCoulomb<>(c.friction).natural_map(u, r).norm();
    CHECK(error <= 1e-9 * (c.b.norm() + r.norm() * c.w.norm()));
    if (r[0] > 0 && u.norm() > 1e-6) ++slips;
  }
  CHECK(slips > 1000);
}

TEST_CASE_TEMPLATE("a symmetric block gives the law's own solution", S, Space<2>, Space<3>) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 5000; ++k) {
    const Case<S> c = random_case<S>(random, 0);
    Eigen::Matrix<double, S::dim - 1, S::dim - 1> turn;
    const LocalBlock<S> block = align_tangents<S>(c.w, turn);
    typename S::Vector turned = c.b, expected;
    turned.template tail<S::dim - 1>() = turn.transpose() * c.b.template tail<S::dim - 1>();
    expected = SignoriniCoulomb<>(c.friction).solve(block, turned, S::Vector::Zero());
    expected.template tail<S::dim - 1>() = (turn * expected.template tail<S::dim - 1>()).eval();
    const typename S::Vector r =
        detail::CoulombBlock<typename S::Matrix>(c.w).solve(c.b, c.friction);
    CHECK((r - expected).norm() <= 1e-7 * expected.norm() + 1e-12);
  }
}

TEST_CASE("blocks without mobility make no impulse that is not a number") {
  using Block = detail::CoulombBlock<Eigen::Matrix3d>;
  const Eigen::Vector3d b(-1, 0.5, 0.2);
  CHECK(Block(Eigen::Matrix3d::Zero()).solve(b, 0.5).isZero(0));
  const Eigen::Matrix3d normal_only = Eigen::Vector3d(2, 0, 0).asDiagonal();
  const Eigen::Vector3d r = Block(normal_only).solve(b, 0.5);
  CHECK(r[0] == doctest::Approx(0.5));
  CHECK(r.tail<2>().norm() == doctest::Approx(0.25));
  CHECK(r.tail<2>().dot(b.tail<2>()) < 0);
  CHECK(Block(normal_only).solve(b, 0.).isApprox(Eigen::Vector3d(0.5, 0, 0)));
  CHECK(Block(normal_only).solve(-b, 0.5).isZero(0));
}
