// SPDX-License-Identifier: MIT
// The velocity field of the grains at the time of the wall's largest inward speed, after the box
// has filled.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "moreau/measure/velocity_field.hpp"

#include "field_file.hpp"
#include "parameters.hpp"

namespace ratcheting {

template <class ExperimentT>
class PassiveField {
 public:
  using S = typename ExperimentT::S;
  using Field = moreau::VelocityField<S>;

  /// Call after every step. Stores the field if the wall is faster inward than at any time since
  /// the first maximum of the force.
  void look(const Parameters& p, const ExperimentT& experiment) {
    if (experiment.time() < 0.75 / p.frequency) return;
    const double v = experiment.wall_velocity();
    if (v >= 0 || (field_ && v >= wall_velocity_)) return;
    time_ = experiment.time();
    wall_velocity_ = v;
    const auto& simulation = experiment.simulation();
    field_.emplace(experiment.box(), field_cells, field_cells);
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const std::size_t body = simulation.grain(k).index();
      field_->add(simulation.bodies().pose[body].position,
                  simulation.bodies().velocity[body].template head<S::dim>(), simulation.cell());
    }
  }

  bool empty() const { return !field_; }
  double time() const { return time_; }                    ///< [s]
  double wall_velocity() const { return wall_velocity_; }  ///< outward positive [m/s]
  auto roll() const { return field_->roll(); }

  /// Writes velocity_field.csv: cells of the section (x to the right, z up), mean velocity, number
  /// of grains.
  void write(const std::filesystem::path& folder) const {
    if (field_) write_field(folder / "velocity_field.csv", "v", *field_);
  }

 private:
  std::optional<Field> field_;
  double time_ = 0, wall_velocity_ = 0;
};

}  // namespace ratcheting
