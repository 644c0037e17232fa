// SPDX-License-Identifier: MIT
// The part of a step around the contacts, for laws that give impulses (contact dynamics):
//
//   1. predict_configuration(): that of detection; Simulation then detects the contacts and assigns laws
//   2. find_free_velocities(): of every body at the end of the step without contacts, attraction included (in several
//      processes it is added in 3, after the bodies are split)
//   3. assemble(): the Delassus operator; bodies that other processes share are split
//   4. warm_start(): the unknowns p of the contact problem (pushes.hpp) from the impulses r of the step before: turned with
//      the contacts, into rows of the operator (Pushes::carry()), of the same forces over this step (with springs by
//      ContactSprings::scale()), with the push against the attraction (Attraction::add_to()). The memory of springs and
//      bonds is added to b
//   5. correct_overlaps(): bodies are displaced and rotated; velocities stay as they are until 11
//   6. ContactLaws::list_variants(): the table of all laws with their variants (each contact gets its own in 7)
//   7. ContactLaws::offset_velocities(): the law of each contact, u before the step, and what chord and law add to b,
//      from the corrected gaps
//   8. solve(): p, by default with solve/coloured_gauss_seidel.hpp; limits the restitution. Pushes::store(): r of the
//      contacts, p in their frames without the push against the attraction
//   9. find_velocities(): after the impulses
//  10. measure_losses(): the dissipation; yielding and breaking of bonds
//  11. BodyShifts::turn_spins(): the angular velocities of bodies that 5 has rotated; advance_configuration(): to the end of the
//      step; with springs ContactSprings::remember() (velocities for the next step) and move_free_bodies()
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/solve/split_shared_bodies.hpp"
#include "moreau/world/detail/attraction.hpp"
#include "moreau/world/detail/body_shifts.hpp"
#include "moreau/world/detail/bonds/bond_list.hpp"
#include "moreau/world/detail/bonds/soften_bonds.hpp"
#include "moreau/world/detail/bridges.hpp"
#include "moreau/world/detail/cell/cell_equation.hpp"
#include "moreau/world/detail/chord_velocities.hpp"
#include "moreau/world/detail/contact_laws.hpp"
#include "moreau/world/detail/contact_losses.hpp"
#include "moreau/world/detail/contact_springs.hpp"
#include "moreau/world/detail/gap_rounding.hpp"
#include "moreau/world/detail/integrate.hpp"
#include "moreau/world/detail/pushes.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/detail/step_margins.hpp"
#include "moreau/world/detail/step_velocities.hpp"
#include "moreau/world/overlap_correction.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// Moves bodies through a step by contact impulses; the head of this file has the stages.
template <class S, class Law, class Integrator, class Solver>
class ImpulseDynamics {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;
  using Problem = ContactProblem<Operator, Law>;
  using Context = StepContext<S, Law>;

  ImpulseDynamics(const Solver& solver, const OverlapCorrectionOptions& correction,
                  const Integrator& integrator)
      : solver_(solver),
        correction_(checked(correction)),
        integrator_(integrator),
        moving_(integrator) {
    set_team(Team());
  }

  /// Overlap correction unless the user asks for another: none of contacts with springs, whose
  /// overlap is the compression of the springs.
  static OverlapCorrectionOptions default_correction() {
    OverlapCorrectionOptions options;
    options.enabled = !compliant;
    return options;
  }

  void set_solver(const Solver& solver) {
    solver_ = solver;
    set_team(team_);
    if (shared_) share_bodies(shared_);
  }
  /// Makes the bodies part of those of a simulation in several processes; null: all are here.
  void share_bodies(std::shared_ptr<SharedBodies> shared) {
    shared_ = std::move(shared);
    if constexpr (requires { solver_.share_bodies(shared_); }) solver_.share_bodies(shared_);
  }
  /// Sets the threads that share the work.
  void set_team(const Team& team) {
    team_ = team;
    if constexpr (requires { solver_.set_team(team); }) solver_.set_team(team);
  }
  void set_integrator(const Integrator& integrator) { integrator_ = moving_ = integrator; }
  /// The part of the step that comes after detection [-]; 1/2 of an integrator without theta().
  Scalar theta() const { return theta_of<Scalar>(moving_); }
  void set_correction(const OverlapCorrectionOptions& options) {
    correction_ = OverlapCorrection<S>(checked(options));
  }
  const OverlapCorrection<S>& correction() const { return correction_; }
  const Problem& problem() const { return problem_; }  ///< of the last step
  void forget_problem() { problem_ = {}; }
  /// Removes the springs of contacts with removed grains.
  /// @param is_gone function: index of a contact -> whether it is removed
  void erase([[maybe_unused]] const auto& is_gone) {
    if constexpr (compliant) springs_.erase(is_gone);
  }
  /// The materials of the step before, which the user replaces: springs remember pushes against their attraction.
  void keep_materials([[maybe_unused]] const Materials<Law>& before) {
    laws_.forget_variants();
    if constexpr (compliant && !bonding) attraction_.keep(before);
  }
  auto& bonds() { return bonds_; }              ///< BondList of a law with bonds
  const auto& bonds() const { return bonds_; }  ///< the same
  /// Whether the springs are those of as many contacts, after they were read from a file.
  bool is_valid([[maybe_unused]] std::size_t contacts, [[maybe_unused]] std::size_t bodies) const {
    if constexpr (compliant)
      return springs_.are_valid(contacts, bodies);
    else
      return std::isfinite(last_step_) && last_step_ >= 0;
  }

  /// Stage 1.
  void predict_configuration(Bodies<S>& bodies, Scalar step) {
    velocities_.resize(bodies.size());
    shifts_.resize(bodies.size());
    if constexpr (compliant) moving_ = springs_.for_step(integrator_, step);
    detail::predict_configuration<S>(moving_, bodies, velocities_.momentum, step, team_);
  }
  /// Whether other processes share bodies.
  bool shares_bodies() const { return shared_ != nullptr; }
  /// Stage 2.
  void find_free_velocities(const Context& context, StepReport& report);
  /// Stage 2 again, with the attraction of other contacts: after detection was repeated.
  void attract_again(const Context& context, StepReport& report);
  /// Stages 3 to 9.
  /// @param report out: all but the results of detection and of stage 10, and the times
  void solve_contacts(const Context& context, StepReport& report);
  /// Velocities after solve_contacts(), and the shifts by which it has corrected overlaps, one per body.
  /// @param has_chords whether the relative velocities of some contacts get chords
  StepMotion<S> motion(const Context& context, bool has_chords) const {
    StepMotion<S> motion{velocities_.after, {}, context.step};
    if (shifts_.any()) motion.shifts = correction_.shifts();
    if (has_chords) motion.before = context.bodies.velocity;
    return motion;
  }
  /// Undoes the shifts of solve_contacts(), which can then be called with other contacts.
  void undo_shifts(Bodies<S>& bodies) const { shifts_.undo(bodies); }
  /// In a periodic cell that can deform, between stages 9 and 10.
  /// @param report out: cell_work
  /// @returns V sigma, see world/cell_control.hpp [J]
  typename S::Matrix measure_cell(const Context& context, StepReport& report) const {
    return cell_.measure(context, std::span<const Twist>(velocities_.after), report);
  }
  /// L of the periodic cell after the step, once the contact problem is solved [1/s].
  const typename S::Matrix& cell_rate() const { return cell_.rate(); }
  /// Stages 10 and 11.
  void finish(const Context& context, StepReport& report);

 private:
  friend struct moreau::SerializationAccess;
  friend struct StateAccess;
  auto serialized_members() {
    if constexpr (compliant && bonding)
      return std::tie(solver_, correction_, integrator_, springs_, bonds_);
    else if constexpr (bonding)
      return std::tie(solver_, correction_, integrator_, last_step_, bonds_);
    else if constexpr (compliant && AttractiveLaw<Law, S>)
      return std::tie(solver_, correction_, integrator_, springs_, attraction_);
    else if constexpr (compliant)
      return std::tie(solver_, correction_, integrator_, springs_);
    else
      return std::tie(solver_, correction_, integrator_, last_step_);
  }

  void deserialized() {
    moving_ = integrator_;
    forget_problem();
  }

  static constexpr bool compliant = CompliantLaw<Law, S>;
  static constexpr bool bridging = BridgingLaw<Law, S>;
  static constexpr bool bonding = BondingLaw<Law, S>;
  static const OverlapCorrectionOptions& checked(const OverlapCorrectionOptions& correction) {
    require(!compliant || !correction.enabled, "Simulation", "correction.enabled",
            correction.enabled,
            "must be false under a compliant law: its overlaps are the compression of springs");
    return correction;
  }

  /// Whether the law can attract bodies in this step; without bonds, one with bonds does not.
  bool attracts() const {
    if constexpr (bonding)
      return !bonds_.bonds().empty() || shared_;
    else
      return AttractiveLaw<Law, S>;
  }
  void attract(const Context& context) {
    if constexpr (bonding)
      if (!attracts()) return attraction_.clear();
    attraction_.apply(context, bonds_, std::span<const MobilityRoot<S>>(velocities_.roots),
                      std::span<Twist>(velocities_.free));
  }
  void assemble(const Context& context) {
    if (shared_) {
      split_shared_bodies<S>(*shared_, context.contacts.points, std::span(velocities_.roots),
                             touched_);
      if constexpr (AttractiveLaw<Law, S>) {
        attract(context);
        average_twists<S>(*shared_, std::span<Twist>(velocities_.free));
      }
    }
    problem_.delassus.assemble(context.contacts.points, velocities_.roots, velocities_.free,
                               springs_.compliances(context), team_);
    velocities_.find_scales(context.bodies, problem_, team_);
    if (context.deforms()) cell_.start(context, problem_.delassus, team_);
  }

  /// @returns how many contacts have a predecessor
  std::size_t warm_start(const Context& context) {
    std::size_t found = 0;
    if constexpr (compliant) {
      // The springs bear the pushes against the attraction of contacts, but not the attraction of bonds.
      found = start(context, attraction_.pushes_before(context, springs_.last_step()));
      springs_.scale(context, pushes_.rows(), theta());
      bonds_.hide(pushes_.rows(), [&] {
        springs_.relax(context, pushes_.rows(), context.deforms() ? &cell_.jumps() : nullptr,
                       problem_.delassus);
      });
    } else {
      found = start(context, context.previous.impulses);
      // The same forces over this step.
      if (last_step_ > 0 && last_step_ != context.step)
        for (Row& push : pushes_.rows()) push *= context.step / last_step_;
    }
    if constexpr (bonding || !compliant) attraction_.add_to(pushes_.rows());
    bonds_.offset(context, problem_.delassus, attraction_.pulls(),
                  std::span<const Twist>(velocities_.before), shared_.get());
    return found;
  }
  std::size_t start(const Context& context, const List<Row>& before) {
    bridges_.save(context.contacts);
    const auto carry_by = [&](const auto& turn) {
      return pushes_.carry(context.previous, before, context.contacts, turn, problem_.delassus,
                           team_);
    };
    std::size_t found;
    if constexpr (compliant)
      found = carry_by(springs_.turn(context, theta()));
    else
      found = carry_by(ImpulseTurn<S>());
    bridges_.restore(context.contacts);
    bonds_.start(context.contacts);
    return found;
  }

  OverlapCorrectionReport correct_overlaps(const Context& context) {
    OverlapCorrectionReport report = correction_.solve(problem_.delassus, context.contacts.points,
                                                       context.grain_size, team_, shared_.get());
    shifts_.clear();
    if (shared_ || report.corrected > 0)
      shifts_.apply(correction_.shifts(), context.bodies, context.gravity, team_, shared_.get(),
                    report);
    return report;
  }

  MOREAU_INLINED void solve(const Context& context, StepReport& report) {
    const std::span<Row> pushes = pushes_.rows();
    solve_problem(context, report);
    if constexpr (bonding)
      if (attracts())
        soften_bonds(
            context, bonds_, attraction_, problem_.delassus, pushes,
            std::span<const MobilityRoot<S>>(velocities_.roots), velocities_.free,
            solver_tolerance(), [&] { solve_problem(context, report); }, report.solve,
            shared_.get());
    if (!shared_)
      laws_.limit().apply(
          context.bodies, problem_, pushes, springs_, solver_, workspace_,
          RestitutionLimit<S, Law>::negligible_velocity(context.grain_size, context.step),
          bodies_alone(context) ? std::span<const Twist>(velocities_.free)
                                : std::span<const Twist>(),
          [&](std::size_t c) {
            return velocities_.forced(context, c, laws_.velocities_before()[c], cell_.jumps(),
                                      problem_.delassus);
          },
          report.solve);
    if (cell_.moves(context)) cell_.leave(context, std::span<const Row>(pushes), problem_.delassus);
    report.solve.worst_gap = report.solve.worst_velocity * double(context.step);
    if constexpr (compliant)
      springs_.measure(context, problem_, pushes, attraction_.pulls(), report, shared_.get());
    if constexpr (bonding) {
      report.bond_load =
          bonds_.load(problem_.delassus, pushes, attraction_.pulls(), context.step, shared_.get());
      report.bond_error = bonds_.error(report.bond_load, report.solve.residual);
      bonds_.yield(context.materials, problem_.delassus, context.contacts, pushes, context.step);
    }
    laws_.choose_variants(problem_, context.materials, context.contacts,
                          std::span<const Row>(pushes), solver_tolerance());
  }

  /// Of the residual [-]; 0: the solver does not say.
  double solver_tolerance() const {
    if constexpr (requires { double(solver_.options().tolerance); })
      return solver_.options().tolerance;
    else
      return 0;
  }
  /// Whether the relative velocities without impulses are those of the free bodies, but for the offsets of the laws.
  bool bodies_alone(const Context& context) const {
    return !attracts() && context.chords.empty() && !context.deforms();
  }
  /// Solves the contact problem, with the equation of a cell that moves by its stress.
  void solve_problem(const Context& context, StepReport& report) {
    if (cell_.moves(context)) cell_.join(context, attraction_.pulls(), problem_.delassus);
    const auto unloaded = [&](std::size_t c) {
      return velocities_.unloaded(context, c, cell_.jumps(), problem_.delassus);
    };
    if constexpr (bonding)
      bonds_.refer(problem_.delassus, attraction_.pulls(), unloaded, problem_.attraction);
    else if constexpr (AttractiveLaw<Law, S>)
      attraction_.refer(unloaded, problem_.attraction);
    report.solve = solver_.solve(problem_, pushes_.rows(), workspace_);
  }

  /// Counts the energy that bonds took; removes those that broke.
  void end_bonds([[maybe_unused]] const Context& context, [[maybe_unused]] StepReport& report) {
    if constexpr (bonding) {
      const auto losses = [&](std::size_t c) {
        ContactLosses one;
        add_losses<S>(std::span<const Twist>(velocities_.before), context.contacts, c,
                      laws_.velocities_before()[c], std::span<const Twist>(velocities_.after), one);
        return one;
      };
      bonds_.end_step(context.contacts, losses, springs_, report);
    }
  }

  void measure_losses(const Context& context, StepReport& report) {
    // The mean of the velocities before and after has the cell's once, too.
    if (context.deforms()) laws_.add_jumps(cell_.jumps());
    const ContactLosses losses =
        contact_losses<S>(team_, std::span<const Twist>(velocities_.before), context.contacts,
                          laws_.velocities_before(), std::span(velocities_.after));
    report.friction += losses.friction;
    report.rolling += losses.rolling;
    report.dissipation += losses.dissipation;
    end_bonds(context, report);
  }
  /// After a step with another theta: bodies that no impulse moves are where the theta that was set leads them.
  void move_free_bodies([[maybe_unused]] const Context& context) {
    const Scalar time = (theta_of<Scalar>(integrator_) - theta()) * context.step;
    if (time == 0) return;
    team_.share_each(velocities_.after.size(), 256, [&](std::size_t i) {
      if (!problem_.delassus.velocity_change(i).isZero(0)) return;
      context.bodies.pose[i].position +=
          time * linear<S>(Twist(velocities_.after[i] - velocities_.before[i]));
    });
  }
  /// V = V_free and what the impulses have changed. Throws if a velocity is not finite.
  void find_velocities([[maybe_unused]] const Context& context) {
    [[maybe_unused]] bool attracted = false;
    if constexpr (AttractiveLaw<Law, S>)
      attracted = attraction_.find_changes(context.contacts, problem_.delassus, shared_.get());
    velocities_.find_after(problem_.delassus, attraction_, attracted, team_);
  }

  Team team_;
  std::shared_ptr<SharedBodies> shared_;
  Solver solver_;
  OverlapCorrection<S> correction_;
  Integrator integrator_, moving_;  // as set, and of this step
  // h of the step before, 0 before the first [s]; compliant laws do not use it
  Scalar last_step_ = 0;
  Problem problem_;
  [[no_unique_address]] std::conditional_t<compliant, ContactSprings<S, Law>, NoSprings> springs_;
  [[no_unique_address]] std::conditional_t<AttractiveLaw<Law, S>, Attraction<S, Law>,
                                           NoAttraction<S, Law>>
      attraction_;
  BodyShifts<S> shifts_;  // by the overlap correction
  typename WorkspaceOf<Solver, Operator, Law>::type workspace_;
  ContactLaws<S, Law> laws_;
  CellEquation<S, Law> cell_;  // of a periodic cell that deforms

  Pushes<S, Law> pushes_;
  StepVelocities<S, Law> velocities_;
  List<unsigned char> touched_;  // by contacts, one per body
  [[no_unique_address]] std::conditional_t<bonding, BondList<S, Law>, NoBonds> bonds_;
  [[no_unique_address]] std::conditional_t<bridging, BridgeBits<S, Law>, NoBridges> bridges_;
};

// Outside of the class: compiled once where a program declares the dynamics extern.
template <class S, class Law, class Integrator, class Solver>
void ImpulseDynamics<S, Law, Integrator, Solver>::find_free_velocities(const Context& context,
                                                                       StepReport& report) {
  StepReport::StageClock clock;
  velocities_.find_free(moving_, context, team_);
  if (!shared_) attract(context);
  report.ms_assemble += clock.lap();
}

// An integrator may change the momenta when it finds the velocities: it is not asked twice.
template <class S, class Law, class Integrator, class Solver>
void ImpulseDynamics<S, Law, Integrator, Solver>::attract_again(const Context& context,
                                                                StepReport& report) {
  StepReport::StageClock clock;
  velocities_.free = velocities_.unattracted;
  attract(context);
  report.ms_assemble += clock.lap();
}

template <class S, class Law, class Integrator, class Solver>
void ImpulseDynamics<S, Law, Integrator, Solver>::solve_contacts(const Context& context,
                                                                 StepReport& report) {
  StepReport::StageClock clock;
  assemble(context);
  report.warm_started = warm_start(context);
  report.ms_assemble += clock.lap();
  report.correction = correct_overlaps(context);
  report.ms_correct += clock.lap();
  laws_.list_variants(context, problem_);
  // Gaps stay open up to the length up to which overlaps do. Springs need their own.
  const Scalar most =
      compliant ? Scalar(0) : static_cast<Scalar>(correction_.options().slop) * context.grain_size;
  const auto gap_of = [&context, this, most](std::size_t c) {
    const Contact<S>& contact = context.contacts.points[c];
    const Scalar gap = contact.gap + correction_.gap_change(contact);
    return is_gap_rounding(context.bodies, contact, gap, most) ? Scalar(0) : gap;
  };
  const Scalar approach =
      laws_.offset_velocities(context, std::span<const Twist>(velocities_.before), problem_,
                              pushes_.rows(), gap_of, cell_.jumps(), team_);
  report.approach = double(approach * context.step / context.margin);
  solve(context, report);
  pushes_.store(context.contacts, attraction_, problem_.delassus, team_);
  report.ms_contacts += clock.lap();
  find_velocities(context);
}

template <class S, class Law, class Integrator, class Solver>
void ImpulseDynamics<S, Law, Integrator, Solver>::finish(const Context& context,
                                                         StepReport& report) {
  measure_losses(context, report);
  shifts_.turn_spins(correction_.shifts(), velocities_.after, team_);
  advance_configuration<S>(moving_, context.bodies, velocities_.after, context.step, team_);
  last_step_ = context.step;
  attraction_.end_step();
  if constexpr (compliant) {
    springs_.remember(context.bodies.velocity);
    move_free_bodies(context);
  }
}

}  // namespace moreau::detail
