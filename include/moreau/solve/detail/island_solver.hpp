// SPDX-License-Identifier: MIT
// Solves small islands of a contact problem by a direct method, and estimates the error of the
// velocities of their bodies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/contact_islands.hpp"
#include "moreau/solve/detail/island_newton.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau::detail {

/// The small islands of one contact problem: those of at most most_bodies bodies and at least two contacts
/// whose factorization is cheap. A single contact is solved exactly by every sweep. Keeps its memory.
template <class Operator, class Law>
class IslandSolver {
 public:
  using Problem = ContactProblem<Operator, Law>;
  using Impulse = typename Operator::Vector;
  using Impulses = std::span<Impulse>;
  static constexpr std::size_t most_bodies = 200;

  /// Finds the small islands and solves those for which a few Newton steps from the warm start are enough.
  /// @param tolerance on the error of the velocities, see SolveReport::velocity_error [-]
  void start(const Problem& problem, Impulses impulses, double tolerance) {
    tolerance_ = tolerance;
    islands_.find(problem.delassus);
    small_.clear();
    others_ = false;
    for (std::size_t k = 0; k < islands_.size(); ++k) {
      if (islands_.contacts(k).size() < 2 || islands_.bodies(k) > most_bodies ||
          !take(problem, k)) {
        others_ = true;
        continue;
      }
      small_.push_back({k, solve(impulses, {tolerance, least_epsilon, least_epsilon, warm_steps})});
    }
  }
  bool empty() const { return small_.empty(); }  ///< no island is small
  /// Whether all contacts lie in small islands that are solved.
  bool all_solved() const {
    return !others_ && std::all_of(small_.begin(), small_.end(),
                                   [&](const Small& one) { return is_solved(one); });
  }
  /// Saves the impulses, which sweeps change.
  void save(Impulses impulses) { saved_.assign(impulses.begin(), impulses.end()); }
  /// After sweeps: goes back to the saved impulses of the islands that were solved, and solves the others
  /// from the impulses of the sweeps.
  void finish(const Problem& problem, Impulses impulses) {
    for (Small& one : small_) {
      if (is_solved(one)) {
        for (const std::uint32_t c : islands_.contacts(one.island)) impulses[c] = saved_[c];
        continue;
      }
      take(problem, one.island);
      one.error = solve(impulses, {tolerance_, first_epsilon, least_epsilon, most_steps});
    }
  }
  /// Writes what the islands have come to.
  void write(SolveReport& report) const {
    report.islands = int(small_.size());
    report.unsolved_islands = 0;
    report.velocity_error = 0;
    for (const Small& one : small_) {
      report.velocity_error = std::max(report.velocity_error, one.error);
      report.unsolved_islands += !is_solved(one);
    }
  }

 private:
  using Newton = IslandNewton<Operator, Law>;
  struct Small {
    std::size_t island;
    double error;  // relative [-]
  };
  static constexpr int warm_steps = 6, most_steps = 60;
  static constexpr double first_epsilon = 1e-4, least_epsilon = 1e-6;

  bool is_solved(const Small& one) const { return one.error <= tolerance_; }
  /// Gives an island to the direct method.
  /// @returns whether its factorization is cheap
  bool take(const Problem& problem, std::size_t island) {
    const auto contacts = islands_.contacts(island);
    newton_.assign(
        problem.delassus, contacts, [&](std::size_t body) { return islands_.moves(body); },
        [&](std::size_t c) { return problem.delassus.free_velocity(c); },
        [&](std::size_t c) -> const Law& { return problem.law(c); });
    return newton_.is_cheap(contacts.size());
  }
  double solve(Impulses impulses, const typename Newton::Precision& precision) {
    const double error = newton_.solve(impulses, precision);
    const bool last = precision.most_steps == most_steps;
    if (error <= tolerance_ || (last && newton_.is_better())) newton_.finish(impulses);
    return error;
  }

  double tolerance_ = 0;
  bool others_ = false;  // contacts outside of small islands
  ContactIslands islands_;
  Newton newton_;
  std::vector<Small> small_;
  std::vector<Impulse> saved_;
};

}  // namespace moreau::detail
