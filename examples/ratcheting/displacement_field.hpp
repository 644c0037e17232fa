// SPDX-License-Identifier: MIT
// The displacement of the grains from one maximum of the force to the next: the convection, without
// the motion to and fro within a period.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "moreau/measure/velocity_field.hpp"

#include "field_file.hpp"
#include "parameters.hpp"

namespace ratcheting {

/// Mean over the periods of a run. A run that continues from a checkpoint begins anew.
template <class ExperimentT>
class DisplacementField {
 public:
  using S = typename ExperimentT::S;
  using Field = moreau::VelocityField<S>;

  /// Call after every step.
  void look(const Parameters& p, const ExperimentT& experiment) {
    const double t = experiment.time() + p.step / 2;
    const double maxima = std::floor((t - p.first_maximum()) * p.frequency);
    if (maxima < 0 || maxima == last_) return;
    const auto& simulation = experiment.simulation();
    std::vector<typename S::Vector> now;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k)
      now.push_back(simulation.bodies().pose[simulation.grain(k).index()].position);
    if (maxima == last_ + 1 && before_.size() == now.size()) {
      if (!field_) field_.emplace(experiment.box(), field_cells, field_cells);
      for (std::size_t k = 0; k < now.size(); ++k)
        field_->add(before_[k], now[k] - before_[k], simulation.cell());
      ++periods_;
    }
    before_ = std::move(now);
    last_ = maxima;
  }

  std::size_t periods() const { return periods_; }
  /// Of the displacements per period: angular_velocity is an angle [rad].
  auto roll() const { return field_->roll(); }

  /// Writes displacement_field.csv: cells of the section (x to the right, z up), mean displacement in
  /// a period, number of grains in all periods.
  void write(const std::filesystem::path& folder) const {
    if (field_) write_field(folder / "displacement_field.csv", "u", *field_);
  }

 private:
  std::optional<Field> field_;
  std::vector<typename S::Vector> before_;  // centres at the last maximum
  double last_ = -1;                        // number of this maximum, from 0
  std::size_t periods_ = 0;
};

}  // namespace ratcheting
