// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "loop_distance.hpp"

namespace study {

double scaled_loop_distance(const Result& slow, const Result& fast) {
  const auto scaled = [&](const Result& r) {
    const double nu = r.c.parameters.frequency;
    std::vector<Point> loop = r.loop;
    for (Point& p : loop) p = {p.x * nu * nu, p.y * nu};
    return loop;
  };
  return loop_distance(scaled(slow), scaled(fast));
}

Proportion master_fit(const Series& series, double Result::*displacement, double beta) {
  std::vector<Point> points;
  for (const Result* r : series) {
    const double load =
        r->scaled_load() * (r->mass + r->wall_mass) / (beta * r->mass + r->wall_mass);
    points.push_back({load, r->*displacement});
  }
  return fit_proportion(points);
}

namespace {

std::vector<Point> points_of(const Series& series, double Parameters::*parameter,
                             double Result::*value) {
  std::vector<Point> points;
  for (const Result* r : series) points.push_back({r->c.parameters.*parameter, r->*value});
  return points;
}

// Of a sample's runs, so that one that is not yet through is not held against the others.
constexpr std::size_t enough_frequencies = 8;  ///< of twelve
constexpr std::size_t enough_runs = 10;        ///< of some twenty of the master curve

/// A law through fewer points than four says nothing; and one over the frequency through a few of
/// its twelve, as a sample has them that is not yet through, is another law than the others'.
PowerLaw law_of(const Series& series, double Parameters::*parameter, double Result::*value) {
  const std::size_t enough = parameter == &Parameters::frequency ? enough_frequencies : 4;
  return series.size() < enough ? PowerLaw{} : fit_power_law(points_of(series, parameter, value));
}

/// beta shows in runs with different walls only.
bool walls_differ(const Series& series) {
  std::set<double> ratios;
  for (const Result* r : series) ratios.insert(r->c.parameters.wall_mass_ratio);
  return ratios.size() >= 3;
}

/// C and beta of least scatter.
MovingShare best_master(const Series& series, double Result::*displacement) {
  MovingShare best;
  if (!walls_differ(series)) return best;
  for (int k = 0; k <= 400; ++k) {
    const double beta = 0.005 * k;
    const Proportion fit = master_fit(series, displacement, beta);
    if (k == 0 || fit.scatter < best.measured_over_predicted.scatter) best = {beta, fit};
  }
  return best;
}

Scaling scaling_of(const std::vector<Result>& results, const std::string& shape, std::size_t seed,
                   double Result::*displacement) {
  const auto law = [&](const char* set, double Parameters::*parameter) {
    return law_of(series_of(results, set, shape, seed, parameter), parameter, displacement);
  };
  Scaling scaling;
  scaling.frequency = law("frequencies", &Parameters::frequency);
  scaling.fmax = law("fmax", &Parameters::fmax);
  scaling.gravity = law("gravity", &Parameters::gravity);
  const Series all = master_series(results, shape, seed);
  if (all.size() >= enough_runs) scaling.master = master_fit(all, displacement, 1);
  scaling.master_share = best_master(all, displacement);
  const Series walls = series_of(results, "wall-mass", shape, seed, &Parameters::wall_mass_ratio);
  scaling.wall_share = best_master(walls, displacement);
  if (walls.size() >= 4) scaling.paper_wall_scatter = master_fit(walls, displacement, 1).scatter;
  return scaling;
}

/// The closed form with each run's own thrust, against the displacement without creep.
void predict_displacements(const Series& all, SampleSummary& sample) {
  std::vector<Pushed> pushed;
  std::vector<Point> third, walls, flights, over_frequency;
  for (const Result* r : all) {
    const double predicted = sine_displacement(r->push(), 1.0 / 3);
    pushed.push_back({r->push(), r->dx_active});
    third.push_back({predicted, r->dx_active});
    walls.push_back({sine_displacement(r->push(), sample.active.wall_share.beta), r->dx_active});
    flights.push_back({r->flight_displacement(), r->dx_active});
    if (r->c.sets.contains("frequencies"))
      over_frequency.push_back({r->c.parameters.frequency, predicted});
  }
  if (pushed.size() < enough_runs) return;
  if (walls_differ(all)) sample.prediction = fit_moving_share(pushed);
  sample.prediction_third = fit_proportion(third);
  sample.prediction_walls = fit_proportion(walls);
  sample.flight = fit_proportion(flights);
  if (over_frequency.size() >= enough_frequencies)
    sample.predicted_frequency = fit_power_law(over_frequency);
}

/// nan for fewer frequencies than they need.
CompactionLaws compaction_laws(const std::vector<Point>& rates) {
  CompactionLaws laws;
  for (const Point& p : rates) laws.negative += !(p.y > 0);
  if (rates.size() < enough_frequencies) return laws;
  laws.branches = fit_compaction(rates, two_branches);
  laws.single = fit_compaction(rates, single_form);
  laws.slopes = slopes_about(rates, laws.branches.nu_c);
  for (PowerLaw* slope : {&laws.slopes.below, &laws.slopes.above})
    if (slope->points < 4) *slope = {};
  // What the branches have to beat.
  std::vector<Point> one, law;
  laws.law = fit_power_law(rates);
  for (const Point& p : rates) {
    one.push_back({1, p.y});
    law.push_back({std::pow(p.x, laws.law.exponent), p.y});
  }
  laws.scatter_about_one = fit_proportion(one).scatter;
  laws.scatter_about_law = fit_proportion(law).scatter;
  return laws;
}

}  // namespace

CompactionLaws compaction_of_run(const Series& frequencies) {
  return compaction_laws(points_of(frequencies, &Parameters::frequency, &Result::rate));
}

CompactionLaws early_compaction(const Series& frequencies) {
  std::vector<Point> rates;
  for (const Result* r : frequencies)
    rates.push_back({r->c.parameters.frequency, r->early_rate(&Jam::rho_box)});
  return compaction_laws(rates);
}

namespace {

/// What the closed form says of the speed of the way back, in which the wall passes its start.
void predict_returns(const Series& frequencies, SampleSummary& sample) {
  constexpr double beta = 1.0 / 3;
  std::vector<Point> at_start, at_jam;
  for (const Result* r : frequencies) {
    if (!(r->dx_active > 0)) continue;
    const double nu = r->c.parameters.frequency, inward = std::max(r->net_contraction, 0.0);
    Push push = r->push();
    push.thrust = thrust_of_displacement(push, r->dx_active, beta);
    at_start.push_back({nu, returning_speed(push, 0, beta)});
    at_jam.push_back({nu, returning_speed(push, inward, beta)});
  }
  if (at_start.size() < enough_frequencies) return;
  sample.speed_at_start = fit_power_law(at_start);
  sample.speed_at_jam = fit_power_law(at_jam);
}

SampleSummary summarize_sample(const std::vector<Result>& results, const std::string& shape,
                               std::size_t seed) {
  SampleSummary sample;
  sample.seed = seed;
  const Series frequencies = series_of(results, "frequencies", shape, seed);
  sample.frequencies = frequencies;
  sample.walls = series_of(results, "wall-mass", shape, seed, &Parameters::wall_mass_ratio);
  sample.base = find(results, "frequencies", shape, seed, &Parameters::frequency, 5);
  const Result* ten = find(results, "frequencies", shape, seed, &Parameters::frequency, 10);
  if (sample.base != nullptr) sample.behaviour = sample.base->behaviour;
  if (sample.base != nullptr && ten != nullptr)
    sample.loop_distance = scaled_loop_distance(*sample.base, *ten);
  sample.whole = scaling_of(results, shape, seed, &Result::dx_max);
  sample.active = scaling_of(results, shape, seed, &Result::dx_active);
  sample.v_frequency = law_of(frequencies, &Parameters::frequency, &Result::v_max);
  predict_displacements(master_series(results, shape, seed), sample);
  predict_returns(frequencies, sample);
  sample.rate = compaction_of_run(frequencies);
  sample.early = early_compaction(frequencies);
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
