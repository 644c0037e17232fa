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

/// How far the wall moves out, over what is varied. Fits to fewer points than they need are nan.
struct Scaling {
  PowerLaw frequency, fmax, gravity;
  Proportion master;                         ///< over (mg)^2 / [(m + m_w) fmax nu^2]: C
  MovingShare master_share;                  ///< the same with m_w + beta m, beta fitted
  MovingShare wall_share;                    ///< the same over the wall masses alone
  double paper_wall_scatter = std::nan("");  ///< over the wall masses alone, with m + m_w
};

/// What is fitted to a rate of compaction over the frequency.
struct CompactionLaws {
  CompactionFit branches, single;
  Slopes slopes;  ///< below and above the nu_c of the branches
  PowerLaw law;   ///< the rival of the branches: one power law
  double scatter_about_one = std::nan(""),
         scatter_about_law = std::nan("");  ///< rms ln: about one value, about that law
  std::size_t negative = 0;                 ///< frequencies without compaction: not in the fits
};

/// Of the inner volume over the whole run; of the whole box over the first second. The fits to
/// fewer frequencies than they need are nan.
CompactionLaws compaction_of_run(const Series& frequencies);
CompactionLaws early_compaction(const Series& frequencies);

/// The fits to one sample's runs. Fits to fewer points than they need are nan.
struct SampleSummary {
  std::size_t seed = 0;
  const Result* base = nullptr;  ///< the baseline, 5 Hz and 6 kN
  Behaviour behaviour;           ///< of the baseline
  Series frequencies, walls;     ///< by rising frequency, by rising mass of the wall
  Scaling whole, active;         ///< of dx_max; of dx_active, the displacement without creep
  PowerLaw v_frequency;
  double loop_distance = std::nan("");  ///< scaled phase portraits at 5 and 10 Hz
  MovingShare prediction;               ///< dx_active with the measured thrust, beta fitted
  Proportion prediction_third;          ///< with the measured thrust and beta = 1/3
  PowerLaw predicted_frequency;         ///< of that prediction
  Proportion prediction_walls;          ///< with the beta of active.wall_share
  Proportion flight;                    ///< dx_active over Result::flight_displacement()
  /// Of the speed of the way back by the closed form, where the wall is again at its start and
  /// where it jams; its thrust is that which explains the way out, beta = 1/3.
  PowerLaw speed_at_start, speed_at_jam;
  CompactionLaws rate;   ///< of the inner volume over the whole run, as the paper's
  CompactionLaws early;  ///< of the whole box over the first second

  /// A value of the run at a frequency; nan if it is not done.
  double at(double frequency, const auto& value_of) const {
    for (const Result* r : frequencies)
      if (r->c.parameters.frequency == frequency) return value_of(*r);
    return std::nan("");
  }
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

/// How far the phase portraits of a slower and a faster run are apart when scaled, x nu^2 and v nu.
double scaled_loop_distance(const Result& slow, const Result& fast);

/// C of a series: the displacement over (mg)^2 / [(m_w + beta m) fmax nu^2], the paper's load where
/// beta = 1.
Proportion master_fit(const Series& series, double Result::*displacement, double beta);

/// The run of the sets with these parameters, if it is done.
const Result* find(const std::vector<Result>& results, const std::string& set,
                   const std::string& shape, std::size_t seed, double Parameters::*parameter,
                   double value);

}  // namespace study
