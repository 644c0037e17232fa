// SPDX-License-Identifier: MIT
// The lanes of solve_lanes converge to a solution of the law from any initial value in a few
// visits.

#include "moreau/law/detail/coulomb_lanes.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "moreau/law/signorini_coulomb.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

/// As many local problems as there are lanes. Some have an open contact, some have no friction.
template <class S>
struct Lanes {
  using T = typename S::Scalar;
  using Block = LaneBlock<S>;
  using Number = typename Block::Number;
  static constexpr std::size_t count = std::size_t{Number::lanes};

  std::array<LocalBlock<S>, count> blocks;
  std::array<typename S::Vector, count> velocities;
  std::array<T, count> frictions;
  Block block = Block::unit();
  typename Block::Vector velocity{};
  typename Number::Values friction{}, alpha{};

  explicit Lanes(std::mt19937_64& random, T scale) {
    std::normal_distribution<double> normal;
    for (std::size_t l = 0; l < count; ++l) {
      typename S::Matrix a;
      for (auto& x : a.reshaped()) x = static_cast<T>(normal(random));
      for (auto& x : velocities[l]) x = scale * static_cast<T>(normal(random));
      typename S::Matrix w = a * a.transpose() + T(1e-3) * S::Matrix::Identity();
      w /= w.trace();
      Eigen::Matrix<T, S::dim - 1, S::dim - 1> turn;
      blocks[l] = align_tangents<S>(w, turn);
      frictions[l] = random() % 8 == 0 ? T(0) : static_cast<T>(std::abs(normal(random)));
      block.set(l, blocks[l]);
      for (std::size_t d = 0; d < S::dim; ++d) velocity[d][l] = velocities[l][Eigen::Index(d)];
      friction[l] = frictions[l];
    }
  }
  typename Block::Vector visit(bool polish) {
    return detail::CoulombLanes<S>::solve(block, velocity, friction, alpha, polish);
  }
  /// The residual of the natural map in a lane, relative to |r| + |b|, where W has trace 1.
  double error(const typename Block::Vector& r, std::size_t l) const {
    typename S::Vector own;
    for (std::size_t d = 0; d < S::dim; ++d) own[Eigen::Index(d)] = r[d][l];
    const typename S::Vector u = blocks[l] * own + velocities[l];
    return double(SignoriniCoulomb<T>(frictions[l]).natural_map(u, own).norm() /
                  (own.norm() + velocities[l].norm()));
  }
};

}  // namespace

TEST_CASE_TEMPLATE("one visit comes near, a few are exact", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(11);
  double first = 0, last = 0;
  for (const T scale : {T(1), T(1e-12)})
    for (int i = 0; i < 2000; ++i) {
      Lanes<S> lanes(random, scale);
      const auto start = lanes.visit(false);
      for (int k = 0; k < 3; ++k) lanes.visit(false);
      const auto end = lanes.visit(true);
      for (std::size_t l = 0; l < Lanes<S>::count; ++l) {
        first = std::max(first, lanes.error(start, l));
        last = std::max(last, lanes.error(end, l));
      }
    }
  CHECK(first < 0.1);
  CHECK(last < 1e4 * double(std::numeric_limits<T>::epsilon()));
}

TEST_CASE_TEMPLATE("alpha remembered from another velocity does no harm", S,
                   MOREAU_TYPES((Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal;
  double last = 0;
  for (int i = 0; i < 2000; ++i) {
    Lanes<S> lanes(random, T(1));
    for (std::size_t l = 0; l < Lanes<S>::count; ++l)
      lanes.alpha[l] = static_cast<T>(std::exp(8 * normal(random)));
    for (int k = 0; k < 4; ++k) lanes.visit(false);
    const auto end = lanes.visit(true);
    for (std::size_t l = 0; l < Lanes<S>::count; ++l) last = std::max(last, lanes.error(end, l));
  }
  CHECK(last < 1e4 * double(std::numeric_limits<T>::epsilon()));
}

TEST_CASE_TEMPLATE("the natural map of a lane is that of the law", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(14);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    Lanes<S> lanes(random, T(1));
    auto r = lanes.visit(i % 2 == 0);
    if (i % 3 == 0)
      for (auto& row : r) row *= T(2);  // outside of the cone, or none if the contact is open
    if (i % 5 == 0) lanes.velocity = {};
    const auto map = detail::CoulombLanes<S>::natural_map(lanes.velocity, r, lanes.friction);
    for (std::size_t l = 0; l < Lanes<S>::count; ++l) {
      typename S::Vector u, own, of_lane;
      for (std::size_t d = 0; d < S::dim; ++d) {
        u[Eigen::Index(d)] = lanes.velocity[d][l];
        own[Eigen::Index(d)] = r[d][l];
        of_lane[Eigen::Index(d)] = map[d][l];
      }
      const auto one = SignoriniCoulomb<T>(lanes.frictions[l]).natural_map(u, own);
      const double size = double((1 + lanes.frictions[l]) * (u.norm() + own.norm()));
      if (size > 0) worst = std::max(worst, double((of_lane - one).norm()) / size);
    }
  }
  CHECK(worst < 8 * double(std::numeric_limits<T>::epsilon()));
}

TEST_CASE("a polished impulse that slips lies on the cone to the last digit") {
  std::mt19937_64 random(13);
  int slips = 0;
  for (int i = 0; i < 500; ++i) {
    Lanes<Space<3>> lanes(random, 1.0);
    const auto r = lanes.visit(true);
    for (std::size_t l = 0; l < Lanes<Space<3>>::count; ++l) {
      const double tangential = std::hypot(r[1][l], r[2][l]), limit = lanes.frictions[l] * r[0][l];
      CHECK(tangential <= limit * (1 + 0.01));
      const bool near = std::abs(tangential - limit) < 0.01 * limit;
      slips += near && limit > 0;
    }
  }
  CHECK(slips > 300);
}

TEST_CASE_TEMPLATE("loads of any size have finite impulses in the cone", S,
                   MOREAU_TYPES((Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  using Block = LaneBlock<S>;
  using Number = typename Block::Number;
  const Block block = Block::unit();
  const auto friction = Number::broadcast(T(0.5));
  for (const double speed : {0.0, 1e-9, 1e-3, 1.0})
    for (double load = 1; load > 1e-46; load /= 10)
      for (const double start : {0.0, 1.0, 1e10, 1e30}) {
        typename Block::Vector b{Number::broadcast(static_cast<T>(-load)),
                                 Number::broadcast(static_cast<T>(speed)),
                                 Number::broadcast(static_cast<T>(speed / 2))};
        auto alpha = Number::broadcast(static_cast<T>(start));
        const auto r = detail::CoulombLanes<S>::solve(block, b, friction, alpha, true);
        const double tangential = std::hypot(double(r[1][0]), double(r[2][0]));
        INFO("load ", load, ", speed ", speed, ", alpha ", start);
        CHECK(std::isfinite(double(r[0][0])));
        CHECK(tangential <= 0.51 * double(r[0][0]) + 1e-38);
      }
}

TEST_CASE_TEMPLATE("the square root of lanes is that of numbers", T,
                   MOREAU_TYPES((double), (float))) {
  using Limits = std::numeric_limits<T>;
  std::mt19937_64 random(17);
  const auto check = [&]<class Lanes>(Lanes, T x) {
    const auto root = Lanes::square_root(Lanes::broadcast(x));
    for (std::size_t l = 0; l < std::size_t{Lanes::lanes}; ++l) CHECK(root[l] == std::sqrt(x));
  };
  const auto check_all = [&](T x) {
    check(detail::Wide<T, 16>(), x);
    check(detail::Wide<T, detail::register_bytes>(), x);
    check(detail::Wide<T, detail::widest_bytes>(), x);
  };
  for (const T x :
       {T(0), T(1), Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity()})
    check_all(x);
  for (int i = 0; i < 100; ++i)
    check_all(static_cast<T>(std::ldexp(1 + double(random() % 1000) / 1000, i - 50)));
}

// Two balls on an axis: what mixes the tangents is then zero or a rounding, and the cotangent of twice the angle of
// their turn has a square that is not finite in single precision.
TEST_CASE_TEMPLATE("tangents that hardly mix are turned by a finite angle", S,
                   MOREAU_TYPES((Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  using Number = typename LaneBlock<S>::Number;
  for (double mixed = 1; mixed > 1e-40; mixed /= 10) {
    const std::array<T, 6> w{T(1), T(0), T(2), T(0), static_cast<T>(1e-3 * mixed), T(3)};
    std::array<typename Number::Values, 6> lanes;
    for (std::size_t k = 0; k < 6; ++k) lanes[k] = Number::broadcast(w[k]);
    const auto aligned = detail::aligned_block<S, Number>(lanes);
    INFO("mixed by ", mixed);
    CHECK(double(aligned.block.slip[0][0]) == doctest::Approx(2).epsilon(1e-5));
    CHECK(double(aligned.block.slip[1][0]) == doctest::Approx(3).epsilon(1e-5));
    CHECK(double(aligned.turn[0][0][0]) == doctest::Approx(1).epsilon(1e-5));
  }
}
