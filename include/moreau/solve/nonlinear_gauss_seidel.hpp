// SPDX-License-Identifier: MIT
// Non-linear Gauss-Seidel: sweep over the contacts, solve each exactly with all others held, apply
// what changed at once (M. Jean, Comput. Methods Appl. Mech. Engrg. 177 (1999) 235).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/sweep_change.hpp"

namespace moreau {

/// Which quantity has to fall below the tolerance.
enum class StopTest {
  natural_map,  ///< SolveReport::residual
  qm16,  ///< LMGC90's: quad_dv, quad_dvr <= tolerance and maxm_dv, maxm_dvr <= 16.67 tolerance. It
         ///< measures the change per sweep and is weaker than the residual.
};

/// LMGC90's criterion of that name, read from a report; the tolerance is relative [-].
inline bool passes_qm16(const SolveReport& report, double tolerance) {
  return std::max(report.quad_dv, report.quad_dvr) <= tolerance &&
         std::max(report.maxm_dv, report.maxm_dvr) <= 16.67 * tolerance;
}

namespace detail {

/// @throws std::invalid_argument for a tolerance or a count out of range
void require_stopping(const auto& options, const char* solver) {
  require(options.tolerance > 0 && std::isfinite(options.tolerance), solver, "tolerance",
          options.tolerance, "must be finite and > 0");
  require(options.max_sweeps >= 1, solver, "max_sweeps", options.max_sweeps, "must be at least 1");
  require(options.check_interval >= 1, solver, "check_interval", options.check_interval,
          "must be at least 1");
}

/// Leaves the operator with the velocities that these impulses make, and nothing else.
template <class Operator>
void apply_alone(Operator& op, std::span<const typename Operator::Vector> impulses) {
  op.clear();
  for (std::size_t c = 0; c < op.size(); ++c)
    if (!impulses[c].isZero(0)) op.apply(c, impulses[c]);
}

/// A warm start of numbers that cannot be squared is none: the sweeps begin from zero.
template <class Vector>
void drop_if_not_finite(std::span<Vector> impulses) {
  const auto is_usable = [](const Vector& r) { return std::isfinite(r.squaredNorm()); };
  if (!std::all_of(impulses.begin(), impulses.end(), is_usable))
    std::fill(impulses.begin(), impulses.end(), Vector::Zero());
}

}  // namespace detail

/// Order of the contacts in consecutive sweeps.
enum class SweepOrder {
  forward,    ///< as they come
  symmetric,  ///< forward and backward in turn
};

/// When the sweeps end, and how they go.
struct GaussSeidelOptions {
  double tolerance = 1e-4;                     ///< on what stop_test names, > 0 [-]
  StopTest stop_test = StopTest::natural_map;  ///< what ends the sweeps
  int max_sweeps = 2000;    ///< cap, >= 1; reached without passing, the report says capped
  int check_interval = 10;  ///< sweeps from one stopping test to the next, >= 1
  /// Factor on each impulse change, in (0, 1] [-]; checks use a plain sweep.
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

  /// @throws std::invalid_argument for a tolerance that is not finite and positive, a cap or an
  ///         interval below 1, a relaxation outside (0, 1]
  explicit NonlinearGaussSeidel(const Options& options = {}) : options_(options) {
    constexpr const char* self = "NonlinearGaussSeidel";
    detail::require_stopping(options, self);
    require(options.relaxation > 0 && options.relaxation <= 1, self, "relaxation",
            options.relaxation, "must lie in (0, 1]");
  }

  const Options& options() const { return options_; }  ///< as given

  /// Solves u = W r + b with the law of every contact. Sizes are not checked.
  /// @param op       the operator W with the free velocities b; it is left with the velocities that
  ///                 the impulses make
  /// @param laws     table of laws
  /// @param law_of   one per contact: its entry in the table
  /// @param impulses one per contact, in: the warm start, out: the solution; in the contact's
  ///                 frame, normal first [N s]; a warm start that is not finite counts as none
  /// @returns what was reached; never throws on failure to converge
  template <class Operator, class Law>
  SolveReport solve(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
                    std::span<typename Operator::Vector> impulses,
                    const Workspace<Operator, Law>& = {}) const {
    SolveReport report;
    detail::drop_if_not_finite(impulses);
    detail::apply_alone<Operator>(op, impulses);
    if (op.size() == 0) return report;
    report.converged = false;
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const int block = std::min(options_.check_interval, options_.max_sweeps - report.sweeps);
      for (int k = 1; k < block; ++k) sweep(op, laws, law_of, impulses, report.sweeps++);
      measuring_sweep(op, laws, law_of, impulses, report);
      ++report.sweeps;
      report.converged = passes(op, laws, law_of, impulses, report);
    }
    if (options_.stop_test == StopTest::qm16 && !report.converged)
      certify(op, laws, law_of, impulses, report);
    report.capped = !report.converged;
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(options_); }

  /// The change of one contact's impulse that solves its local problem.
  template <class Operator, class Law>
  static typename Operator::Vector improve(const Operator& op, const Law& law, std::size_t c,
                                           const typename Operator::Vector& impulse) {
    using Vector = typename Operator::Vector;
    const bool open = impulse[0] == 0;
    if (open && op.normal_velocity(c) >= 0) return Vector::Zero();
    Vector b = op.velocity(c);
    if (!open) b -= op.block(c) * impulse;
    return law.solve(op.block(c), b, impulse) - impulse;
  }

  template <class Operator, class Law>
  void sweep(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
             std::span<typename Operator::Vector> impulses, int number) const {
    using Vector = typename Operator::Vector;
    const auto relaxation = static_cast<typename Operator::Scalar>(options_.relaxation);
    const bool backward = options_.order == SweepOrder::symmetric && number % 2 == 1;
    const std::size_t count = op.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = backward ? count - 1 - k : k;
      const Vector change = relaxation * improve(op, laws[law_of[c]], c, impulses[c]);
      if (change.isZero(0)) continue;
      impulses[c] += change;
      op.apply(c, change);
    }
  }

  /// One plain sweep that also takes LMGC90's measures of what it changed.
  template <class Operator, class Law>
  void measuring_sweep(Operator& op, std::span<const Law> laws,
                       std::span<const std::uint32_t> law_of,
                       std::span<typename Operator::Vector> impulses, SolveReport& report) const {
    using Vector = typename Operator::Vector;
    detail::SweepChange sum;
    for (std::size_t c = 0; c < op.size(); ++c) {
      const Vector change = improve(op, laws[law_of[c]], c, impulses[c]);
      const auto& delassus = op.block(c);
      if (!change.isZero(0)) {
        impulses[c] += change;
        op.apply(c, change);
      }
      if (impulses[c].isZero(0)) continue;
      const Vector dv = delassus * change, wr = delassus * impulses[c];
      sum.add(double(dv.squaredNorm()), double(impulses[c].squaredNorm()), double(wr.squaredNorm()),
              double(impulses[c].dot(wr)));
    }
    sum.write(report);
  }

  template <class Operator, class Law>
  bool passes(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
              std::span<const typename Operator::Vector> impulses, SolveReport& report) const {
    const bool by_change = options_.stop_test == StopTest::qm16;
    if (by_change && !passes_qm16(report, options_.tolerance)) return false;
    certify(op, laws, law_of, impulses, report);
    return (by_change || report.residual <= options_.tolerance) &&
           report.left_over <= SolveReport::most_left_over;
  }

  /// The residual with velocities made of the impulses alone: what many small changes rounded off
  /// must not stay.
  template <class Operator, class Law>
  static void certify(Operator& op, std::span<const Law> laws,
                      std::span<const std::uint32_t> law_of,
                      std::span<const typename Operator::Vector> impulses, SolveReport& report) {
    detail::apply_alone<Operator>(op, impulses);
    measure_residual(op, laws, law_of, impulses, report);
  }

  Options options_;
};

}  // namespace moreau
