// SPDX-License-Identifier: MIT
// The tables of a run. Every line is complete as soon as it is written, so the tables of an
// interrupted run are complete, too.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/measure/velocity_field.hpp"

#include "displacement_field.hpp"
#include "experiment.hpp"
#include "parameters.hpp"
#include "passive_field.hpp"
#include "periods.hpp"
#include "summary.hpp"

namespace ratcheting {

/// One line of packing.csv and of state.csv.
struct PackingSample {
  double t, x, rho_inner, rho_box, stress_xx, stress_zz, roll, roll_strength;
};

template <class ExperimentT>
class Recorder {
 public:
  using S = typename ExperimentT::S;
  static constexpr int up = S::dim - 1;

  /// The members of a checkpoint: what has been recorded, and the sizes of the four tables.
  struct Record {
    std::array<std::uint64_t, 4> sizes{};
    moreau::Aabb<S> inner;
    std::vector<WallSample> samples;
    std::vector<PackingSample> packing_samples;
    SolverTotals totals;
  };

  /// @param record from a checkpoint, to continue its tables; an empty one makes new tables
  Recorder(const Parameters& p, const ExperimentT& experiment, const Record& record = {})
      : parameters_(p),
        experiment_(experiment),
        folder_(p.output),
        wall_(file("wall.csv"), {"t", "f", "x", "v", "f_g"}, 1, record.sizes[0]),
        packing_(file("packing.csv"),
                 {"t", "rho_inner", "rho_box", "kinetic_energy", "contacts", "coordination",
                  "rho_to_wall", "rho_to_lid", "rho_moving"},
                 1, record.sizes[1]),
        state_(file("state.csv"), {"t", "x", "stress_xx", "stress_zz", "roll", "roll_strength"}, 1,
               record.sizes[2]),
        solver_(file("solver.csv"),
                {"step", "pairs", "points", "sweeps", "residual", "max_overlap", "mean_overlap",
                 "ms_detect", "ms_solve", "ms_total"},
                1, record.sizes[3]),
        inner_(record.inner),
        samples_(record.samples),
        packing_samples_(record.packing_samples),
        totals_(record.totals) {}

  /// Distance of the control volume from the side walls, 2 d [m].
  static double inset(const ExperimentT& experiment) {
    return 2 * experiment.simulation().grain_size();
  }
  /// Sets the control volume: 2 d from the side walls, 0.1 H to 0.7 H.
  void set_control_volume() {
    inner_ = experiment_.box();
    inner_.lower.array() += inset(experiment_);
    inner_.upper.array() -= inset(experiment_);
    inner_.lower[up] = 0.1 * experiment_.height();
    inner_.upper[up] = 0.7 * experiment_.height();
    moreau::require_inside(inner_, experiment_.box());
  }

  void record_step(std::size_t step, const moreau::StepReport& report, std::size_t total) {
    const double t = experiment_.time();
    const double shift = experiment_.corrected_displacement();
    const WallSample sample{t,
                            parameters_.force(t - parameters_.step / 2),
                            experiment_.displacement(),
                            experiment_.wall_velocity(),
                            experiment_.wall_force(),
                            report.elastic_energy};
    samples_.push_back(sample);
    totals_.add(report, shift, total);
    passive_field_.look(parameters_, experiment_);
    displacement_field_.look(parameters_, experiment_);
    wall_.row(sample.t, sample.f, sample.x, sample.v, sample.f_g);
    solver_.row(step, report.pairs, report.points, report.solve.sweeps, report.solve.residual,
                report.max_overlap, report.mean_overlap, report.ms_detect, report.ms_solve,
                report.ms_total);
  }

  void record_packing() {
    const auto& simulation = experiment_.simulation();
    const double inner = solid_fraction(inner_), whole = solid_fraction(experiment_.box());
    const auto position = [&](std::size_t body) -> const typename S::Vector& {
      return simulation.bodies().pose[body].position;
    };
    const auto is_grain = [&](std::size_t body) { return simulation.is_grain(body); };
    const typename S::Matrix stress =
        moreau::contact_stress(simulation, parameters_.step, inner_) / experiment_.thickness();
    moreau::VelocityField<S> field(experiment_.box(), 6, 6);
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const std::size_t body = simulation.grain(k).index();
      field.add(position(body), simulation.bodies().velocity[body].template head<S::dim>(),
                simulation.cell());
    }
    const auto roll = field.roll();
    const moreau::Coordination coordination =
        counter_.count(simulation.contacts().points, simulation.contacts().impulses,
                       simulation.bodies().size(), is_grain);
    packing_samples_.push_back({experiment_.time(), experiment_.displacement(), inner, whole,
                                stress(0, 0), stress(up, up), roll.angular_velocity,
                                roll.strength});
    packing_.row(experiment_.time(), inner, whole, experiment_.kinetic_energy(),
                 simulation.contacts().size(), coordination.neighbours, rho_to_wall(), rho_to_lid(),
                 rho_moving());
    state_.row(experiment_.time(), experiment_.displacement(), stress(0, 0), stress(up, up),
               roll.angular_velocity, roll.strength);
  }

  void sync() {
    for (moreau::CsvWriter* file : {&wall_, &packing_, &state_, &solver_}) file->sync();
  }

  double solid_fraction(const moreau::Aabb<S>& volume) {
    return moreau::solid_fraction(experiment_.simulation(), volume, workspace_);
  }

  Record record() const {
    return {{wall_.size(), packing_.size(), state_.size(), solver_.size()},
            inner_,
            samples_,
            packing_samples_,
            totals_};
  }
  const moreau::Aabb<S>& inner() const { return inner_; }
  const std::vector<WallSample>& samples() const { return samples_; }
  const std::vector<PackingSample>& packing_samples() const { return packing_samples_; }
  const SolverTotals& totals() const { return totals_; }
  const PassiveField<ExperimentT>& passive_field() const { return passive_field_; }
  const DisplacementField<ExperimentT>& displacement_field() const { return displacement_field_; }

 private:
  // The control volume in other extents: up to the moving wall, up to the lid, and with vertical
  // faces that move in proportion to their distance from the fixed wall.
  double rho_to_wall() {
    moreau::Aabb<S> volume = inner_;
    volume.upper[0] = experiment_.box().upper[0];
    return solid_fraction(volume);
  }
  double rho_to_lid() {
    moreau::Aabb<S> volume = inner_;
    volume.upper[up] = experiment_.height();
    return solid_fraction(volume);
  }
  double rho_moving() {
    moreau::Aabb<S> volume = inner_;
    const double stretch = experiment_.box().upper[0] / experiment_.length();
    volume.lower[0] *= stretch;
    volume.upper[0] *= stretch;
    return solid_fraction(volume);
  }

  std::string file(const char* name) const { return (folder_ / name).string(); }

  Parameters parameters_;
  const ExperimentT& experiment_;
  std::filesystem::path folder_;
  moreau::CsvWriter wall_, packing_, state_, solver_;
  moreau::Aabb<S> inner_;
  moreau::ClipWorkspace<S> workspace_;
  moreau::CoordinationCounter<S> counter_;
  std::vector<WallSample> samples_;
  std::vector<PackingSample> packing_samples_;
  SolverTotals totals_;
  PassiveField<ExperimentT> passive_field_;
  DisplacementField<ExperimentT> displacement_field_;
};

}  // namespace ratcheting
