// SPDX-License-Identifier: MIT
// A solver of a step's contacts for problems on which sweeps stall: slender stacks, walls of many
// courses, wedges. Sweeps first; where they do not reach the tolerance, the proximal point method
// on the matrices of the step, from what they reached on. It factorizes matrices of all contacts
// that push, so it is one for hundreds of bodies, not for tens of thousands.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/friction_problem.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/solve/proximal_solver.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

/// Sweeps, and where these stall the proximal point method; the header says for what.
/// @tparam First solves what it can; its options give tolerance and stopping test
template <class First = ColouredGaussSeidel>
class ProximalFallback {
 public:
  using Options = typename First::Options;
  /// Buffers, kept from step to step.
  template <class Operator, class Law>
  requires CoulombLaw<Law, typename Operator::Space>
  struct Workspace {
    typename First::template Workspace<Operator, Law> first;  ///< of the sweeps
    std::vector<typename Operator::Vector> swept;  ///< what they reached, contact frames [N s]
  };

  /// @param options     of the sweeps
  /// @param max_seconds for the rest of a step, after which the best that was found is returned
  ///                    [s]; a finite one makes results depend on the machine
  /// @throws std::invalid_argument as First does, or for a time that is not positive
  explicit ProximalFallback(const Options& options = {},
                            double max_seconds = ProximalOptions{}.max_seconds)
      : first_(options), max_seconds_(max_seconds) {
    require(max_seconds > 0, "ProximalFallback", "max_seconds", max_seconds, "must be > 0");
  }

  const Options& options() const { return first_.options(); }  ///< of the sweeps, as given

  /// Solves u = W r + b with the law of every contact; see NonlinearGaussSeidel::solve. Sweeps
  /// count those of both methods; where the second was needed, convergence is that of the residual,
  /// whatever the stopping test.
  template <class Operator, class Law>
  SolveReport solve(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& workspace) const {
    SolveReport report = first_.solve(op, laws, law_of, impulses, workspace.first);
    if (report.converged) return report;
    workspace.swept.assign(impulses.begin(), impulses.end());
    SolveReport polished = report;
    polish(op, laws, law_of, impulses, polished);
    if (is_nearer(polished, report)) return polished;
    report.sweeps = polished.sweeps;
    std::copy(workspace.swept.begin(), workspace.swept.end(), impulses.begin());
    detail::apply_alone<Operator>(op, impulses);
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(first_, max_seconds_); }

  template <class Operator, class Law>
  void polish(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
              std::span<typename Operator::Vector> impulses, SolveReport& report) const {
    constexpr int rows = Operator::Space::dim;
    using Scalar = typename Operator::Scalar;
    const auto gathered = gather_problem(op, laws, law_of);
    Eigen::VectorXd r(rows * Eigen::Index(gathered.contacts.size()));
    for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
      r.segment<rows>(rows * Eigen::Index(k)) =
          impulses[gathered.contacts[k]].template cast<double>();
    ProximalOptions options;
    options.max_seconds = max_seconds_;
    options.tolerance = tolerance_for(gathered.problem, r);
    const ProblemReport found = ProximalSolver(options).solve(gathered.problem, r);
    std::fill(impulses.begin(), impulses.end(), Operator::Vector::Zero());
    for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
      impulses[gathered.contacts[k]] =
          r.segment<rows>(rows * Eigen::Index(k)).template cast<Scalar>();
    report.sweeps += found.sweeps;
    detail::apply_alone<Operator>(op, impulses);
    measure_residual(op, laws, law_of, std::span<const typename Operator::Vector>(impulses),
                     report);
    report.converged =
        report.residual <= tolerance() && report.left_over <= SolveReport::most_left_over;
    report.capped = !report.converged;
  }

  /// By the residual among those that leave no approach over; it falls where impulses diverge.
  static bool is_nearer(const SolveReport& one, const SolveReport& other) {
    constexpr double most = SolveReport::most_left_over;
    if (one.left_over <= most && other.left_over <= most) return one.residual < other.residual;
    return one.left_over < other.left_over;
  }

  double tolerance() const { return first_.options().tolerance; }
  /// The residual of a step is relative to |r| alone, that of a problem to max(|b|, |r|, |u|).
  template <class S>
  double tolerance_for(const FrictionProblem<S>& problem, const Eigen::VectorXd& r) const {
    const double scaled = delassus_scale(problem) * r.norm();
    const double largest = std::max({problem.free_velocity.norm(), scaled,
                                     (problem.delassus * r + problem.free_velocity).norm()});
    const double share = scaled > 0 ? scaled / largest : 1;
    return 0.5 * share * tolerance();
  }

  First first_;
  double max_seconds_;
};

}  // namespace moreau
