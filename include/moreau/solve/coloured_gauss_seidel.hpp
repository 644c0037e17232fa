// SPDX-License-Identifier: MIT
// Non-linear Gauss-Seidel made fast: the same fixed point and the same local solutions as
// NonlinearGaussSeidel, with
//
//  - contacts coloured by body, so that each wide instruction works on independent contacts, and
//    each member of a team on others; the bits do not depend on how many they are;
//  - momentum: a sweep starts from r + beta (r - r a sweep ago) and from the body velocities that
//    belong to it, which are extrapolated alike because they are linear in r;
//  - Anderson's mixing instead, where momentum gets no further: with friction a solution can repel
//    the sweeps, which then circle around it for thousands;
//  - contacts that carry nothing and separate left out of the sweeps between two checks; every
//    check visits all.
//
// Whether the result is good is decided by a plain sweep (QM/16) or by the residual of the impulses
// alone; the acceleration has no say in that.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/coloured_sweeps.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"
#include "moreau/solve/team.hpp"

namespace moreau {

/// When the sweeps end, and how they go.
struct ColouredOptions {
  double tolerance = 1e-4;                     ///< on what stop_test names, > 0 [-]
  StopTest stop_test = StopTest::natural_map;  ///< what ends the sweeps
  int max_sweeps = 2000;    ///< cap, >= 1; reached without passing, the report says capped. A solve
                            ///< that is tried again has it twice
  int check_interval = 20;  ///< sweeps from one stopping test to the next, >= 1
  bool accelerate = true;   ///< off: plain sweeps
};

/// The fast solver of a step's contacts; the header says how it differs from the reference.
/// @tparam TeamT who visits the contacts
template <Team TeamT>
class TeamGaussSeidel {
 public:
  using Options = ColouredOptions;
  /// Buffers, kept from step to step.
  template <class Operator, class Law>
  requires PointLaw<Law, typename Operator::Space>
  using Workspace = detail::ColouredSweeps<Operator, Law>;

  /// @throws std::invalid_argument for a tolerance that is not finite and positive, or a cap or an
  ///         interval below 1
  explicit TeamGaussSeidel(const Options& options = {}, const TeamT& team = TeamT{})
      : options_(options), team_(team) {
    detail::require_stopping(options, "ColouredGaussSeidel");
  }

  const Options& options() const { return options_; }  ///< as given

  /// Solves u = W r + b with the law of every contact; see NonlinearGaussSeidel::solve. Sizes are
  /// not checked.
  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& sweeps) const {
    detail::drop_if_not_finite(impulses);
    SolveReport report = attempt(problem, impulses, sweeps, options_.accelerate);
    if (!options_.accelerate || report.relative_approach <= 1) return report;
    // Worse than no impulses at all: driven away, by the warm start or by acceleration. Once more
    // without either.
    const int wasted = report.sweeps;
    std::fill(impulses.begin(), impulses.end(), Operator::Vector::Zero());
    report = attempt(problem, impulses, sweeps, false);
    report.sweeps += wasted;
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(options_); }

  template <class Operator, class Law>
  SolveReport attempt(ContactProblem<Operator, Law>& problem,
                      std::span<typename Operator::Vector> impulses,
                      Workspace<Operator, Law>& sweeps, bool accelerate) const {
    SolveReport report;
    if (problem.size() == 0) return report;
    report.converged = false;
    detail::set_impulses<Operator>(problem.delassus, impulses);
    sweeps.start(problem, impulses, accelerate);
    double believed = 3 * options_.tolerance;  // change per sweep at which the residual may be met
    double least = std::numeric_limits<double>::infinity();
    int unchecked = 0;
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const int block = std::min(options_.check_interval, options_.max_sweeps - report.sweeps);
      for (int k = 1; k < block; ++k)
        if (report.sweeps == 0 && std::has_single_bit(unsigned(k)))
          sweeps.waking_sweep(team_);
        else
          sweeps.sweep(team_);
      sweeps.plain_sweep(team_).write(report);
      report.sweeps += block;
      const double change = std::max(report.quad_dv, report.quad_dvr);
      if (options_.stop_test == StopTest::qm16) {
        report.converged = passes_qm16(report, options_.tolerance);
        if (report.converged) certify(problem, impulses, sweeps, report);
        report.converged = report.converged && detail::is_closed(report);
      } else if (report.quad_dv <= believed || ++unchecked == most_unchecked) {
        unchecked = 0;
        certify(problem, impulses, sweeps, report);
        report.converged = is_solved(report);
        believed = report.quad_dv * options_.tolerance / report.residual;
      }
      if (report.converged) break;
      if (change < kept * least) {
        least = change;
        sweeps.keep();
      } else if (!(change < astray * least)) {
        sweeps.go_back();
      }
    }
    if (!report.converged && std::max(report.quad_dv, report.quad_dvr) > least) sweeps.go_back();
    if (!report.converged) certify(problem, impulses, sweeps, report);
    if (options_.stop_test == StopTest::natural_map) report.converged = is_solved(report);
    report.capped = !report.converged;
    return report;
  }

  /// The change per sweep says little where a contact is nearly singular: after this many checks
  /// that it forbade, the residual is looked at all the same.
  static constexpr int most_unchecked = 16;
  /// Impulses are kept when the change has fallen by `kept`, gone back to when it is `astray` times
  /// what it was: acceleration can drive away.
  static constexpr double kept = 0.5, astray = 1e3;

  bool is_solved(const SolveReport& report) const {
    return report.residual <= options_.tolerance && detail::is_closed(report);
  }

  /// The residual of the impulses as they are, with velocities made from them alone.
  template <class Operator, class Law>
  static void certify(ContactProblem<Operator, Law>& problem,
                      std::span<typename Operator::Vector> impulses,
                      Workspace<Operator, Law>& sweeps, SolveReport& report) {
    sweeps.unpack(impulses);
    detail::set_impulses<Operator>(problem.delassus, impulses);
    sweeps.load_velocities(problem.delassus);
    measure_residual(problem, std::span<const typename Operator::Vector>(impulses), report);
  }

  Options options_;
  TeamT team_;
};

/// The default solver: TeamGaussSeidel on the calling thread.
class ColouredGaussSeidel : public TeamGaussSeidel<SingleThread> {
 public:
  using TeamGaussSeidel::TeamGaussSeidel;
};

}  // namespace moreau
