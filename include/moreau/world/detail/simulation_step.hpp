// SPDX-License-Identifier: MIT
// The step of a Simulation, and what it does to contacts between two steps. impulse_dynamics.hpp has the stages after
// detection.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <utility>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/assign_laws.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/simulation.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
StepReport Simulation<ShapeT, Law, Integrator, Broad, Solver>::step(Scalar step) {
  require_positive(step, "Simulation::step", "step");
  if constexpr (set_valued)
    if (cell().is_lattice()) cell_motion_.require_step(step);
  StepReport report;
  detail::StepContext<S, Law> context{
      assembly_.bodies(), gravity_,    materials_, previous_,
      contacts_,          grain_size_, step,       tolerances_.lengths(grain_size_).margin};
  const auto start = Clock::now();
  StepReport::StageClock clock;
  assembly_.keep_poses(step);
  if constexpr (set_valued) {
    dynamics_.predict_configuration(assembly_.bodies(), step);
    if (cell().is_lattice()) {
      cell_motion_.begin(assembly_.bodies(), detector_, step, dynamics_.theta(), team_);
      context.cell = &cell_motion_;
    }
  } else {
    if (assembly_.has_changed() || !dynamics_.has_loads_of(assembly_.bodies().size())) {
      detect(report, step);
      dynamics_.evaluate(context, 0, report);
      assembly_.set_changed(false);
      report = {};
    }
    dynamics_.predict(assembly_.bodies(), gravity_, step);
  }
  detect(report, step, clock);
  const auto detected = Clock::now();
  const double once = report.ms_collide;
  if constexpr (set_valued) {
    dynamics_.find_free_velocities(context, report);
    do {
      context.chords = chords_.update(assembly_, contacts_, step);
      dynamics_.solve_contacts(context, report);
    } while (detect_again(report, context));
    if (context.cell) {
      cell_motion_.end(assembly_.bodies(), detector_, step, dynamics_.theta(),
                       dynamics_.cell_rate(), dynamics_.measure_cell(context, report), team_);
      cell_motion_.describe(report);
    }
    dynamics_.finish(context, report);
  } else {
    context.chords = chords_.update(assembly_, contacts_, -step);
    dynamics_.evaluate(context, step, report);
    dynamics_.advance(context);
  }
  assembly_.require_finite("Simulation::step");
  report.step = double(step);
  last_step_ = step;
  time_ += step;
  if constexpr (bonding) dynamics_.bonds().stamp(time_);
  const std::chrono::duration<double, std::milli> again(report.ms_collide - once);
  report.set_times(detected - start + again, Clock::now() - detected - again);
  return report;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::detect(StepReport& report, Scalar step,
                                                                StepReport::StageClock clock) {
  const std::span<const Pose<S>> poses(assembly_.bodies().pose);
  detector_.place(poses,
                  [&](std::size_t k) -> const ShapeT& { return assembly_.shape_of_grain(k); });
  report.ms_place = clock.lap();
  if constexpr (bonding) {
    const Matrix vectors = cell().vectors();
    detector_.find_pairs(lengths());
    if (cell().is_lattice()) dynamics_.bonds().recount_cells(vectors, cell());
    detector_.leave_out(bonds());
  } else {
    detector_.find_pairs(lengths());
  }
  report.ms_pairs = clock.lap();
  if (narrows_margins() && attempts_.begin())
    detector_.fit_margins(lengths(), bodies(), step, attempts_.share());
  else
    detector_.use_whole_margin();
  // The contacts of the step before the last are replaced; the swap below makes the new ones contacts_.
  auto& found = previous_;
  DetectionLengths<Scalar> lengths_of_step = lengths();
  // A contact that is stored then serves ten steps or more.
  lengths_of_step.slow = lengths_of_step.carry / (10 * step);
  detector_.detect(lengths_of_step, bodies(), contacts_, found);
  if constexpr (bonding)
    dynamics_.bonds().place(bodies(), cell(), found, step * (1 - dynamics_.theta()));
  assign_laws(assembly_.bodies(), materials_, found, team_);
  assembly_.require_no_deep_overlap(found, "Simulation::step", [&] {
    if constexpr (set_valued)
      if (cell().is_lattice()) cell_motion_.undo_begin(detector_, step, dynamics_.theta());
  });
  [[maybe_unused]] std::size_t pairs = 0;
  if constexpr (BridgingLaw<Law, S>)
    pairs = bridges_.update(materials_, bodies(), contacts_, found,
                            tolerances_.lengths(grain_size_).margin);
  std::swap(contacts_, found);  // last: if a function above throws, the contacts have not changed
  report.ms_collide = clock.lap();
  report.candidate_pairs = detector_.pair_count();
  count_contacts(report);
  if constexpr (BridgingLaw<Law, S>) report.pairs = pairs;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
MOREAU_INLINED inline bool Simulation<ShapeT, Law, Integrator, Broad, Solver>::detect_again(
    StepReport& report,
    const detail::StepContext<S, Law>& context) requires SetValuedLaw<Law, SpaceOf<ShapeT>> {
  if (!detector_.has_fitted_margins()) return false;
  const auto [is_enough, is_calm] =
      detector_.margins_suffice(lengths(), bodies(), dynamics_.motion(context, chords_.has_any()));
  attempts_.end(!is_enough, is_calm);
  if (is_enough) return false;
  StepReport::StageClock clock;
  dynamics_.undo_shifts(assembly_.bodies());
  detector_.use_whole_margin();
  detector_.detect(lengths(), bodies(), previous_, contacts_);
  if constexpr (bonding)
    dynamics_.bonds().place(bodies(), cell(), contacts_, context.step * (1 - dynamics_.theta()));
  assign_laws(assembly_.bodies(), materials_, contacts_, team_);
  report.ms_collide += clock.lap();
  count_contacts(report);
  if constexpr (bonding) dynamics_.attract_again(context, report);  // bonds with their strength
  report.repeated = true;
  return true;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::set_materials(
    const Materials<Law>& materials) {
  require(materials.count() == materials_.count(), "Simulation::set_materials", "count",
          materials.count(), "must stay as it was");
  const Materials<Law> before = std::exchange(materials_, materials);
  const Scalar reach_before = std::exchange(reach_, detail::reach_of<S>(materials));
  if (!cell().is_open() && reach_ > reach_before) {
    try {
      detector_.set_cell(cell(), lengths(), "Simulation::set_materials");
    } catch (...) {
      materials_ = before;
      reach_ = reach_before;
      throw;
    }
  }
  if constexpr (set_valued) dynamics_.keep_materials(before);
  assembly_.set_changed();
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::remove(std::span<const BodyId> grains,
                                                                const char* function) {
  const List<unsigned char>& removed = assembly_.mark(grains, function);
  lost_.clear();
  for (const Contact<S>& contact : contacts_.points)
    lost_.push_back(removed[contact.a] != 0 || removed[contact.b] != 0);
  const auto is_lost = [&](std::size_t c) { return lost_[c] != 0; };
  dynamics_.erase(is_lost);
  if constexpr (bonding) dynamics_.bonds().erase(removed);
  contacts_.erase(is_lost);
  detector_.remove_grains(removed);
  assembly_.remove_marked();
}

}  // namespace moreau
