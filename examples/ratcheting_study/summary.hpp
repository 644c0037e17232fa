// SPDX-License-Identifier: MIT
// Series of runs, and what is fitted to them: per shape and seed, then over the seeds.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "behaviour.hpp"
#include "closed_form.hpp"
#include "compaction_fit.hpp"
#include "estimate.hpp"
#include "power_law.hpp"
#include "result.hpp"

namespace study {

using Series = std::vector<const Result*>;

/// The runs of a set with a shape and a seed, by rising value of a parameter.
Series series_of(const std::vector<Result>& results, const std::string& set,
                 const std::string& shape, std::size_t seed,
                 double Parameters::*parameter = &Parameters::frequency);

/// The fits to one sample's runs. Fits to fewer points than they need are nan.
struct SampleSummary {
  std::size_t seed = 0;
  const Result* base = nullptr;  ///< the baseline, 5 Hz and 6 kN
  Behaviour behaviour;           ///< of the baseline
  PowerLaw dx_frequency, v_frequency, dx_fmax, dx_gravity;
  PowerLaw active_frequency;                               ///< of the displacement without creep
  double creep_5 = std::nan(""), creep_20 = std::nan("");  ///< creep / dx at so many Hz
  double creep_60 = std::nan("");
  double loop_distance = std::nan("");       ///< scaled phase portraits at 5 and 10 Hz
  Proportion master;                         ///< dx over (mg)^2 / [(m + m_w) fmax nu^2]: C
  MovingShare master_share;                  ///< the same with m_w + beta m, beta fitted
  MovingShare wall_share;                    ///< the same over the wall masses alone
  double paper_wall_scatter = std::nan("");  ///< over the wall masses alone, with m + m_w
  MovingShare prediction;                    ///< with the measured thrust, beta fitted
  Proportion prediction_third;               ///< with the measured thrust and beta = 1/3
  CompactionFit branches, single;
  Slopes slopes;                   ///< below and above the nu_c of the branches
  std::size_t negative_rates = 0;  ///< frequencies without compaction: not in the fits
};

/// All samples of one shape.
struct ShapeSummary {
  std::string shape;
  std::vector<SampleSummary> samples;
};

ShapeSummary summarize(const std::vector<Result>& results, const std::string& shape);

/// A value over the samples of a shape.
Estimate over_samples(const ShapeSummary& shape, const auto& value_of) {
  std::vector<double> values;
  for (const SampleSummary& sample : shape.samples) values.push_back(value_of(sample));
  return estimate(values);
}

/// The runs of the master curve: frequencies, forces, gravity and wall masses at the baseline box.
Series master_series(const std::vector<Result>& results, const std::string& shape,
                     std::size_t seed);

/// The run of the sets with these parameters, if it is done.
const Result* find(const std::vector<Result>& results, const std::string& set,
                   const std::string& shape, std::size_t seed, double Parameters::*parameter,
                   double value);

}  // namespace study
