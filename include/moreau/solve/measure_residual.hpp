// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

namespace detail {

/// The part of the trace of W_cc that copies of shared bodies add to that of the whole bodies.
template <class Operator>
MOREAU_COLD double trace_of_copies(const Operator& op, std::size_t c, const SharedBodies& shared) {
  if constexpr (requires { op.block_of_a(c); }) {
    const auto [a, b] = op.bodies(c);
    return double(op.block_of_a(c).trace()) * (1 - 1.0 / shared.copies(a)) +
           double(op.block_of_b(c).trace()) * (1 - 1.0 / shared.copies(b));
  } else {
    return 0;
  }
}

/// The trace of W_cc [1/kg].
template <class Operator>
double trace_of(const Operator& op, std::size_t c) {
  if constexpr (requires { op.trace(c); })
    return double(op.trace(c));
  else
    return double(op.block(c).trace());
}

/// The mean of the diagonal of W, which makes velocities of impulses in residuals [1/kg]; 1 if it is
/// not positive.
template <class Operator>
double mean_diagonal(const Operator& op, SharedBodies* shared = nullptr) {
  constexpr int rows = Operator::Vector::RowsAtCompileTime;
  double sums[] = {0, double(op.size())};
  double& trace = sums[0];
  for (std::size_t c = 0; c < op.size(); ++c) trace += trace_of(op, c);
  if (shared) {
    for (std::size_t c = 0; c < op.size(); ++c) trace -= trace_of_copies(op, c, *shared);
    shared->sum(sums);
  }
  return trace > 0 ? trace / (sums[1] * rows) : 1;
}

}  // namespace detail

namespace detail {

/// The square of the natural map of a law, in the unit of u and r. Compiled once per law: the residual asks twice for it,
/// and g++ inlines only a part of so much code, for each law another one.
template <class Law, class Vector>
MOREAU_COMPILED_ONCE double natural_map2(const Law& law, const Vector& u, const Vector& r,
                                         typename Vector::Scalar scale) {
  return double(natural_map(law, u, r, scale).squaredNorm());
}

/// The sums of measure_residual() over some contacts.
template <class Operator, class Law>
struct ResidualSums {
  double map = 0, norm = 0, approach = 0, closing = 0;  // squared
  double dissipation = 0;                               // of the wrong sign
  double velocity = 0, cone = 0, complementarity = 0;   // largest violations

  void add(const ResidualSums& other) {
    map += other.map;
    norm += other.norm;
    approach += other.approach;
    closing += other.closing;
    dissipation += other.dissipation;
    velocity = std::max(velocity, other.velocity);
    cone = std::max(cone, other.cone);
    complementarity = std::max(complementarity, other.complementarity);
  }
  /// Writes the measures that follow from the sums.
  void write(SolveReport& report) const {
    report.worst_velocity = velocity;
    report.worst_cone = cone;
    report.worst_complementarity = complementarity;
    report.wrong_sign_dissipation = dissipation;
    report.residual = norm > 0 ? std::sqrt(map / norm) : std::sqrt(map);
    // The map has the rounding of r at least: impulses so large that the velocities vanish in it show
    // nothing else. Beside the map stands the approach velocity, because with large mu the map of an
    // approach with slip and without impulse is only 1/mu of the approach.
    const double rounding = double(std::numeric_limits<typename Operator::Scalar>::epsilon());
    const double remaining = std::max(map + rounding * rounding * norm, closing);
    report.relative_approach = approach > 0 ? std::sqrt(remaining / approach) : 0;
    if (std::isfinite(map) && std::isfinite(norm)) return;
    report.residual = report.relative_approach = std::numeric_limits<double>::infinity();
  }
  /// Sets errors to zero that are not larger than the rounding of the velocities of the bodies, unless a load is larger.
  void forgive_rounding(const ContactProblem<Operator, Law>& problem) {
    double largest = 0;
    for (const auto x : problem.rounding) largest = std::max(largest, double(x));
    constexpr double several = 100;
    if (largest == 0 || !(norm + approach <= several * double(problem.size()) * largest * largest))
      return;
    double least =
        0;  // the rounding at the contacts; other bodies, which can be faster, are not counted
    for (std::size_t c = 0; c < problem.size(); ++c) {
      const auto [a, b] = problem.delassus.bodies(c);
      const double own = std::max(double(problem.rounding[a]), double(problem.rounding[b]));
      least += own * own;
    }
    if (!(norm + approach <= several * least)) return;
    if (map <= least) map = 0;
    if (closing <= least) closing = 0;
  }
  /// Makes the sums relative to the loads of contacts that attract, not to the attraction. Velocities up to 32 epsilon times
  /// the impulses of the attraction, and up to the rounding of b, are set to zero: this rounding error is a lower bound for
  /// every solution. Of a push that is larger than twice the attraction, most is load: its rounding is relative to the load.
  /// @param scale makes velocities of impulses [1/kg]
  void relate_to_loads(const ContactProblem<Operator, Law>& problem,
                       std::span<const typename Operator::Vector> impulses,
                       double scale) requires(AttractiveLaw<Law, typename Operator::Space>) {
    const auto& pulls = problem.attraction.pulls;
    if (pulls.empty()) return;
    double pushes = 0;
    norm = 0, approach = problem.attraction.velocity2;
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      typename Operator::Vector load = impulses[c];
      const double most = 2 * double(pulls[c]);
      pushes += std::min(double(load.template cast<double>().squaredNorm()), most * most);
      load[0] -= pulls[c];
      norm += load.template cast<double>().squaredNorm();
      if (pulls[c] != 0) continue;
      const double free = std::min(0.0, double(problem.delassus.free_velocity(c)[0]));
      approach += free * free;
    }
    norm *= scale * scale;
    const double rounding =
        32 * scale * double(std::numeric_limits<typename Operator::Scalar>::epsilon());
    const double least = rounding * rounding * pushes + problem.attraction.rounding2;
    map -= least < map ? least : map;  // stays NaN
    closing -= least < closing ? least : closing;
    approach += least;
  }
  /// Makes the sums those of all processes.
  void add_up(SharedBodies& shared) {
    double sums[] = {map, norm, approach, closing, dissipation};
    double extremes[] = {velocity, cone, complementarity};
    shared.sum(sums);
    shared.largest(extremes);
    map = sums[0], norm = sums[1], approach = sums[2], closing = sums[3], dissipation = sums[4];
    velocity = extremes[0], cone = extremes[1], complementarity = extremes[2];
  }
  /// Adds contact c with impulse r.
  /// @param scale makes velocities of impulses [1/kg]
  void add(const ContactProblem<Operator, Law>& problem, std::size_t c,
           const typename Operator::Vector& r, double scale) {
    using Vector = typename Operator::Vector;
    const Operator& op = problem.delassus;
    const double free = std::min(0.0, double(op.free_velocity(c)[0]));
    approach += free * free;
    if (r[0] == 0 && op.normal_velocity(c) >= 0) return;
    const Vector u = op.velocity(c);
    if (std::isinf(u[0]) && u[0] > 0) return;  // cannot act in this step
    const auto to_velocity = static_cast<typename Operator::Scalar>(scale);
    const Vector scaled = r * to_velocity;
    const double left = u[0] >= 0 ? 0 : double(u[0]);  // NaN stays
    closing += left * left;
    // The map is a difference of impulses and velocities. If the load is as small as the rounding errors of
    // the velocity, as in a free fall, these errors are a lower bound of the map.
    constexpr double rounding =
        8 * double(std::numeric_limits<typename Operator::Scalar>::epsilon());
    const double above = natural_map2(problem.law(c), u, scaled, to_velocity) -
                         rounding * rounding * double(u.squaredNorm());
    map += above <= 0 ? 0 : above;  // NaN stays
    norm += double(scaled.squaredNorm());
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    const double power = double(u.template tail<tangents>().dot(r.template tail<tangents>()));
    velocity = std::max(velocity, -double(u[0]));
    complementarity = std::max(complementarity, std::abs(double(u[0] * r[0])));
    dissipation += std::max(0.0, power);
    const Vector still = Vector::Zero();
    // As a velocity: in single precision the squares of impulses of grains of 1e-6 m or 1e4 m cannot be represented.
    cone =
        std::max(cone, std::sqrt(natural_map2(problem.law(c), still, scaled, to_velocity)) / scale);
  }
};

}  // namespace detail

/// How far impulses and velocities are from solving the contact problem: the natural-map residual
/// and the separate violations of the laws, in one pass over all contacts.
/// @param problem  its operator carries the velocities of the impulses
/// @param impulses one per contact, in its frame, normal first [N s]
/// @param report   out: residual, relative_approach, worst_velocity, worst_cone,
///                 worst_complementarity, wrong_sign_dissipation. The first two are infinite if
///                 velocities or impulses are not finite. Its other fields are not changed
/// @param team     threads that share the work; the result does not depend on it
/// @param shared   bodies shared with contact problems of other processes: the report is then that of
///                 all contacts together; null: none
template <class Operator, class Law>
void measure_residual(const ContactProblem<Operator, Law>& problem,
                      std::span<const typename Operator::Vector> impulses, SolveReport& report,
                      const Team& team = {}, SharedBodies* shared = nullptr) {
  using Sums = detail::ResidualSums<Operator, Law>;
  const double scale = detail::mean_diagonal(problem.delassus, shared);
  Sums sums = detail::sum_of<Sums>(team, problem.size(), [&](Sums& sum, std::size_t c) {
    sum.add(problem, c, impulses[c], scale);
  });
  if constexpr (AttractiveLaw<Law, typename Operator::Space>)
    sums.relate_to_loads(problem, impulses, scale);
  sums.forgive_rounding(problem);
  if (shared) sums.add_up(*shared);
  sums.write(report);
}

}  // namespace moreau
