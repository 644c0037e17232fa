// SPDX-License-Identifier: MIT
// Simulations whose bits must not depend on who does the work: the calling thread, a team of any size, or the
// two in turn. They are compiled as a user compiles them: what a compiler inlines decides whether two ways of
// working round alike.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <memory>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/parallel/thread_team.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace same_bits {

using namespace moreau;

/// Coulomb's law, and an attraction that decays with the gap: a law of a user's own.
template <class T>
class Decaying : public SignoriniCoulomb<T> {
 public:
  explicit Decaying(T friction = 0, T force = 0, T length = 1)
      : SignoriniCoulomb<T>(friction), force_(force), length_(length) {}
  T attraction(T gap) const { return gap <= 0 ? force_ : force_ * std::exp(-gap / length_); }

 private:
  T force_, length_;
};

/// Decides by a rule whether a piece of work is shared, in place of its time: the same in every run.
class RuledThreads final : public TeamThreads {
 public:
  enum class Rule { shared, in_turn, at_random };
  RuledThreads(int size, Rule rule) : pool_(size), rule_(rule) { shares = rule == Rule::shared; }
  int size() const override { return pool_.size(); }
  void run(const Work& work) override { pool_.run(work); }
  bool begin(TimedWork) override {
    number_ = number_ * 6364136223846793005u + 1442695040888963407u;
    if (rule_ == Rule::in_turn) return is_next_ = !is_next_;
    return rule_ == Rule::shared || number_ >> 63 != 0;
  }
  void end(TimedWork, std::size_t) override {}

 private:
  detail::ThreadPool pool_;
  Rule rule_;
  bool is_next_ = false;
  std::uint64_t number_ = 1;
};
inline Team ruled(int size, RuledThreads::Rule rule) {
  return Team(std::make_shared<RuledThreads>(size, rule));
}

/// All numbers of a run, as one number.
class Bits {
 public:
  void add(std::floating_point auto x) {
    hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(double(x))) * 1099511628211u;
    hash_ ^= hash_ >> 29;
  }
  void add(const auto& numbers) requires requires { numbers.begin(); }
  {
    for (const auto x : numbers) add(x);
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037u;
};

inline constexpr double size = 0.02;  // of the grains [m]

/// Grains between a floor and a lid with a mass, which falls on them, in a cell that is periodic along x and
/// has walls along the other horizontal axis. The lid touches so many that it is a hub of the contact problem.
template <class ShapeT, class Law>
class Press {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr int wide = up == 1 ? 66 : 8, high = up == 1 ? 7 : 6;

  Press(const Law& law, const Team& team) : world_(T(size), Materials<Law>(1, law)) {
    world_.set_team(team);
    const T cell = T(1.03 * size), width = wide * cell;
    const ShapeT regular = regular_shape<ShapeT>(T(size));
    const ShapeId shapes[] = {world_.add_shape(regular),
                              world_.add_shape(regular_shape<ShapeT>(T(0.9 * size)))};
    world_.add_wall(Vector::Unit(up), Vector::Zero());
    world_.set_periodic(0, T(0), width);
    if (up > 1) world_.add_wall(Vector::Unit(1), Vector::Zero());
    if (up > 1) world_.add_wall(-Vector::Unit(1), width * Vector::Unit(1));
    T mass = 0, top = 0;  // mass of the grains, height of their highest point
    for (int k = 0; k < high; ++k)
      for (int i = 0; i < wide; ++i)
        for (int j = 0; j < (up > 1 ? wide : 1); ++j) {
          Vector centre = Vector::Constant(cell * (T(j) + T(0.5)));
          centre[0] = cell * (T(i) + T(0.5) + T(0.3) * T(k % 2));
          centre[up] = cell * (T(k) + T(0.5));
          typename S::Angular turn = S::Angular::Constant(T(0.03) * T(i % 10) + T(0.02) * T(j));
          turn[0] += T(0.05) * T(k);
          const Pose<S> pose{centre, S::exp(turn)};
          const BodyId grain = world_.add_grain(shapes[(i + j + k) % 4 / 3], pose, T(2700));
          world_.set_velocity(grain, Vector(-T(0.5) * Vector::Unit(up) +
                                            T(0.1) * std::sin(T(i + 3 * k)) * Vector::Unit(0)));
          mass += world_.bodies().grain_mass[grain.index()];
          top = std::max(top, regular.bounding_box(pose).upper[up]);
        }
    lid_ = world_.add_wall(-Vector::Unit(up), (top + T(size) / 100) * Vector::Unit(up));
    world_.set_wall_mass(lid_, mass);
    world_.set_force(lid_, -T(50) * mass * Vector::Unit(up));
    world_.set_gravity(-T(9.81) * Vector::Unit(up));
  }

  /// @returns all numbers of the steps and of the state after them
  std::uint64_t run(int steps) {
    Bits bits;
    for (int step = 0; step < steps; ++step) {
      const StepReport report = world_.step(T(5e-4));
      bits.add(std::array{double(report.points), double(report.solve.sweeps), report.solve.residual,
                          report.dissipation, report.friction, report.correction.work});
      most_ = std::max(most_, report.points);
      for (const auto& impulse : world_.contacts().impulses) bits.add(impulse);
    }
    for (const auto& pose : world_.bodies().pose) bits.add(pose.position);
    for (const auto& velocity : world_.bodies().velocity) bits.add(velocity);
    return bits.hash();
  }
  std::size_t most_points() const { return most_; }

 private:
  Simulation<ShapeT, Law> world_;
  BodyId lid_{0};
  std::size_t most_ = 0;
};

/// Checks that all ways of working have the same bits: one thread, teams of 2, 3 and 8 that share all work,
/// some of it in turn or at random, and five times a team that decides by the time.
template <class ShapeT, class Law>
void check(const Law& law, int steps = 12) {
  using enum RuledThreads::Rule;
  const auto run = [&](const Team& team) { return Press<ShapeT, Law>(law, team).run(steps); };
  Press<ShapeT, Law> alone(law, Team());
  const std::uint64_t expected = alone.run(steps);
  CHECK(alone.most_points() > 300);  // enough to be shared
  for (const int threads : {2, 3, 8}) CHECK(run(ruled(threads, shared)) == expected);
  CHECK(run(ruled(2, in_turn)) == expected);
  CHECK(run(ruled(3, at_random)) == expected);
  for (int repetition = 0; repetition < 5; ++repetition) CHECK(run(ThreadTeam(2)) == expected);
}

}  // namespace same_bits
