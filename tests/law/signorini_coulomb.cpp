// SPDX-License-Identifier: MIT
#include "moreau/law/signorini_coulomb.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"

#include "law/oracle.hpp"
#include "law/random_blocks.hpp"
#include "types.hpp"

using law_oracle::random_problem;
using moreau::LocalBlock;
using moreau::SignoriniCoulomb;
using moreau::Space;

static_assert(moreau::SetValuedLaw<SignoriniCoulomb<double>, Space<2>>);
static_assert(moreau::SetValuedLaw<SignoriniCoulomb<double>, Space<3>>);
static_assert(moreau::SetValuedLaw<SignoriniCoulomb<float>, Space<3, float>>);

TEST_CASE_TEMPLATE("the local solution satisfies the law, whatever the guess", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  double worst = 0;
  int stick = 0, slip = 0, open = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto problem = random_problem<S>(random);
    typename S::Vector guess;
    for (auto& x : guess) x = static_cast<T>(normal(random));
    if (i % 3 == 0) guess.setZero();
    const SignoriniCoulomb<T> law(static_cast<T>(std::abs(normal(random))));
    const typename S::Vector r = law.solve(problem.block, problem.velocity, guess);
    const typename S::Vector u = problem.block * r + problem.velocity;
    worst = std::max(worst,
                     double(law.natural_map(u, r).norm() / (r.norm() + problem.velocity.norm())));
    CHECK(r[0] >= 0);
    r.isZero(0) ? ++open : (u.norm() < T(1e-4) ? ++stick : ++slip);
  }
  CHECK(worst < 1e4 * double(std::numeric_limits<T>::epsilon()));
  CHECK(stick > 1000);
  CHECK(slip > 1000);
  CHECK(open > 1000);
}

TEST_CASE_TEMPLATE("the local solution is that of the oracle", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  double worst = 0, residual = 0;
  int others = 0;
  constexpr int count = 250000;
  for (int i = 0; i < count; ++i) {
    const auto problem = random_problem<S>(random);
    typename S::Vector guess;
    for (auto& x : guess) x = i % 3 == 0 ? T(0) : static_cast<T>(normal(random));
    const T friction = i % 50 == 0 ? T(0) : static_cast<T>(std::abs(normal(random)));
    const SignoriniCoulomb<T> law(friction);
    const typename S::Vector r = law.solve(problem.block, problem.velocity, guess);
    const typename S::Vector expected =
        law_oracle::solve_coulomb<S>(problem.block, problem.velocity, friction, guess);
    const double size = double(expected.norm()) + double(problem.velocity.norm());
    const double difference = double((r - expected).norm()) / size;
    if (difference < 1e5 * double(std::numeric_limits<T>::epsilon())) {
      worst = std::max(worst, difference);
      continue;
    }
    // With large friction there may be several solutions: both must be one.
    ++others;
    const typename S::Vector u = problem.block * r + problem.velocity;
    residual = std::max(residual, double(law.natural_map(u, r).norm()) / size);
  }
  CHECK(others < count / 1000);
  CHECK(residual < 1e4 * double(std::numeric_limits<T>::epsilon()));
  CHECK(worst < 1e5 * double(std::numeric_limits<T>::epsilon()));
}

TEST_CASE_TEMPLATE("a load of any size along the normal has an impulse in the cone", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  for (const T tilt : {T(0), T(0.3)})
    for (const T mass : {T(1e-6), T(1), T(1e6)})
      for (const T friction : {T(0.4), T(3)})
        for (T load = 1; load > 0; load /= 16) {
          LocalBlock<S> block;
          block.normal = 1 / mass;
          block.coupling.setConstant(tilt);
          block.slip.setConstant(3 / mass);
          typename S::Vector b = S::Vector::Constant(T(0.5));
          b[0] = -load;
          b[1] = -T(1);
          const SignoriniCoulomb<T> law(friction);
          const typename S::Vector r = law.solve(block, b, typename S::Vector(S::Vector::Zero()));
          INFO("dimension ", S::dim, ", load ", load, ", mass ", mass, ", tilt ", tilt);
          CHECK(r.allFinite());
          CHECK(r[0] >= 0);
          CHECK(r.template tail<S::dim - 1>().stableNorm() <=
                friction * r[0] * (1 + 100 * std::numeric_limits<T>::epsilon()) +
                    std::numeric_limits<T>::min());
          const typename S::Vector scaled = r / mass;
          CHECK(law.natural_map(typename S::Vector(block * r + b), scaled).norm() <=
                1e4 * double(std::numeric_limits<T>::epsilon()));
        }
}

TEST_CASE_TEMPLATE("turning the tangents keeps W", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    typename S::Matrix a;
    for (auto& x : a.reshaped()) x = static_cast<T>(normal(random));
    const typename S::Matrix w = a * a.transpose() + S::Matrix::Identity();
    Eigen::Matrix<T, S::dim - 1, S::dim - 1> turn;
    const auto block = moreau::align_tangents<S>(w, turn);
    typename S::Matrix frame = S::Matrix::Identity();
    frame.template bottomRightCorner<S::dim - 1, S::dim - 1>() = turn;
    CHECK((frame * block.matrix() * frame.transpose() - w).norm() <
          T(20) * std::numeric_limits<T>::epsilon() * w.norm());
    CHECK(turn.determinant() == doctest::Approx(1));
    CHECK(std::abs(block.trace() - w.trace()) <
          T(20) * std::numeric_limits<T>::epsilon() * w.trace());
  }
}

TEST_CASE_TEMPLATE("without friction only the normal acts", S, Space<2>, Space<3>) {
  std::mt19937_64 random(3);
  const SignoriniCoulomb<double> law(0);
  for (int i = 0; i < 100; ++i) {
    auto problem = random_problem<S>(random);
    problem.velocity[0] = -1;
    const typename S::Vector r = law.solve(problem.block, problem.velocity, S::Vector::Zero());
    CHECK(r[0] == doctest::Approx(1 / problem.block.normal));
    CHECK(r.tail(S::dim - 1).norm() == 0);
  }
}

TEST_CASE_TEMPLATE("projection on the cone is the nearest point", S, Space<2>, Space<3>) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const SignoriniCoulomb<double> law(0.4);
  for (int i = 0; i < 1000; ++i) {
    typename S::Vector x, y;
    for (auto& v : x) v = normal(random);
    for (auto& v : y) v = normal(random);
    const typename S::Vector p = law.project(x);
    CHECK(p.tail(S::dim - 1).norm() <= 0.4 * p[0] + 1e-14);
    // Moreau's theorem: x - p lies in the normal cone at p.
    CHECK(std::abs((x - p).dot(p)) < 1e-14);
    CHECK((x - p).dot(law.project(y)) < 1e-14);
  }
  // Without friction the cone is a ray. The projection of a point exactly opposite to the ray is
  // the end of the ray.
  const SignoriniCoulomb<double> smooth(0);
  const typename S::Vector unit = S::Vector::UnitX();
  CHECK(smooth.project(typename S::Vector(-unit)).isZero(0));
  CHECK(smooth.project(unit) == unit);
  CHECK(smooth.natural_map(unit, typename S::Vector(S::Vector::Zero())).isZero(0));
}

TEST_CASE("what the law adds to the normal velocity") {
  const SignoriniCoulomb<double> plastic(0.4), elastic(0.4, 0.5);
  CHECK(plastic.velocity_offset(1e-4, -1, 1e-3) == doctest::Approx(0.1));
  CHECK(plastic.velocity_offset(-1e-4, -1, 1e-3) == 0);
  CHECK(std::isinf(elastic.velocity_offset(1e-4, -1, 1e-3)));
  CHECK(elastic.velocity_offset(0, -2, 1e-3) == doctest::Approx(-1));
  CHECK(elastic.velocity_offset(-1e-5, 2, 1e-3) == 0);
}

TEST_CASE("bad values are named") {
  CHECK_THROWS_WITH_AS(SignoriniCoulomb<double>(-0.1),
                       "SignoriniCoulomb: friction = -0.1 must be finite and >= 0",
                       std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(SignoriniCoulomb<double>{nan}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(SignoriniCoulomb<double>(0.1, 1.5),
                       "SignoriniCoulomb: restitution = 1.5 must lie in [0, 1]",
                       std::invalid_argument);
  using Table = moreau::Materials<SignoriniCoulomb<double>>;
  CHECK_THROWS_WITH_AS(Table(0), "Materials: count = 0 must lie in [1, 65535]",
                       std::invalid_argument);
  Table table(2, SignoriniCoulomb<double>(0.3));
  CHECK_THROWS_WITH_AS(
      table.set(moreau::MaterialId(0), moreau::MaterialId(2), SignoriniCoulomb<double>()),
      "Materials::set: b = 2 must be the id of a material", std::invalid_argument);
  table.set(moreau::MaterialId(0), moreau::MaterialId(1), SignoriniCoulomb<double>(0.7));
  CHECK(table(moreau::MaterialId(1), moreau::MaterialId(0)).friction() == 0.7);
  CHECK(table(moreau::MaterialId(1), moreau::MaterialId(1)).friction() == 0.3);
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE_TEMPLATE("float: impulses of 1e-30 N s and of 1e30 N s lie on the cone or inside of it",
                   S, Space<2, float>, Space<3, float>) {
  const SignoriniCoulomb<float> law(0.5f, 0, 0.8f);
  for (const float unit : {1e-30f, 1e-21f, 1.0f, 1e20f, 1e30f}) {
    CAPTURE(unit);
    typename S::Vector impulse = S::Vector::Zero();
    impulse[0] = unit;
    impulse[1] = 0.8f * unit;
    CHECK(law.variant_after(0, impulse) == 1);
    impulse[1] = 0.79f * unit;
    CHECK(law.variant_after(0, impulse) == 0);
    CHECK(law.variant_after(1, impulse) == 1);
    impulse[1] = -0.49f * unit;
    CHECK(law.variant_after(1, impulse) == 0);
  }
}
#endif
