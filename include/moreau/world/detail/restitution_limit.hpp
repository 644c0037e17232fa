// SPDX-License-Identifier: MIT
// The impulses of a step add no kinetic energy: Newton's restitution is limited, and problems are solved until they
// add none.
//
// With friction, or where several contacts of a body act at once, Newton's law of restitution can add energy
// (T. R. Kane and D. A. Levinson, Dynamics: Theory and Applications, 1985, section 5.8). Without restitution
// it cannot: let u_f be the relative velocities without impulses, u = u_f + W r those with the impulses r. The
// impulses change the kinetic energy by
//
//     G(r) = r . u_f + r . W r / 2.
//
// Signorini's and Coulomb's laws without restitution give r . u <= 0, and so G <= -r . W r / 2 <= 0.
//
// External forces act at the same time. Let u_i be the relative velocities before the step, and a = u_f - u_i what the
// forces of the step add to them: gravity, forces and torques of the user, attraction. The bodies move with the mean of
// the velocities before and after (motion/moreau_jean.hpp, theta = 1/2). The kinetic energy and the potential energy of
// the forces together therefore change by the work of the impulses at the mean velocity,
//
//     E(r) = r . (u_i + u) / 2 = G(r) - r . a / 2.
//
// The velocity after an impact is -e u_i, without the forces of the step: at a single contact without friction
// E = -(1 - e) r |u_i| / 2 <= 0. Under gravity G is smaller than E, by a share g h / v of the energy of an impact at the
// speed v.
//
// Let r_e be the impulses with restitution and r_0 those without. If E(r_e) > 0 for an island, a set of
// bodies that impulses connect, its impulses become
//
//     r = r_0 + s (r_e - r_0)
//
// with the largest s in [0, 1] for which E(r) <= max(0, E(r_0)): the root of a parabola. The
// impulses lie in the cones of friction, because these are convex, and the bodies do not approach, because u
// is linear in r.
//
// E(r_0) is positive only in an island without impacts: if a body rises by less than the forces take in the step, its
// contacts stop it, and it rises meanwhile. From G(r_0) <= -r_0 . W r_0 / 2 follows
//
//     E(r_0) <= -r_0 . W r_0 / 2 - r_0 . a / 2 <= sum of h^2 f . M^-1 f / 8,
//
// a quarter of the energy that the forces f give bodies at rest in a step.
//
// An island rests if no contact that acts approaches faster than the forces add in the step, u_i >= min(0, a). There
// G(r) <= 0 is required in place of E. It would otherwise be solved twice in every other step, for speeds below g h.
// Without friction, and if a <= 0, |x|^2 <= -2 r . (u_i + a) <= -4 x . y with x = M^-1/2 J^T r and y = h M^-1/2 f, and so
// E(r) <= -x . y / 2 <= 2 h^2 f . M^-1 f.
//
// Prescribed bodies separate islands, because no impulse changes their motion. A periodic cell that moves by
// its stress is a body that all contacts touch: they are one island, with the energy of the bodies and of the cell, and a
// has what the stress changes of its rate. u and u_f are relative to the prescribed bodies, to the chord of their motion
// where they turn (chord_velocities.hpp). The equations above do not contain the motion of the prescribed bodies, and their work is
// not counted. u_i has the
// spin that belongs to the angular momentum before the step in the configuration of the contacts: that the inertia turns
// is no work of the impulses. With theta > 1/2 the integrator takes energy, which is not counted either.
//
// An approximate r_0 can add energy, within every tolerance on means over the contacts: a heavy body that squeezes a light
// grain against a wall gives it velocities of its own error times the ratio of the masses. Then the problem is solved
// further, from there, and if that does not help, the step is not converged. In any case the impulses of the island are
// multiplied by the largest s for which G(s r_0) <= 0; if this changes no relative velocity by more than a hundred
// thousandth of the largest of the island, or of a hundredth of what the loads of the step give its bodies, the step is as
// solved as it was. Problems without any restitution are treated in the same way.
// The impulses of an island with bonds are not changed: multiplying p = r + h T of a bond by s would change its load r.
// Energy counts from that of the impulses at velocities of 1e-12 of the grain size per step on, or of the rounding of the
// velocities of the bodies: bodies at rest, and those that touch and fall together, move less.
//
// Without restitution and with prescribed walls at rest, the sum of G over the islands is the change of the kinetic energies
// of the bodies, sum of d . M (2 v_f + d) / 2 with the velocities v_f without the impulses and v_f + d with them. M of a
// wall that forces move along some axes is its mass along these, if it is at rest along the others. If no body gains
// energy, as in a packing at rest, no island does. Otherwise the sum over the bodies of an island tells. Only if it is
// positive, the contacts are visited: the sums over them have bounds of their rounding.
//
// A tangential restitution (law/tangential_restitution.hpp) is a part of the restitution: r_0 has neither.
//
// Springs (law/compliant.hpp) store energy. Let c be the compliance of a contact over h^2, s the impulse that
// its spring remembers. The energy of the spring changes by (r . c r - s . c s) / 2, which adds to G. With
// the operator's velocities, u + c (r - s) with the impulses and u_f - c s without, this is
//
//     G(r) = r . (u_f + u + c r) / 2 - s . c s / 2,      E(r) = G(r) - r . a / 2.
//
// Without restitution, r . (u + c (r - s)) <= 0, and so G <= -r . W r / 2 - (r - s) . c (r - s) / 2 <= 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/disjoint_sets.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/world/detail/energy_by_bodies.hpp"
#include "moreau/world/detail/island_energy.hpp"

namespace moreau::detail {

/// The limit of the restitution of a step; the head of this file has its equations.
template <class S, class Law>
class RestitutionLimit {
 public:
  using Scalar = typename S::Scalar;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;
  using Problem = ContactProblem<Operator, Law>;

  void resize(std::size_t contacts) {
    offset_.resize(contacts);
    bounce_.resize(contacts);
    if constexpr (aside) aside_.resize(contacts);
  }
  /// Splits the offset of a contact into that without restitution and the rest. Several threads may call
  /// it for different contacts.
  /// @param offset  velocity_offset(gap, before, step) [m/s]
  /// @param further what is added to it beside the law [m/s], see closing_contacts.hpp
  void set(std::size_t c, const Law& law, Scalar gap, Scalar before, Scalar step, Scalar offset,
           Scalar further) {
    offset_[c] = offset + further;
    bounce_[c] = 0;
    if (before < 0 && std::isfinite(offset))
      bounce_[c] = offset - law.velocity_offset(gap, Scalar(0), step);
  }
  /// Stores the offset across the normal of a contact under a law with tangential restitution [m/s], as set() does.
  void set_aside(std::size_t c, const Row& offset) requires(TangentialRestitutionLaw<Law, S>) {
    aside_[c] = offset;
  }
  /// Limits the impulses of a solved problem; leaves the operator with their velocities.
  /// @param springs          of the contacts: their relaxation(c) and energy_before(c)
  /// @param solver,workspace solve the problem without restitution, if it is needed
  /// @param negligible       velocity at which the impulses add energy that does not count, see negligible_velocity() [m/s]
  /// @param free             v_f of every body, if the contacts see these velocities alone; empty: nothing is known
  /// @param report           of the problem with restitution; becomes that of both
  void apply(const Bodies<S>& bodies, Problem& problem, std::span<Row> impulses,
             const auto& springs, const auto& solver, auto& workspace, Scalar negligible,
             std::span<const typename S::Twist> free, const auto& forced, SolveReport& report) {
    bounces_ = bounces();
    if (!bounces_ && !dissipates) return;
    resting_.resize(impulses.size());  // here, so that a later step need not allocate
    bouncing_.resize(impulses.size());
    islands_.resize(bodies.size());
    if (sets_.size() != bodies.size()) sets_.assign(bodies.size());
    if (!bounces_ && all_lose(bodies, problem, impulses, free)) return;
    negligible_ = negligible;
    measure(problem, impulses, springs, forced, Scalar(0), bouncing_);
    if (!gains(bodies, problem)) return;
    limit(bodies, problem, impulses, springs, solver, workspace, forced, report);
  }
  /// The velocity of bodies at rest, at most [m/s].
  static Scalar negligible_velocity(Scalar grain_size, Scalar step) {
    constexpr Scalar share = std::max(Scalar(1e-12), 16 * std::numeric_limits<Scalar>::epsilon());
    return share * grain_size / step;
  }

 private:
  /// A contact under some impulse.
  struct State {
    Row impulse, velocity;  ///< r [N s] and u + c r, without offset [m/s]
    double gain = 0;        ///< G: r . (u_f + u + c r) / 2 - s . c s / 2 [J]
    double forced = 0;      ///< r . a / 2; 0 if no contact has a restitution [J]
    bool hits = false;      ///< u_i < min(0, a): an impact, unless r is zero
    bool acts = false;      ///< r is not zero
  };
  using Island = IslandEnergy<Scalar>;
  /// Smaller changes of velocities, relative to those of an island, are neglected: as velocity_tolerance of ColouredOptions [-].
  static constexpr double small = std::max(1e-5, Island::rounding);

  /// Whether impulses without restitution never add energy. Springs that a user has compressed release theirs, and a law
  /// of one's own may drive bodies.
  static constexpr bool dissipates =
      (CoulombLaw<Law, S> || RollingLaw<Law, S>)&&!CompliantLaw<Law, S>;
  static constexpr bool aside = TangentialRestitutionLaw<Law, S>;
  bool bounces() const {
    bool any = std::any_of(bounce_.begin(), bounce_.end(), [](Scalar x) { return x != 0; });
    if constexpr (aside)
      any = any ||
            std::any_of(aside_.begin(), aside_.end(), [](const Row& x) { return !x.isZero(0); });
    return any;
  }
  /// Whether no island gains kinetic energy by the impulses; false if that is not known.
  bool all_lose(const Bodies<S>& bodies, const Problem& problem, std::span<const Row> impulses,
                std::span<const typename S::Twist> free) {
    if (free.empty() || problem.delassus.has_cell()) return false;
    const BodiesGain gain = gain_of_bodies(bodies, problem.delassus, free);
    if (gain != BodiesGain::perhaps_some) return gain == BodiesGain::none;
    return islands_lose(bodies, problem, impulses, free);
  }
  /// all_lose() by the sums over the bodies of each island.
  MOREAU_COLD bool islands_lose(const Bodies<S>& bodies, const Problem& problem,
                                std::span<const Row> impulses,
                                std::span<const typename S::Twist> free) {
    unite(bodies, problem, [&](std::size_t c) { return !impulses[c].isZero(0); });
    std::fill(islands_.begin(), islands_.end(), Island{});
    add_gains(bodies, problem.delassus, free,
              [this](std::size_t i) -> double& { return islands_[sets_.find(i)].gain; });
    return std::none_of(islands_.begin(), islands_.end(),
                        [](const Island& island) { return !(island.gain <= 0); });
  }
  /// @param without share of the restitution that the operator lacks, 0 or 1
  void measure(const Problem& problem, std::span<const Row> impulses, const auto& springs,
               const auto& forced, Scalar without, List<State>& states) const {
    states.resize(impulses.size());
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      State& state = states[c];
      state.impulse = impulses[c];
      state.velocity.setZero();
      state.gain = -springs.energy_before(c);
      state.forced = 0;
      state.hits = false;
      state.acts = !impulses[c].isZero(0);
      // The parabola of the restitution needs velocities of contacts that act in one of the states only.
      if (!std::isfinite(offset_[c]) || !(state.acts || bounces_)) continue;
      Row offset = springs.relaxation(c);
      offset[0] += offset_[c] - without * bounce_[c];
      if constexpr (aside) offset += (1 - without) * aside_[c];
      state.velocity = problem.delassus.velocity(c) - offset;
      if (!state.acts) continue;
      const Row free = problem.delassus.free_velocity(c) - offset;
      state.gain += double(state.impulse.dot(free + state.velocity)) / 2;
      if (!bounces_) continue;
      const Row by_forces = forced(c);
      state.forced = double(state.impulse.dot(by_forces)) / 2;
      state.hits = free[0] - by_forces[0] < std::min(Scalar(0), by_forces[0]);
    }
  }
  /// Replaces impulses that add energy.
  MOREAU_COLD void limit(const Bodies<S>& bodies, Problem& problem, std::span<Row> impulses,
                         const auto& springs, const auto& solver, auto& workspace,
                         const auto& forced, SolveReport& report) {
    if (bounces_) offset_all(problem, -1);
    SolveReport found = report;
    if (bounces_ || report.converged) {
      found = rest(bodies, problem, impulses, springs, solver, workspace, forced, report.sweeps);
    } else {
      std::swap(resting_, bouncing_);
      add_up(bodies, problem);
    }
    if (bounces_) {
      report.sweeps = found.sweeps;
      report.converged = report.converged && found.converged;
      report.capped = report.capped || found.capped;
      report.residual = std::max(report.residual, found.residual);
      report.relative_approach = std::max(report.relative_approach, found.relative_approach);
      report.worst_velocity = std::max(report.worst_velocity, found.worst_velocity);
      report.velocity_error = std::max(report.velocity_error, found.velocity_error);
      report.islands = std::max(report.islands, found.islands);
      report.unsolved_islands = std::max(report.unsolved_islands, found.unsolved_islands);
      offset_all(problem, 1);
    } else {
      report = found;
      if (!damps()) return;
    }
    combine(bodies, problem, impulses);
  }
  /// Whether impulses without restitution add energy in an island.
  MOREAU_INLINED bool damps() const {
    return std::any_of(islands_.begin(), islands_.end(),
                       [](const Island& island) { return island.rest_counts(); });
  }
  /// Solves the problem without restitution until it adds no energy, and adds up the energies of the islands.
  /// @param sweeps so far
  MOREAU_INLINED SolveReport rest(const Bodies<S>& bodies, Problem& problem,
                                  std::span<Row> impulses, const auto& springs, const auto& solver,
                                  auto& workspace, const auto& forced, int sweeps) {
    constexpr int most_solves = 32;
    for (int k = 1;; ++k) {
      SolveReport found;
      if constexpr (requires { solver.solve(problem, impulses, workspace, /*again=*/true); })
        found = solver.solve(problem, impulses, workspace, /*again=*/true);
      else
        found = solver.solve(problem, impulses, workspace);
      measure(problem, impulses, springs, forced, Scalar(1), resting_);
      add_up(bodies, problem);
      const double change = change_by_shares(bodies, problem);
      const bool gains = change > small;
      sweeps += found.sweeps;
      if (gains && found.converged && found.sweeps > 0 && k < most_solves) continue;
      if (change > 0 && !gains) {
        for (std::size_t c = 0; c < impulses.size(); ++c)
          impulses[c] *= islands_[island_of(bodies, problem, c)].rest_share();
        set_impulses(problem.delassus, std::span<const Row>(impulses));
        measure(problem, impulses, springs, forced, Scalar(1), resting_);
        add_up(bodies, problem);
      }
      found.sweeps = sweeps;
      found.converged = found.converged && !gains;
      found.capped = !found.converged;
      return found;
    }
  }
  /// The largest change of a relative velocity by rest_share(), as a share of the largest relative velocity of the same island
  /// without impulses, or of the velocity that errors of its bodies are relative to at least if that is larger: if bodies fall
  /// together, the relative velocities without impulses are rounding.
  MOREAU_COLD double change_by_shares(const Bodies<S>& bodies, const Problem& problem) {
    if (!damps()) return 0;
    for (std::size_t c = 0; c < resting_.size(); ++c) {
      if (!std::isfinite(offset_[c])) continue;
      Island& island = islands_[island_of(bodies, problem, c)];
      const Row free = problem.delassus.free_velocity(c);
      const double rest = 1 - double(island.rest_share());
      island.largest_free = std::max(island.largest_free, double(linear<S>(free).norm()));
      for (const std::uint32_t body : problem.delassus.bodies(c))
        island.largest_free = std::max(island.largest_free, problem.least_scale(body, small));
      if (rest == 0) continue;
      const Row by_impulses = problem.delassus.velocity(c) - free;
      island.largest_change =
          std::max(island.largest_change, rest * double(linear<S>(by_impulses).norm()));
    }
    double share = 0;
    for (const Island& island : islands_)
      if (island.largest_change > 0)
        share = std::max(share, island.largest_change / island.largest_free);
    return share;
  }
  /// Whether the impulses add energy in an island: with restitution any, without it energy that counts.
  MOREAU_INLINED bool gains(const Bodies<S>& bodies, const Problem& problem) {
    bool hits = false, any = false, any_beyond = false;
    for (const State& state : bouncing_) {
      hits = hits || state.hits;
      any = any || state.gain > 0;
      any_beyond = any_beyond || state.gain > state.forced;
    }
    if (!any && !(hits && any_beyond)) return false;
    std::fill(resting_.begin(), resting_.end(), State{Row::Zero(), Row::Zero()});
    add_up(bodies, problem);
    return std::any_of(islands_.begin(), islands_.end(), [this](const Island& island) {
      return bounces_ ? island.makes_energy() : island.counts();
    });
  }
  void offset_all(Problem& problem, Scalar sign) const {
    for (std::size_t c = 0; c < bounce_.size(); ++c)
      if (bounce_[c] != 0) problem.delassus.offset_normal(c, sign * bounce_[c]);
    if constexpr (aside)
      for (std::size_t c = 0; c < aside_.size(); ++c)
        problem.delassus.offset(c, Row(sign * aside_[c]));
  }
  /// Sets the impulses between those without and with restitution, by the islands of rest(), and their velocities.
  MOREAU_INLINED void combine(const Bodies<S>& bodies, Problem& problem, std::span<Row> impulses) {
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      const Island& island = islands_[island_of(bodies, problem, c)];
      const Scalar share = bounces_ ? island.share() : Scalar(0);
      const Row &rest = resting_[c].impulse, &bounce = bouncing_[c].impulse;
      impulses[c] = share == 1 ? bounce : Row(island.rest_share() * rest + share * (bounce - rest));
    }
    set_impulses(problem.delassus, std::span<const Row>(impulses));
  }
  /// Finds the islands of contacts that act in one of the two states, and adds up their energies.
  void add_up(const Bodies<S>& bodies, const Problem& problem) {
    unite(bodies, problem, [this](std::size_t c) { return bouncing_[c].acts || resting_[c].acts; });
    std::fill(islands_.begin(), islands_.end(), Island{});
    for (std::size_t c = 0; c < bouncing_.size(); ++c) {
      const State &bounce = bouncing_[c], &rest = resting_[c];
      if (!bounce.acts && !rest.acts) continue;
      Island& island = islands_[island_of(bodies, problem, c)];
      const Row change = bounce.impulse - rest.impulse;
      island.hits = island.hits || bounce.hits;
      if constexpr (BondingLaw<Law, S>) island.bonded = island.bonded || problem.is_bond(c);
      island.gain += bounce.gain;
      island.forced += bounce.forced;
      island.gain_terms += std::abs(bounce.gain) + std::abs(bounce.forced) +
                           std::abs(double(bounce.impulse.dot(bounce.velocity)));
      const double least = negligible_velocity(problem, c);
      island.least_gain += least * bounce.impulse.template cast<double>().norm();
      island.least_rest_gain += least * rest.impulse.template cast<double>().norm();
      island.rest_work += double(rest.impulse.dot(rest.velocity));
      island.rest_gain += rest.gain;
      island.rest_forced += rest.forced;
      island.rest_terms += std::abs(rest.gain) + std::abs(double(rest.impulse.dot(rest.velocity)));
      island.slope += double(change.dot(rest.velocity));
      island.curvature += double(change.dot(bounce.velocity - rest.velocity));
    }
  }
  /// The velocity of bodies at rest, or the rounding of those of the bodies of a contact if they are fast [m/s].
  double negligible_velocity(const Problem& problem, std::size_t c) const {
    Scalar least = negligible_;
    if (!problem.rounding.empty())
      for (const std::uint32_t body : problem.delassus.bodies(c))
        least = std::max(least, problem.rounding[body]);
    return double(least);
  }
  /// Makes the sets of bodies that contacts connect which act.
  /// @param acts function: index of a contact -> whether it acts
  void unite(const Bodies<S>& bodies, const Problem& problem, const auto& acts) {
    sets_.assign(bodies.size());
    for (std::size_t c = 0; c < bouncing_.size(); ++c) {
      const auto [a, b] = problem.delassus.bodies(c);
      if (!acts(c)) continue;
      if (!bodies.is_prescribed(a) && !bodies.is_prescribed(b)) sets_.unite(a, b);
    }
  }
  MOREAU_INLINED std::uint32_t island_of(const Bodies<S>& bodies, const Problem& problem,
                                         std::size_t c) {
    if (problem.delassus.has_cell()) return 0;
    const auto [a, b] = problem.delassus.bodies(c);
    return sets_.find(bodies.is_prescribed(b) ? a : b);
  }

  bool bounces_ = false;          // some contact has a restitution in this step
  Scalar negligible_ = 0;         // velocity of bodies at rest [m/s]
  List<Scalar> offset_, bounce_;  // one per contact: all of the offset, its part by e [m/s]
  List<Row> aside_;               // one per contact, if the law has a tangential restitution [m/s]
  List<State> bouncing_, resting_;  // one per contact: with restitution, without
  DisjointSets sets_;               // of bodies: islands
  List<Island> islands_;            // one per body: that of a root counts
};

}  // namespace moreau::detail
