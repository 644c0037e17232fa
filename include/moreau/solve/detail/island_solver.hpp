// SPDX-License-Identifier: MIT
// Solves small islands of a contact problem by a direct method, and estimates the error of the
// velocities of their bodies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact_islands.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/island_contact.hpp"
#include "moreau/solve/detail/small_island.hpp"
#include "moreau/solve/island_newton.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau::detail {

/// Whether the direct method solves the contacts of a law: Coulomb's, or that with couples.
template <class Law, class S>
concept HasIslands = CoulombLaw<Law, S> || RollingCoulombLaw<Law, S>;

/// The small islands of one contact problem: those of at least two contacts for
/// which steps of Newton's method are cheap. A single contact is solved exactly by every sweep. Islands with a bond are
/// left to the sweeps: impulses of a bond and their limits are those of its strength, beside which loads can be small. Keeps
/// its memory.
///
/// Where the warm start is near a solution, as in structures at rest, few steps are enough, before the sweeps, and where
/// its defect shows that it is solved, none. Other islands are attempted after the sweeps, which takes as long as many
/// sweeps. So that the work of a simulation stays in proportion, only some islands are, drawn by a hash of their state: a
/// structure is solved some steps after it came to rest, and then stays so. Structures of few contacts per body are attempted
/// in every step, unless their bodies collide; colliding grains are left to the sweeps in most steps.
template <class Operator, class Law>
class IslandSolver {
 public:
  using Problem = ContactProblem<Operator, Law>;
  using Impulse = typename Operator::Vector;
  using Impulses = std::span<Impulse>;
  /// Error, and residual, up to which even pressures are better than those that sweeps have given, under tolerances
  /// near rounding.
  static constexpr double even_enough = 1e-6;

  /// Finds the small islands and solves those that are near a solution.
  /// @param impulses  in: the warm start; out: those of the islands are better or the same [N s]
  /// @param tolerance on the error of the velocities, see SolveReport::velocity_error [-]
  void start(Problem& problem, Impulses impulses, double tolerance) {
    tolerance_ = tolerance;
    islands_ = &problem.delassus.islands();
    small_.clear();
    moved_.assign(problem.delassus.body_count(), 0);
    motion_.resize(moved_.size());
    borne_.assign(moved_.size(), 0);
    others_ = islands_->has_large();
    made_even_ = false;
    for (std::size_t k = 0; k < islands_->size(); ++k) {
      const auto contacts = islands_->contacts(k);
      // A matrix with more blocks takes more work.
      const double least_cost =
          Newton::least_cost_of_step(contacts.size(), islands_->bodies(k), islands_->pairs(k)) /
          double(contacts.size());
      if (contacts.size() < 2 || least_cost > most_visits ||
          (bonding && has_bond(problem, contacts))) {
        others_ = true;
        continue;
      }
      bool is_new = true, closes = false, falls = true;
      for (const std::uint32_t c : contacts) {
        is_new = is_new && impulses[c].isZero(0);
        closes = closes || problem.delassus.free_velocity(c)[0] < 0;
        falls = falls && hardly_closes(problem, c);
      }
      // Without impulses the defect is 0 where no contact closes, and otherwise 1.
      Small one{k, least_cost, closes ? 1.0 : 0.0, is_new, not_attempted, not_attempted, falls};
      if (!is_new) {
        take(problem, k);
        one.defect = start_newton(problem, impulses);
        newton_.take_scales([&](std::uint32_t body, double scale) { borne_[body] = scale; });
        one.collides = collides(problem, one);
        if (!attempt_open(problem, one, impulses, one.defect) &&
            !attempt_evenly(problem, one, impulses, 0, one.defect, late_epsilon))
          attempt(one, impulses);
      }
      small_.push_back(one);
    }
  }
  bool empty() const { return small_.empty(); }  ///< no island is small
  /// Whether all contacts lie in small islands.
  bool have_all_contacts() const { return !others_; }
  /// Whether all contacts lie in islands whose error is within the tolerance.
  bool all_meet_tolerance() const {
    return !others_ && std::all_of(small_.begin(), small_.end(),
                                   [&](const Small& one) { return meets_tolerance(one); });
  }
  /// Whether all contacts lie in islands that count as solved in the report.
  bool all_solved() const {
    return !others_ && std::all_of(small_.begin(), small_.end(), [&](const Small& one) {
      return one.error <= accepted * tolerance_;
    });
  }
  /// Saves the impulses, which sweeps change.
  void save(Impulses impulses) { saved_.assign(impulses.begin(), impulses.end()); }
  /// Goes back to the impulses of save().
  void restore(Impulses impulses) const {
    std::copy(saved_.begin(), saved_.end(), impulses.begin());
  }
  /// After sweeps: goes back to the saved impulses of the islands where these are better, and solves some of the
  /// others from the impulses of the sweeps.
  /// @param converged whether the sweeps have met their stopping test: if not, islands that slide are attempted as well
  void finish(const Problem& problem, Impulses impulses, int sweeps, bool converged) {
    for (Small& one : small_) {
      one.start_error = not_attempted;  // that was the error of the warm start
      if (one.error <= near * tolerance_)
        for (const std::uint32_t c : islands_->contacts(one.island)) impulses[c] = saved_[c];
      else
        one.error = not_attempted;
      const bool is_open = one.is_new && one.defect == 0;
      if (is_open || meets_tolerance(one) || !one.is_drawn(counted_steps * one.cost, sweeps))
        continue;
      take(problem, one.island);
      find_cost(one);
      if (one.cost > most_visits || !one.is_drawn(counted_steps * one.cost, sweeps)) continue;
      // Of an island without a warm start the pressures shall be even, not only a solution.
      const double defect = start_newton(problem, impulses);
      if (attempt_open(problem, one, impulses, defect)) continue;
      const bool by_springs = one.is_new && newton_.slides_on_faces();
      if (by_springs) start_by_springs(problem, impulses);
      if (!one.failed && attempt_evenly(problem, one, impulses, sweeps, defect, late_epsilon))
        continue;
      if (one.is_new && one.failed) {  // the pressures of springs are far from the solution
        start_by_springs(problem, impulses);
        if (attempt_evenly(problem, one, impulses, sweeps, defect, even_epsilon)) continue;
      }
      // The first step of solve_near() is that of these springs: from their motion it would change nothing, as if solved.
      if (by_springs) start_newton(problem, impulses);
      if (!one.is_new && accept(one, defect)) continue;
      if (newton_.slip() >= 1 && converged) continue;
      // Sweeps give the load of a pair to the point that they visit first.
      const double error =
          newton_.solve_near(saved_, even_epsilon, {tolerance_, least_epsilon, most_steps});
      if (keep(one, impulses, error, defect)) {
        made_even_ = made_even_ || one.is_new;
        continue;
      }
      if (one.is_new && newton_.is_better() && keep_even(one, impulses, error)) continue;
      const double by_sweeps = one.error;
      start_newton(problem, impulses);
      if (!solve_directly(one, impulses, late_epsilon, most_steps, defect) &&
          by_sweeps <= near * tolerance_)
        one.error = one.start_error = by_sweeps;
    }
  }
  /// How many contacts sweeps may visit before finish_failed(), together: as many as one failed attempt at each island that
  /// is not solved takes. 0: all islands that were attempted are solved, or have no solution.
  MOREAU_INLINED double visits_for_failed() const {
    double visits = 0;
    for (const Small& one : small_)
      if (can_be_solved(one))
        visits += most_steps * one.cost * double(islands_->contacts(one.island).size());
    return visits;
  }
  /// After further sweeps: solves islands that are not solved from the impulses of the sweeps, and goes back to the saved impulses
  /// of the others whose errors are known.
  MOREAU_INLINED void finish_failed(const Problem& problem, Impulses impulses) {
    for (Small& one : small_) {
      if (!can_be_solved(one)) {
        if (one.error != not_attempted)
          for (const std::uint32_t c : islands_->contacts(one.island)) impulses[c] = saved_[c];
        continue;
      }
      take(problem, one.island);
      find_cost(one);
      solve_directly(one, impulses, late_epsilon, most_steps, start_newton(problem, impulses));
    }
  }
  /// Whether the pressures of an island were made even that slides or had no warm start.
  bool made_even() const { return made_even_; }
  /// Whether the direct method has estimated the error of an island.
  bool attempted() const {
    return std::any_of(small_.begin(), small_.end(),
                       [](const Small& one) { return one.error < not_attempted; });
  }
  /// Gives the bodies of islands the velocities that the direct method has found, in place of those by its impulses.
  MOREAU_INLINED void move(Operator& delassus) const {
    const auto changes = delassus.velocity_changes();
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      if (!moved_[i]) continue;
      for (int k = 0; k < Operator::Space::dofs; ++k)
        changes[i * std::size_t(Operator::width) + std::size_t(k)] = motion_[i][k];
    }
  }
  /// After move(): bodies can be squeezed, as between a fixed and a driven wall. Their impulses grow, and change their
  /// motion no more, so that its error is small. The approach that remains is an error, too, relative to the largest velocity
  /// with which contacts close or that impulses or loads give to a body of the island.
  MOREAU_INLINED void add_approach(const Problem& problem) {
    const Operator& op = problem.delassus;
    for (Small& one : small_) {
      if (!(one.error <= accepted * tolerance_)) continue;
      double approach = 0, scale = 0;
      for (const std::uint32_t c : islands_->contacts(one.island)) {
        approach = std::max(approach, -double(op.normal_velocity(c)));
        scale = std::max(scale, -double(op.free_velocity(c)[0]));
        for (const std::uint32_t body : op.bodies(c))
          scale = std::max({scale, double(op.velocity_change(body).template head<dim>().norm()),
                            problem.least_scale(body, tolerance_),
                            problem.load.empty() ? 0 : double(problem.load[body])});
      }
      if (!(approach > accepted * tolerance_ * scale)) continue;
      one.error = scale > 0 ? approach / scale : 1;
      one.squeezed = true;
    }
  }
  /// Where the impulses are those of the sweeps after all: their errors, and no motion.
  MOREAU_INLINED void roll_back() {
    std::fill(moved_.begin(), moved_.end(), 0);
    for (Small& one : small_) one.error = one.start_error;
  }
  /// Writes the results of the islands.
  MOREAU_INLINED void write(SolveReport& report) const {
    report.islands = report.unsolved_islands = 0;
    report.velocity_error = 0;
    for (const Small& one : small_) {
      if (one.error == not_attempted) continue;
      report.velocity_error = std::max(report.velocity_error, one.error);
      ++report.islands;
      report.unsolved_islands += has_failed(one);
    }
  }

 private:
  static constexpr bool couples = Rolls<Law>;
  static constexpr int dim = Operator::Space::dim;
  static constexpr bool bonding = BondingLaw<Law, typename Operator::Space>;
  using Newton = IslandNewton<typename Operator::Space, couples>;
  using Small = SmallIsland<typename Operator::Space>;
  static constexpr double not_attempted = Small::not_attempted;
  /// The warm start of structures at rest has a defect of 1e-8 to 1e-4, that of colliding grains 0.1 to 1. Below the
  /// first bound an island is attempted in every step, up to the second before the sweeps.
  static constexpr double solved_defect = 1e-5, largest_defect = 0.01;
  /// Compliances of proximal steps: the least; the first before the sweeps; the first after them, from the warm start
  /// and from the impulses of the sweeps.
  static constexpr double least_epsilon = 1e-6, warm_epsilon = 1e-5, even_epsilon = 1e-2,
                          late_epsilon = 1e-4;
  /// Newton steps of an attempt after the sweeps, at most and as counted in advance: one that fails takes all of them.
  static constexpr int most_steps = 60, counted_steps = 40;
  /// Multiples of the tolerance: up to the first one impulses are kept, as a better start for the next step; up to the
  /// second one an island counts as solved in the report.
  static constexpr double near = 10, accepted = 100;
  /// Of the velocity that the warm start gives to a body, too.
  static constexpr double least_share = Problem::least_share;
  /// Bodies of an island whose sliding faces get even pressures, at most: of one that is new, of one that collides.
  static constexpr std::size_t most_new = 10, most_colliding = 3;
  static constexpr double most_visits = Small::most_visits, warm_visits = Small::warm_visits;

  static bool has_bond(const Problem& problem, std::span<const std::uint32_t> contacts) {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](std::uint32_t c) { return problem.is_bond(c); });
  }
  /// Starts Newton's method for the island that take() took. If impulses change the velocity of a body by little, the error of the
  /// body is relative to its load, to its rounding and to its load of the step before: otherwise the velocities of a structure that
  /// lost its support, and now falls freely, would have no scale.
  double start_newton(const Problem& problem, Impulses impulses) {
    return newton_.start(impulses, [&](std::uint32_t body) {
      return std::max(least_share * borne_[body], problem.least_scale(body, tolerance_));
    });
  }
  /// Whether a contact closes without impulses by no more than rounding, or than a small share of what loads give.
  static bool hardly_closes(const Problem& problem, std::size_t c) {
    const double closing = -double(problem.delassus.free_velocity(c)[0]);
    double least = 0;
    if (!problem.load.empty())
      for (const std::uint32_t body : problem.delassus.bodies(c))
        least = std::max(
            {least, double(problem.rounding[body]), least_share * double(problem.load[body])});
    return !(closing > least);
  }
  /// Whether grains collide in the island that take() took, and are left to the sweeps: not if the direct method takes little,
  /// of few bodies, or if a light body is among heavy ones.
  bool collides(const Problem& problem, const Small& one) const {
    constexpr double far = 0.1, most_ratio = 100;
    return !problem.load.empty() && one.defect > far &&
           islands_->bodies(one.island) > most_colliding && newton_.mass_ratio() <= most_ratio &&
           do_collide(problem, islands_->contacts(one.island));
  }
  /// Solves an island whose bodies fall together or apart from no impulses, if these are nearer to a solution than others.
  /// Every contact is then at the apex of its cone, where the derivative of the map depends on the direction. Newton's method
  /// converges slowly there from the impulses of a removed load, or from the small impulses that sweeps have left.
  /// @param defect of the others, by start_newton()
  /// @returns whether it succeeds; if not, the impulses are those of start_newton()
  MOREAU_COLD bool attempt_open(const Problem& problem, Small& one, Impulses impulses,
                                double defect) {
    if (!one.falls || defect <= solved_defect) return false;
    if (start_newton(problem, {}) < defect) {
      find_cost(one);
      const Small before = one;
      if (one.cost <= most_visits) {
        const double error = newton_.solve(even_epsilon, {tolerance_, least_epsilon, most_steps});
        // The changes of all steps may be those of rounding.
        const bool better = newton_.is_better() || error <= tolerance_;
        if (keep(one, impulses, error, std::max(newton_.first_change(), defect), better))
          return true;
      }
      one = before;
    }
    start_newton(problem, impulses);
    return false;
  }
  /// Of an island without a warm start, after start_newton().
  MOREAU_INLINED void start_by_springs(const Problem& problem, Impulses impulses) {
    if (!newton_.start_by_springs(saved_, even_epsilon, {tolerance_, least_epsilon, most_steps}))
      start_newton(problem, impulses);
  }
  bool meets_tolerance(const Small& one) const { return one.error <= tolerance_; }
  bool can_be_solved(const Small& one) const { return has_failed(one) && !one.squeezed; }
  bool has_failed(const Small& one) const {
    return one.error != not_attempted && one.error > accepted * tolerance_;
  }
  /// Takes impulses as they are if their defect shows that they are solved. For a column of n bodies the error is up to
  /// about n^2 times the defect, and for a light body under a heavy one the ratio of their masses times as large; ten
  /// times as much is allowed for weakly held bodies. Islands with contacts without friction are refined instead: their
  /// errors add up from step to step.
  /// @param defect of the impulses
  MOREAU_INLINED bool accept(Small& one, double defect) const {
    const double n = std::max(10.0, double(islands_->bodies(one.island)));
    const double error = 10 * n * n * newton_.mass_ratio() * defect;
    if (!(error <= tolerance_) || newton_.has_smooth_point()) return false;
    one.error = error;
    return true;
  }
  /// Solves an island in which faces slide, from impulses whose defect start() has found, with even pressures.
  /// @param epsilon of the first proximal step
  /// @returns whether it succeeds; if it was made and failed, the impulses are those of start_newton()
  MOREAU_COLD bool attempt_evenly(const Problem& problem, Small& one, Impulses impulses, int sweeps,
                                  double defect, double epsilon) {
    // With springs the pressure is unique.
    constexpr bool springs = requires(const Operator op) {
      op.compliance(std::size_t());
    };
    if (springs || has_static_friction(problem, one) || !newton_.slides_on_faces()) return false;
    const std::size_t bodies = islands_->bodies(one.island);
    if (one.is_new && bodies > most_new) return false;
    if (!one.is_new && one.defect > largest_defect && bodies > most_colliding) return false;
    find_cost(one);
    if (one.cost > most_visits || !one.is_drawn(warm_visits, sweeps)) return false;
    const double error = newton_.solve_evenly(epsilon, {tolerance_, least_epsilon, most_steps});
    one.failed = !newton_.is_better() ||
                 !(keep(one, impulses, error, defect) || keep_even(one, impulses, error));
    if (one.failed)
      start_newton(problem, impulses);
    else
      made_even_ = true;
    return !one.failed;
  }
  /// Whether a contact of an island has a law with static friction: its variants stand side by side in the table of laws, and
  /// their friction differs. Whether a point slides follows from its impulse, which then must lie on the cone of its own
  /// pressure more closely than even pressures do.
  bool has_static_friction(const Problem& problem, const Small& one) const {
    constexpr std::size_t variants = variants_of<Law, typename Operator::Space>();
    if constexpr (variants > 1 && !bonding)  // the other variant is that of bonds
      for (const std::uint32_t c : islands_->contacts(one.island)) {
        const std::size_t first = problem.law_of[c] / variants * variants;
        for (std::size_t k = first; k < std::min(first + variants, problem.laws.size()); ++k)
          if (problem.laws[k].friction() != problem.law(c).friction()) return true;
      }
    return false;
  }
  /// Before the sweeps.
  MOREAU_INLINED void attempt(Small& one, Impulses impulses) {
    if (one.defect > largest_defect || accept(one, one.defect)) return;
    find_cost(one);
    if (one.cost > most_visits) return;
    if (one.defect > solved_defect && !one.is_drawn(warm_visits, 0)) return;
    solve_directly(one, impulses, std::clamp(one.defect, warm_epsilon, late_epsilon),
                   std::max(2, int(warm_visits / one.cost)), one.defect);
  }
  /// Of the island that take() took.
  MOREAU_INLINED void find_cost(Small& one) {
    one.cost = newton_.cost_of_step() / double(islands_->contacts(one.island).size());
  }
  MOREAU_COMPILED_ONCE void take(const Problem& problem, std::size_t island) {
    newton_.assign(
        problem.delassus, islands_->contacts(island),
        [&](std::size_t c) { return exact_free_velocity(problem, c); },
        [&](std::size_t c) { return opening_velocity(problem, c); },
        [&](std::size_t c) { return friction_and_rolling(problem.law(c)); });
  }
  /// @returns whether it has succeeded
  MOREAU_INLINED bool solve_directly(Small& one, Impulses impulses, double epsilon, int steps,
                                     double defect) {
    const double error = newton_.solve(epsilon, {tolerance_, least_epsilon, steps});
    return keep(one, impulses, error, std::max(newton_.first_change(), defect));
  }
  /// Keeps the impulses that the direct method has found, if they are good enough.
  /// @param error of these
  /// @param start_error lower bound for the impulses from which it started: the only known error if the method fails
  /// @returns whether it has succeeded
  bool keep(Small& one, Impulses impulses, double error, double start_error) {
    return keep(one, impulses, error, start_error, newton_.is_better());
  }
  /// @param better whether they are better than those from which it started
  bool keep(Small& one, Impulses impulses, double error, double start_error, bool better) {
    one.start_error = start_error;
    if (!better || error > near * tolerance_) {
      one.error = std::max(start_error, 2 * tolerance_);
      return false;
    }
    one.error = error;
    newton_.finish(impulses);
    newton_.finish_motion([&](std::uint32_t body, const auto& change) {
      moved_[body] = 1;
      motion_[body] = change.template cast<typename Operator::Scalar>();
    });
    return true;
  }

  /// Keeps even pressures that are not accurate enough for keep(), see even_enough.
  /// @returns whether they are kept
  MOREAU_INLINED bool keep_even(Small& one, Impulses impulses, double error) {
    if (!(error <= even_enough)) return false;
    newton_.finish(impulses);
    one.error = error;
    made_even_ = true;
    return true;
  }

  double tolerance_ = 0;
  bool others_ = false;                      // contacts outside of small islands
  bool made_even_ = false;                   // see made_even()
  const ContactIslands* islands_ = nullptr;  // of the problem
  Newton newton_;
  List<Small> small_;
  List<Impulse> saved_;
  List<double> borne_;         // one per body: the scale of errors of the warm start [m/s]
  List<unsigned char> moved_;  // by the direct method, one per body
  List<typename Operator::Space::Twist> motion_;  // change of the velocity, where moved_
};

}  // namespace moreau::detail
