// SPDX-License-Identifier: MIT
// The requirements on every set-valued law. A new law is tested by one line:
//
//   TEST_CASE("my law") { conformance::set_valued_law<moreau::Space<3>>(MyLaw(...)); }
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/law/concepts.hpp"

namespace conformance {

/// Types of the block and the vectors in the local problem of a law.
template <class S, class Law>
using BlockOf =
    std::conditional_t<moreau::RollingLaw<Law, S>, moreau::RollingBlock<S>, moreau::LocalBlock<S>>;

/// A random local problem. The condition number of W is at most about 1e4, or 20 if the law has
/// couples. W is scaled to trace one.
template <class S, class Law>
struct LocalProblem {
  using T = typename S::Scalar;
  using Block = moreau::BlockOf<Law, S>;
  using Vector = std::decay_t<decltype(std::declval<Block>() * typename Block::Vector())>;
  static constexpr int rows = Vector::RowsAtCompileTime;

  Block block;
  Vector velocity, guess;

  explicit LocalProblem(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    Eigen::Matrix<T, rows, rows> a;
    for (auto& x : a.reshaped()) x = static_cast<T>(normal(random));
    for (auto& x : velocity) x = static_cast<T>(normal(random));
    for (auto& x : guess) x = static_cast<T>(normal(random));
    const T least = rows > S::dim ? T(1) : T(1e-3);
    Eigen::Matrix<T, rows, rows> w =
        a * a.transpose() + least * Eigen::Matrix<T, rows, rows>::Identity();
    w /= w.trace();
    set(block, w);
  }

 private:
  using Turn = Eigen::Matrix<T, S::dim - 1, S::dim - 1>;
  static void set(moreau::LocalBlock<S>& out, const typename S::Matrix& w) {
    Turn turn;
    out = moreau::align_tangents<S>(w, turn);
  }
  static void set(moreau::RollingBlock<S>& out, const Eigen::Matrix<T, rows, rows>& w) {
    Turn turn;
    out.point = moreau::align_tangents<S>(w.template topLeftCorner<S::dim, S::dim>(), turn);
    out.cross = w.template topRightCorner<S::dim, S::angular_dim>();
    out.cross.template bottomRows<S::dim - 1>() =
        turn.transpose() * out.cross.template bottomRows<S::dim - 1>();
    out.spin = w.template bottomRightCorner<S::angular_dim, S::angular_dim>();
  }
};

/// The kind of a law in the normal direction. A law for which u_n < 0 is possible with r_n > 0,
/// such as a compliant law, does not obey Signorini's condition: `other`.
enum class Normal { signorini, other };

/// Checks the offset of the normal velocity. A positive gap may close within the step but not more
/// than close, or the offset is infinite, so that the contact cannot act before the gap has closed.
/// If the contact overlaps at rest or is opening, the offset is zero. If it is closing, the offset
/// is between zero and minus the approach velocity (restitution).
/// The offset of a compliant law is gap / step for an overlap, too.
template <class S, class Law>
void check_offset(const Law& law) {
  using T = typename S::Scalar;
  const T gap = T(1e-3), step = T(1e-2), speed = T(0.3);
  const T ahead = law.velocity_offset(gap, -speed, step);
  CHECK((std::isinf(ahead) || std::abs(ahead - gap / step) <= T(1e-5) * gap / step));
  CHECK(ahead > T(0));
  if constexpr (moreau::CompliantLaw<Law, S>)
    if (!law.keeps_normal_impulse()) {
      CHECK(law.velocity_offset(-gap, -speed, step) == doctest::Approx(-gap / step));
      return;
    }
  CHECK(law.velocity_offset(-gap, T(0), step) == T(0));
  CHECK(law.velocity_offset(-gap, speed, step) == T(0));
  const T back = law.velocity_offset(-gap, -speed, step);
  CHECK(back <= T(0));
  CHECK(back >= -speed);
}

/// Checks the solution of random local problems:
///   - It satisfies the natural map of the law, for any initial guess and any unit of the impulse.
///   - A point near the solution does not satisfy the natural map.
///   - It satisfies Signorini's condition, independently of natural_map.
///   - It is proportional to the velocity, unless the law has constants with a unit.
///   - Tangential impulses do no positive work.
/// The offset of the normal velocity is checked by check_offset.
template <class S, class Law>
requires moreau::SetValuedLaw<Law, S>
void set_valued_law(const Law& law, int problems = 5000, Normal normal = Normal::signorini) {
  using T = typename S::Scalar;
  using Problem = LocalProblem<S, Law>;
  using Vector = typename Problem::Vector;
  constexpr double epsilon = double(std::numeric_limits<T>::epsilon());
  std::mt19937_64 random(7);
  double map = 0, guessed = 0, scaled = 0, driven = 0, pressed = 0, beside = 1, lowest = 0;
  int open = 0;
  for (int i = 0; i < problems; ++i) {
    const Problem p(random);
    const Vector r = law.solve(p.block, p.velocity, p.guess);
    const Vector u = p.block * r + p.velocity;
    const double size = double(r.norm() + p.velocity.norm());
    map = std::max(map, double(law.natural_map(u, r).norm()) / size);
    const Vector eightfold = T(8) * r;
    const Vector map_of_eight = moreau::detail::natural_map(law, u, eightfold, T(8));
    map = std::max(map, double(map_of_eight.norm()) / (8 * size));
    pressed =
        std::max({pressed, double(-u[0]) / size, double(std::abs(u[0] * r[0])) / size / size});
    // At a point near the solution the natural map must not vanish. The distance to the solution is
    // a hundredth of the scale.
    const Vector off = r + T(1e-2 * size) * p.guess.normalized();
    const Vector u_off = p.block * off + p.velocity;
    beside = std::min(beside, double(law.natural_map(u_off, off).norm()) / size);
    const Vector again = law.solve(p.block, p.velocity, Vector(Vector::Zero()));
    guessed = std::max(guessed, double((again - r).norm()) / size);
    if constexpr (!requires { law.natural_map(u, r, T(8)); }) {
      const Vector twice = law.solve(p.block, Vector(2 * p.velocity), p.guess);
      scaled = std::max(scaled, double((twice - 2 * r).norm()) / size);
      // Velocities so small that their squares underflow.
      const T small = std::pow(std::numeric_limits<T>::min(), T(0.7));
      const Vector faint = law.solve(p.block, Vector(small * p.velocity), Vector(small * p.guess));
      CHECK(faint.allFinite());
      scaled = std::max(scaled, double((faint / small - r).norm()) / size);
    }
    constexpr int aside = Problem::rows - 1;
    driven = std::max(
        driven, double(u.template tail<aside>().dot(r.template tail<aside>())) / (size * size));
    lowest = std::min(lowest, double(r[0]) / size);
    open += r.isZero(0);
  }
  INFO("Of random contacts, relative to |r| + |b|; solve() must be exact to rounding.");
  {
    INFO("largest |natural_map(u, r)| at the result r of solve(), also with 8 r and scale 8");
    CHECK(map < 1e4 * epsilon);
  }
  {
    INFO("smallest normal impulse of a result");
    CHECK(lowest >= 0);
  }
  {
    INFO("smallest |natural_map| at impulses that are a hundredth beside the solution");
    CHECK(beside > 1e-6);
  }
  if (normal == Normal::signorini) {
    INFO("largest violation of Signorini's condition by the result: -u_n or |u_n r_n|");
    CHECK(pressed < 1e4 * epsilon);
  }
  {
    INFO("largest difference between the results of two guesses");
    CHECK(guessed < 1e5 * epsilon);
  }
  {
    INFO(
        "largest difference between solve(b) and solve(c b) / c: the law has a constant with a "
        "unit, "
        "and natural_map no parameter scale");
    CHECK(scaled < 1e5 * epsilon);
  }
  {
    INFO("largest work of the tangential impulses, which must not drive the contact");
    CHECK(driven < 1e4 * epsilon);
  }
  {
    INFO("number of contacts without impulse, of " << problems);
    CHECK(open > problems / 10);
    CHECK(open < problems - problems / 10);
  }
  check_offset<S>(law);
}

/// Checks that each variant of a stateful law satisfies the requirements on a law, and that the
/// variant of the next step does not depend on the orientation of the tangents.
template <class S, class Law>
requires moreau::StatefulLaw<Law, S>
void stateful_law(const Law& law, Normal normal = Normal::signorini) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static_assert(Law::variants > 0);
  for (std::size_t k = 0; k < Law::variants; ++k) set_valued_law<S>(law.variant(k), 500, normal);
  std::mt19937_64 random(13);
  std::normal_distribution<double> any;
  for (std::size_t k = 0; k < Law::variants; ++k)
    CHECK(law.variant_after(k, Vector(Vector::Zero())) < Law::variants);
  if constexpr (moreau::StaticFrictionLaw<Law, S>)
    for (std::size_t k = 0; k < Law::variants; ++k) {
      CHECK(law.variant_at_rest(k) < Law::variants);
      CHECK(law.variant_at_rest(law.variant_at_rest(k)) == law.variant_at_rest(k));
    }
  for (int i = 0; i < 2000; ++i) {
    Vector impulse;
    for (auto& x : impulse) x = T(any(random));
    impulse[0] = std::abs(impulse[0]);
    const std::size_t k = random() % Law::variants, after = law.variant_after(k, impulse);
    CHECK(after < Law::variants);
    Vector turned = impulse;
    turned.template tail<S::dim - 1>() = -impulse.template tail<S::dim - 1>().reverse();
    CHECK(law.variant_after(k, turned) == after);
  }
}

/// Checks that the law attracts, that the attraction decreases with the distance, and that it is
/// zero beyond `range` [m].
template <class S, class Law>
requires moreau::AttractiveLaw<Law, S>
void attractive_law(const Law& law, typename S::Scalar range) {
  using T = typename S::Scalar;
  T last = law.attraction(-range);
  CHECK(std::isfinite(last));
  for (int k = -99; k <= 200; ++k) {
    const T now = law.attraction(range * T(k) / T(100));
    CHECK(now >= T(0));
    CHECK(now <= last);
    last = now;
  }
  CHECK(last == T(0));
}

/// Checks a law with bridges: it is a stateful law with and without a bridge, its attraction falls with the gap, and no
/// step changes the bridge.
/// @param radius of the grains [m]
template <class S, class Law>
requires moreau::BridgingLaw<Law, S>
void bridging_law(const Law& law, typename S::Scalar radius) {
  using T = typename S::Scalar;
  stateful_law<S>(law);
  CHECK(law.reach() > T(0));
  CHECK(std::isfinite(law.reach()));
  T last = law.bridge_force(-law.reach(), radius);
  CHECK(std::isfinite(last));
  for (int k = -99; k <= 100; ++k) {
    const T now = law.bridge_force(law.reach() * T(k) / T(100), radius);
    CHECK(now >= T(0));
    CHECK(now <= last);
    last = now;
  }
  for (std::size_t k = 0; k < Law::variants; ++k)
    for (const bool bridged : {false, true}) {
      const std::size_t with = Law::with_bridge(k, bridged);
      CHECK(with < Law::variants);
      CHECK(Law::is_bridged(with) == bridged);
      CHECK(Law::with_bridge(with, Law::is_bridged(k)) == k);
      const typename S::Vector push = S::Vector::Unit(0) + S::Vector::Unit(1);
      CHECK(Law::is_bridged(law.variant_after(with, push)) == bridged);
      if constexpr (moreau::StaticFrictionLaw<Law, S>)
        CHECK(Law::is_bridged(law.variant_at_rest(with)) == bridged);
    }
}

/// Checks that solve_lanes of a law gives no impulse to lanes without a contact, and to contacts that cannot act in a step, whose b_n
/// is infinite, whatever the memory and the contacts in the other lanes.
template <class S, class Law>
requires moreau::LaneLaw<Law, S>
void lanes_without_impulse(const Law& law) {
  using T = typename S::Scalar;
  using Block = moreau::LaneBlockOf<Law, S>;
  constexpr std::size_t lanes = moreau::LaneBlock<S>::Number::lanes;
  std::mt19937_64 random(7);
  const auto parameters = law.lane_parameters();
  for (int i = 0; i < 100; ++i) {
    Block block = Block::unit();
    typename Block::Vector b{}, r{};
    std::array<typename Block::Values, std::tuple_size_v<decltype(law.lane_parameters())>> wide{};
    b[0] += T(1);
    for (std::size_t l = 0; l < lanes; ++l) {
      if (l % 3 == 0) continue;  // a lane without a contact
      const LocalProblem<S, Law> p(random);
      block.set(l, p.block);
      for (std::size_t d = 0; d < Block::rows; ++d) b[d][l] = p.velocity[Eigen::Index(d)];
      for (std::size_t k = 0; k < parameters.size(); ++k) wide[k][l] = parameters[k];
      if (l % 3 == 1) b[0][l] = std::numeric_limits<T>::infinity();
    }
    typename Block::Memory memory{};
    for (int visit = 0; visit < 5; ++visit) {
      r = Law::solve_lanes(block, b, r, wide, memory, visit == 4);
      for (std::size_t l = 0; l < lanes; ++l)
        for (std::size_t d = 0; d < Block::rows; ++d)
          if (l % 3 == 2)
            CHECK(std::isfinite(r[d][l]));
          else
            CHECK(r[d][l] == T(0));
    }
  }
}

/// Checks that natural_map_lanes of a law is its natural_map() in every lane.
template <class S, class Law>
requires moreau::MapsLanes<Law, S>
void maps_lanes(const Law& law) {
  using T = typename S::Scalar;
  using Block = moreau::LaneBlock<S>;
  using Vector = typename S::Vector;
  std::mt19937_64 random(9);
  std::normal_distribution<T> normal;
  const auto parameters = law.lane_parameters();
  std::array<typename Block::Values, std::tuple_size_v<decltype(law.lane_parameters())>> wide{};
  for (std::size_t k = 0; k < parameters.size(); ++k)
    wide[k] = Block::Number::broadcast(parameters[k]);
  for (int i = 0; i < 300; ++i) {
    typename Block::Vector u{}, r{};
    std::vector<Vector> expected;
    for (std::size_t l = 0; l < Block::Number::lanes; ++l) {
      Vector of_u, of_r;
      for (Eigen::Index d = 0; d < S::dim; ++d) {
        u[std::size_t(d)][l] = of_u[d] = normal(random);
        r[std::size_t(d)][l] = of_r[d] = normal(random);
      }
      expected.push_back(law.natural_map(of_u, of_r));
    }
    const typename Block::Vector map = Law::template natural_map_lanes<S>(u, r, wide);
    for (std::size_t l = 0; l < Block::Number::lanes; ++l)
      for (Eigen::Index d = 0; d < S::dim; ++d)
        CHECK(std::abs(map[std::size_t(d)][l] - expected[l][d]) <=
              T(64) * std::numeric_limits<T>::epsilon());
  }
}

/// Checks that visits with solve_lanes of a law converge to the scalar solution in every lane. As in a
/// solver, a visit subtracts the lane block times the impulse from the velocity under the impulse: for
/// a law with couples the lane block stands for W. Checks lanes without an impulse, and natural_map_lanes(), too.
/// @param visits of each problem
template <class S, class Law>
requires moreau::LaneLaw<Law, S>
void lane_law(const Law& law, int visits = 50) {
  using T = typename S::Scalar;
  using Block = moreau::LaneBlockOf<Law, S>;
  using Vector = typename LocalProblem<S, Law>::Vector;
  constexpr std::size_t lanes = moreau::LaneBlock<S>::Number::lanes;
  std::mt19937_64 random(3);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    Block block = Block::unit();
    typename Block::Vector r{};
    std::vector<LocalProblem<S, Law>> problems;
    std::array<Vector, lanes> exact;
    for (std::size_t l = 0; l < lanes; ++l) {
      const LocalProblem<S, Law>& p = problems.emplace_back(random);
      block.set(l, p.block);
      exact[l] = law.solve(p.block, p.velocity, p.guess);
    }
    const auto parameters = law.lane_parameters();
    std::array<typename Block::Values, std::tuple_size_v<decltype(law.lane_parameters())>> wide{};
    for (std::size_t k = 0; k < parameters.size(); ++k)
      wide[k] = Block::Number::broadcast(parameters[k]);
    typename Block::Memory memory{};
    for (int visit = 1; visit <= visits; ++visit) {
      typename Block::Vector b = block * r;
      for (std::size_t l = 0; l < lanes; ++l) {
        Vector impulse;
        for (std::size_t d = 0; d < Block::rows; ++d) impulse[Eigen::Index(d)] = r[d][l];
        const Vector u = problems[l].block * impulse + problems[l].velocity;
        for (std::size_t d = 0; d < Block::rows; ++d) b[d][l] = u[Eigen::Index(d)] - b[d][l];
      }
      r = Law::solve_lanes(block, b, r, wide, memory, visit == visits);
    }
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t d = 0; d < Block::rows; ++d)
        worst = std::max(worst, std::abs(double(r[d][l] - exact[l][Eigen::Index(d)])) /
                                    (1 + double(exact[l].norm())));
  }
  CHECK(worst < 1e6 * double(std::numeric_limits<T>::epsilon()));
  lanes_without_impulse<S>(law);
  if constexpr (moreau::MapsLanes<Law, S>) maps_lanes<S>(law);
}

}  // namespace conformance
