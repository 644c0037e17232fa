// SPDX-License-Identifier: MIT
// Anderson mixing finds repelling fixed points. It forgets earlier iterates when it is started
// again.

#include "moreau/solve/detail/anderson_mixing.hpp"

#include <Eigen/Core>

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/solve/coloured/acceleration.hpp"

#include "types.hpp"

using namespace moreau::detail;

TEST_CASE_TEMPLATE("a linear map of n numbers is solved in n + 1 steps, stable or not", T,
                   MOREAU_TYPES((double), (float))) {
  using Vector = typename AndersonMixing<T>::Vector;
  constexpr int n = 6;
  // The matrix consists of three rotations, scaled by 1.2, 1.02 and 0.9, the moduli of its
  // eigenvalues.
  T a[n][n] = {};
  const T moduli[] = {T(1.2), T(1.02), T(0.9)};
  for (int k = 0; k < 3; ++k) {
    const T angle = T(0.3 + 0.5 * k);
    a[2 * k][2 * k] = a[2 * k + 1][2 * k + 1] = moduli[k] * std::cos(angle);
    a[2 * k + 1][2 * k] = moduli[k] * std::sin(angle);
    a[2 * k][2 * k + 1] = -moduli[k] * std::sin(angle);
  }
  const auto times_a = [&](const Vector& x) {  // Eigen's products take seconds to compile
    Vector product = Vector::Zero(n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) product[i] += a[i][j] * x[j];
    return product;
  };
  Vector fixed(n);
  for (int k = 0; k < n; ++k) fixed[k] = T(0.6 * k - 1);
  const Vector b = fixed - times_a(fixed);
  AndersonMixing<T> mixing;
  for (const T start : {T(0), T(3)}) {
    Vector x = Vector::Constant(n, start);
    mixing.start(x);
    for (int step = 0; step <= n; ++step) {
      Vector g = times_a(x) + b;
      mixing.mix(g);
      x = g;
    }
    // The result is not exact to rounding: the weights are regularized by 1e-10 of their scale,
    // which causes a relative error of about the square root of 1e-10.
    CHECK((x - fixed).norm() < (sizeof(T) == 8 ? T(1e-5) : T(1e-2)) * fixed.norm());
  }
}

TEST_CASE("mixing that starts at the fixed point stays there") {
  AndersonMixing<double> mixing;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 2.);
  mixing.start(x);
  for (int step = 0; step < 30; ++step) {
    mixing.mix(x);
    CHECK(x == Eigen::VectorXd::Constant(3, 2.));
  }
}

TEST_CASE(
    "Nesterov's momentum stagnates after eight checks without progress, and mixing after as many") {
  Acceleration<double> acceleration;
  const auto checks = [&] {
    int count = 0;
    while (count < 20 && !acceleration.check(1)) ++count;
    return count;
  };
  CHECK(checks() == StagnationTest::checks);
  CHECK(!acceleration.is_mixing());  // left to Nesterov's momentum: the impulses drift
  CHECK(checks() == StagnationTest::checks - 1);
  acceleration.start_mixing();
  CHECK(checks() == 2 * StagnationTest::checks - 1);
  CHECK(!acceleration.is_mixing());
}
