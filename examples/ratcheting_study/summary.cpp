// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "loop_distance.hpp"

namespace study {

namespace {

std::vector<Point> points_of(const Series& series, double Parameters::*parameter,
                             double Result::*value) {
  std::vector<Point> points;
  for (const Result* r : series) points.push_back({r->c.parameters.*parameter, r->*value});
  return points;
}

/// A law through fewer points than four says nothing.
PowerLaw law_of(const Series& series, double Parameters::*parameter, double Result::*value) {
  return series.size() < 4 ? PowerLaw{} : fit_power_law(points_of(series, parameter, value));
}

Proportion master_fit(const Series& series, double beta) {
  std::vector<Point> points;
  for (const Result* r : series) {
    const double load =
        r->scaled_load() * (r->mass + r->wall_mass) / (beta * r->mass + r->wall_mass);
    points.push_back({load, r->dx_max});
  }
  return fit_proportion(points);
}

/// beta shows in runs with different walls only.
bool walls_differ(const Series& series) {
  std::set<double> ratios;
  for (const Result* r : series) ratios.insert(r->c.parameters.wall_mass_ratio);
  return ratios.size() >= 3;
}

/// C and beta of least scatter.
MovingShare best_master(const Series& series) {
  MovingShare best;
  if (!walls_differ(series)) return best;
  for (int k = 0; k <= 400; ++k) {
    const double beta = 0.005 * k;
    const Proportion fit = master_fit(series, beta);
    if (k == 0 || fit.scatter < best.measured_over_predicted.scatter) best = {beta, fit};
  }
  return best;
}

double scaled_loop_distance(const Result& slow, const Result& fast) {
  const auto scaled = [&](const Result& r) {
    const double nu = r.c.parameters.frequency;
    std::vector<Point> loop = r.loop;
    for (Point& p : loop) p = {p.x * nu * nu, p.y * nu};
    return loop;
  };
  return loop_distance(scaled(slow), scaled(fast));
}

void fit_compaction_rates(const Series& frequencies, SampleSummary& sample) {
  const std::vector<Point> rates = points_of(frequencies, &Parameters::frequency, &Result::rate);
  for (const Point& p : rates) sample.negative_rates += !(p.y > 0);
  if (rates.size() < 6) return;
  sample.branches = fit_compaction(rates, two_branches);
  sample.single = fit_compaction(rates, single_form);
  sample.slopes = slopes_about(rates, sample.branches.nu_c);
}

SampleSummary summarize_sample(const std::vector<Result>& results, const std::string& shape,
                               std::size_t seed) {
  SampleSummary sample;
  sample.seed = seed;
  const Series frequencies = series_of(results, "frequencies", shape, seed);
  sample.base = find(results, "frequencies", shape, seed, &Parameters::frequency, 5);
  const Result* ten = find(results, "frequencies", shape, seed, &Parameters::frequency, 10);
  if (sample.base != nullptr) sample.behaviour = sample.base->behaviour;
  if (sample.base != nullptr && ten != nullptr)
    sample.loop_distance = scaled_loop_distance(*sample.base, *ten);
  for (const Result* r : frequencies) {
    const double nu = r->c.parameters.frequency, share = r->creep / r->dx_max;
    if (nu == 5) sample.creep_5 = share;
    if (nu == 20) sample.creep_20 = share;
    if (nu == 60) sample.creep_60 = share;
  }
  sample.dx_frequency = law_of(frequencies, &Parameters::frequency, &Result::dx_max);
  sample.active_frequency = law_of(frequencies, &Parameters::frequency, &Result::dx_active);
  sample.v_frequency = law_of(frequencies, &Parameters::frequency, &Result::v_max);
  const auto series = [&](const char* set, double Parameters::*parameter) {
    return law_of(series_of(results, set, shape, seed, parameter), parameter, &Result::dx_max);
  };
  sample.dx_fmax = series("fmax", &Parameters::fmax);
  sample.dx_gravity = series("gravity", &Parameters::gravity);
  const Series all = master_series(results, shape, seed);
  if (all.size() >= 4) sample.master = master_fit(all, 1);
  sample.master_share = best_master(all);
  const Series walls = series_of(results, "wall-mass", shape, seed, &Parameters::wall_mass_ratio);
  sample.wall_share = best_master(walls);
  if (walls.size() >= 4) sample.paper_wall_scatter = master_fit(walls, 1).scatter;
  std::vector<Pushed> pushed;
  std::vector<Point> third;
  for (const Result* r : all) {
    pushed.push_back({r->push(), r->dx_active});
    third.push_back({sine_displacement(r->push(), 1.0 / 3), r->dx_active});
  }
  if (pushed.size() >= 4) {
    if (walls_differ(all)) sample.prediction = fit_moving_share(pushed);
    sample.prediction_third = fit_proportion(third);
  }
  fit_compaction_rates(frequencies, sample);
  return sample;
}

}  // namespace

Series series_of(const std::vector<Result>& results, const std::string& set,
                 const std::string& shape, std::size_t seed, double Parameters::*parameter) {
  Series series;
  for (const Result& r : results)
    if (r.c.sets.contains(set) && r.c.parameters.shape == shape && r.c.parameters.seed == seed)
      series.push_back(&r);
  std::stable_sort(series.begin(), series.end(), [&](const Result* a, const Result* b) {
    return a->c.parameters.*parameter < b->c.parameters.*parameter;
  });
  return series;
}

Series master_series(const std::vector<Result>& results, const std::string& shape,
                     std::size_t seed) {
  Series all;
  for (const Result& r : results)
    if (r.c.parameters.shape == shape && r.c.parameters.seed == seed && !r.periods.empty())
      for (const char* set : {"frequencies", "fmax", "gravity", "wall-mass"})
        if (r.c.sets.contains(set)) {
          all.push_back(&r);
          break;
        }
  return all;
}

const Result* find(const std::vector<Result>& results, const std::string& set,
                   const std::string& shape, std::size_t seed, double Parameters::*parameter,
                   double value) {
  for (const Result* r : series_of(results, set, shape, seed, parameter))
    if (r->c.parameters.*parameter == value) return r;
  return nullptr;
}

ShapeSummary summarize(const std::vector<Result>& results, const std::string& shape) {
  std::set<std::size_t> seeds;
  for (const Result& r : results)
    if (r.c.parameters.shape == shape) seeds.insert(r.c.parameters.seed);
  ShapeSummary summary;
  summary.shape = shape;
  for (const std::size_t seed : seeds)
    summary.samples.push_back(summarize_sample(results, shape, seed));
  return summary;
}

}  // namespace study
