// SPDX-License-Identifier: MIT
// Non-linear Gauss-Seidel: sweep over the contacts, solve the local problem of each exactly with
// all other impulses held, apply its change of impulse at once (M. Jean, Comput. Methods Appl.
// Mech. Engrg. 177 (1999) 235).
#pragma once

#include <cstddef>
#include <span>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/sweep_change.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau {

/// Order of the contacts in consecutive sweeps.
enum class SweepOrder {
  forward,  ///< in the order of the contacts
  symmetric,  ///< forward and backward in turn; can converge much faster where points of a pair exchange load
};

/// Options of NonlinearGaussSeidel.
struct GaussSeidelOptions {
  double tolerance = 1e-4;                     ///< on the quantity that stop_test names, > 0 [-]
  StopTest stop_test = StopTest::natural_map;  ///< what ends the sweeps
  int max_sweeps = 2000;    ///< cap, >= 1; if it ends the sweeps, SolveReport::capped is set
  int check_interval = 10;  ///< sweeps from one stopping test to the next, >= 1
  /// Factor on each change of impulse, in (0, 1] [-]. The sweep before a stopping test has none.
  double relaxation = 1;
  SweepOrder order = SweepOrder::forward;  ///< of the contacts
};

/// The reference solver: plain sweeps, one contact after another. It takes every set-valued law.
/// Source: M. Jean, Comput. Methods Appl. Mech. Engrg. 177 (1999) 235.
class NonlinearGaussSeidel {
 public:
  using Options = GaussSeidelOptions;
  /// Needs no buffers.
  template <class Operator, class Law>
  struct Workspace {};

  NonlinearGaussSeidel() = default;
  /// @throws std::invalid_argument for a tolerance that is not finite and positive, a cap or an
  ///         interval below 1, a relaxation outside (0, 1]
  explicit NonlinearGaussSeidel(const Options& options) : options_(options) {
    constexpr const char* self = "NonlinearGaussSeidel";
    detail::require_stopping(options, self);
    require(options.relaxation > 0 && options.relaxation <= 1, self, "relaxation",
            options.relaxation, "must lie in (0, 1]");
  }

  const Options& options() const { return options_; }  ///< as given

  /// Solves u = W r + b with the law of every contact. Sizes are not checked.
  /// @param problem  in: W, b and the laws; out: its operator carries the velocities u of the
  ///                 impulses
  /// @param impulses in: the warm start, out: the solution; one per contact, in its frame, normal
  ///                 first [N s]. A warm start that is not finite is replaced by zero
  /// @returns how well the problem was solved; does not throw if the sweeps do not converge
  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    const Workspace<Operator, Law>& = {}) const {
    SolveReport report;
    detail::drop_if_not_finite(impulses);
    detail::set_impulses<Operator>(problem.delassus, impulses);
    if (problem.size() == 0) return report;
    report.converged = false;
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const int count = std::min(options_.check_interval, options_.max_sweeps - report.sweeps);
      for (int k = 1; k < count; ++k) sweep(problem, impulses, report.sweeps++);
      measuring_sweep(problem, impulses, report);
      ++report.sweeps;
      report.converged = passes(problem, impulses, report);
    }
    if (options_.stop_test == StopTest::qm16 && !report.converged)
      certify(problem, impulses, report);
    report.capped = !report.converged;
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(options_); }

  /// The change of one contact's impulse that solves its local problem.
  template <class Operator, class Law>
  static typename Operator::Vector improve(const ContactProblem<Operator, Law>& problem,
                                           std::size_t c,
                                           const typename Operator::Vector& impulse) {
    using Vector = typename Operator::Vector;
    const Operator& op = problem.delassus;
    const bool open = impulse[0] == 0;
    if (open && op.normal_velocity(c) >= 0) return Vector::Zero();
    Vector b = op.velocity(c);
    if (!open) b -= op.block(c) * impulse;
    return problem.law(c).solve(op.block(c), b, impulse) - impulse;
  }

  template <class Operator, class Law>
  void sweep(ContactProblem<Operator, Law>& problem, std::span<typename Operator::Vector> impulses,
             int number) const {
    using Vector = typename Operator::Vector;
    const auto relaxation = static_cast<typename Operator::Scalar>(options_.relaxation);
    const bool backward = options_.order == SweepOrder::symmetric && number % 2 == 1;
    const std::size_t count = problem.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = backward ? count - 1 - k : k;
      const Vector change = relaxation * improve(problem, c, impulses[c]);
      if (change.isZero(0)) continue;
      impulses[c] += change;
      problem.delassus.apply(c, change);
    }
  }

  /// One sweep without relaxation that also takes LMGC90's measures of its changes.
  template <class Operator, class Law>
  void measuring_sweep(ContactProblem<Operator, Law>& problem,
                       std::span<typename Operator::Vector> impulses, SolveReport& report) const {
    using Vector = typename Operator::Vector;
    detail::SweepChange sum;
    for (std::size_t c = 0; c < problem.size(); ++c) {
      const Vector change = improve(problem, c, impulses[c]);
      const auto& block = problem.delassus.block(c);
      if (!change.isZero(0)) {
        impulses[c] += change;
        problem.delassus.apply(c, change);
      }
      if (impulses[c].isZero(0)) continue;
      const Vector dv = block * change, wr = block * impulses[c];
      const auto r = impulses[c].template cast<double>().eval();  // squares of impulses overflow
      sum.add(double(dv.squaredNorm()), r.squaredNorm(), double(wr.squaredNorm()),
              r.dot(wr.template cast<double>()));
    }
    sum.write(report);
  }

  template <class Operator, class Law>
  bool passes(ContactProblem<Operator, Law>& problem,
              std::span<const typename Operator::Vector> impulses, SolveReport& report) const {
    const bool by_change = options_.stop_test == StopTest::qm16;
    if (by_change && !passes_qm16(report, options_.tolerance)) return false;
    certify(problem, impulses, report);
    return (by_change || report.residual <= options_.tolerance) && detail::is_closed(report);
  }

  /// The residual, with velocities that carry no rounding of the sweeps.
  template <class Operator, class Law>
  static void certify(ContactProblem<Operator, Law>& problem,
                      std::span<const typename Operator::Vector> impulses, SolveReport& report) {
    detail::set_impulses<Operator>(problem.delassus, impulses);
    measure_residual(problem, impulses, report);
  }

  Options options_;
};

}  // namespace moreau
