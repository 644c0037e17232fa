// SPDX-License-Identifier: MIT
// A million random local problems: each law, for one contact and in lanes that are visited until nothing changes, has
// the impulse of the oracle.
#include "law/oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/lane_block.hpp"
#include "moreau/law/rolling_block.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"

#include "law/random_blocks.hpp"

using namespace moreau;

namespace {

/// The agreement of impulses with those of the oracle, relative to |r| + |b|.
template <class T>
struct Agreement {
  double worst = 0;     ///< difference of those that agree
  double residual = 0;  ///< natural map of the others
  int others = 0;       ///< problems with another solution than that of the oracle

  void add(const auto& law, const auto& block, const auto& b, const auto& expected, const auto& r) {
    const double size = double(expected.norm()) + double(b.norm());
    const double difference = double((r - expected).norm()) / size;
    if (difference < bound) {
      worst = std::max(worst, difference);
      return;
    }
    ++others;
    // The map jumps where a limit is met exactly: a neighbour solves it, too.
    double least = std::numeric_limits<double>::infinity();
    const T eps = 8 * std::numeric_limits<T>::epsilon();
    for (const T factor : {T(1), 1 + eps, 1 - eps}) {
      auto near = r;
      near *= factor;
      auto u = b;
      u += block * near;
      least = std::min(least, double(law.natural_map(u, near).norm()) / size);
    }
    residual = std::max(residual, least);
  }
  void check(int count) const {
    MESSAGE("difference " << worst << ", " << others << " other solutions of " << count
                          << ", residual " << residual);
    CHECK(others < count / 1000);
    CHECK(residual < 1e4 * double(std::numeric_limits<T>::epsilon()));
  }
  static constexpr double bound = 1e5 * double(std::numeric_limits<T>::epsilon());
};

constexpr int count = 250000;  // of each of four types

}  // namespace

TEST_CASE_TEMPLATE("points: a million problems", S, Space<2>, Space<3>, Space<2, float>,
                   Space<3, float>) {
  using T = typename S::Scalar;
  using Block = LaneBlock<S>;
  using Number = typename Block::Number;
  constexpr std::size_t lanes = std::size_t{Number::lanes};
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  Agreement<T> alone, in_lanes;
  for (std::size_t done = 0; done < std::size_t(count); done += lanes) {
    std::array<law_oracle::LocalProblem<S>, lanes> problems;
    std::array<T, lanes> friction;
    std::array<typename S::Vector, lanes> expected;
    Block block = Block::unit();
    typename Block::Vector b{}, r{};
    typename Number::Values mu{}, alpha{};
    for (std::size_t l = 0; l < lanes; ++l) {
      problems[l] = law_oracle::random_problem<S>(random);
      friction[l] = (done + l) % 50 == 0 ? T(0) : static_cast<T>(std::abs(normal(random)));
      typename S::Vector guess;
      for (T& x : guess) x = (done + l) % 3 == 0 ? T(0) : static_cast<T>(normal(random));
      expected[l] =
          law_oracle::solve_coulomb<S>(problems[l].block, problems[l].velocity, friction[l], guess);
      const SignoriniCoulomb<T> law(friction[l]);
      alone.add(law, problems[l].block, problems[l].velocity, expected[l],
                law.solve(problems[l].block, problems[l].velocity, guess));
      block.set(l, problems[l].block);
      for (std::size_t d = 0; d < Block::rows; ++d) b[d][l] = problems[l].velocity[Eigen::Index(d)];
      mu[l] = friction[l];
    }
    for (int visit = 1; visit <= 8; ++visit)
      r = detail::CoulombLanes<S>::solve(block, b, mu, alpha, visit == 8);
    for (std::size_t l = 0; l < lanes; ++l) {
      typename S::Vector own;
      for (std::size_t d = 0; d < Block::rows; ++d) own[Eigen::Index(d)] = r[d][l];
      in_lanes.add(SignoriniCoulomb<T>(friction[l]), problems[l].block, problems[l].velocity,
                   expected[l], own);
    }
  }
  alone.check(count);
  in_lanes.check(count);
}

TEST_CASE_TEMPLATE("round contacts with couples: a million problems", S, Space<2>, Space<3>,
                   Space<2, float>, Space<3, float>) {
  using T = typename S::Scalar;
  using Problem = RollingBlock<S>;
  using Row = typename Problem::Vector;
  using Block = RoundBlock<S>;
  constexpr std::size_t lanes = std::size_t{Block::Number::lanes};
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  Agreement<T> alone, in_lanes;
  for (std::size_t done = 0; done < std::size_t(count); done += lanes) {
    std::array<Problem, lanes> problems;
    std::array<RollingResistance<T>, lanes> laws;
    std::array<Row, lanes> velocity, expected;
    Block block = Block::unit();
    typename Block::Vector b{}, r{};
    std::array<typename Block::Values, 2> parameters{};
    for (std::size_t l = 0; l < lanes; ++l) {
      laws[l] = RollingResistance<T>(T(part(random)), T(part(random) * part(random)));
      problems[l] = law_oracle::round_block<S>(random);
      for (T& x : velocity[l]) x = T(normal(random));
      velocity[l][0] -= T(1);
      expected[l] = law_oracle::solve_rolling<S>(problems[l], velocity[l], laws[l].friction(),
                                                 laws[l].rolling());
      alone.add(laws[l], problems[l], velocity[l], expected[l],
                laws[l].solve(problems[l], velocity[l], Row(Row::Zero())));
      block.set(l, problems[l]);
      for (std::size_t d = 0; d < Block::rows; ++d) b[d][l] = velocity[l][Eigen::Index(d)];
      for (std::size_t k = 0; k < 2; ++k) parameters[k][l] = laws[l].lane_parameters()[k];
    }
    typename Block::Memory memory{};
    for (int visit = 1; visit <= 600; ++visit)
      r = RollingResistance<T>::template solve_lanes<S>(block, b, r, parameters, memory,
                                                        visit == 600);
    for (std::size_t l = 0; l < lanes; ++l) {
      Row own;
      for (std::size_t d = 0; d < Block::rows; ++d) own[Eigen::Index(d)] = r[d][l];
      in_lanes.add(laws[l], problems[l], velocity[l], expected[l], own);
    }
  }
  alone.check(count);
  in_lanes.check(count);
}
