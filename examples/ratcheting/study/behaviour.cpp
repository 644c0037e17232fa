// SPDX-License-Identifier: MIT
#include "behaviour.hpp"

#include <algorithm>
#include <cmath>

namespace study {

namespace {

using Periods = std::vector<ratcheting::Period>;
using ratcheting::Period;

/// Mean of what is added.
class Mean {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ > 0 ? sum_ / count_ : std::nan(""); }

 private:
  double sum_ = 0;
  int count_ = 0;
};

/// When x has fallen back by a share of the way from the peak to x_j'.
double falls_back(const Table& wall, const Period& period, double share) {
  const double top = period.x_peak();
  const double wanted = top - share * (top - period.jam_after);
  for (std::size_t k = 0; k < wall.rows(); ++k) {
    const double t = wall["t"][k];
    if (t >= period.active.peak && (wall["x"][k] <= wanted || t >= period.finish)) return t;
  }
  return period.finish;
}

/// The rows of a table with from <= t <= to.
struct Rows {
  std::size_t begin, end;
};
Rows rows_between(const Table& table, double from, double to) {
  const std::vector<double>& t = table["t"];
  const auto begin = std::lower_bound(t.begin(), t.end(), from - 1e-9);
  const auto end = std::upper_bound(t.begin(), t.end(), to + 1e-9);
  return {std::size_t(begin - t.begin()), std::size_t(end - t.begin())};
}

double mean_between(const Table& table, const std::string& column, double from, double to) {
  Mean mean;
  const std::vector<double>& values = table[column];
  const Rows rows = rows_between(table, from, to);
  for (std::size_t k = rows.begin; k < rows.end; ++k) mean.add(values[k]);
  return mean.value();
}

/// f_g over x between two times.
Line force_over_x(const Table& wall, double from, double to) {
  std::vector<Point> points;
  const Rows rows = rows_between(wall, from, to);
  for (std::size_t k = rows.begin; k < rows.end; ++k)
    points.push_back({wall["x"][k], wall["f_g"][k]});
  return fit_line(points);
}

void read_wall(const Table& wall, const Periods& periods, double frequency, Behaviour& b) {
  Mean lead, passive, active_slope, passive_slope, work;
  for (const Period& period : periods) {
    lead.add((period.force_minimum - period.active.onset) * frequency);
    // The transients of unjamming and jamming are left out.
    const double out = period.active.onset + 0.2 * (period.active.peak - period.active.onset);
    const double back = falls_back(wall, period, 0.9);
    passive.add(mean_between(wall, "f_g", period.active.peak, back));
    active_slope.add(force_over_x(wall, out, period.active.peak).slope);
    passive_slope.add(force_over_x(wall, period.active.peak, back).slope);
    double sum = 0;
    const Rows rows = rows_between(wall, period.start, period.finish);
    for (std::size_t k = rows.begin + 1; k < rows.end; ++k)
      sum += wall["f_g"][k] * (wall["x"][k] - wall["x"][k - 1]);
    work.add(sum);
  }
  b.onset_lead = lead.value();
  b.passive_force = passive.value();
  b.active_slope = active_slope.value();
  b.passive_slope = passive_slope.value();
  b.loop_work = work.value();
  b.early_share = value_at(wall, "x", 0.1) / value_at(wall, "x", 0.75 / frequency);
}

void read_state(const Tables& run, const Periods& periods, double frequency, Behaviour& b) {
  const Table& state = run.state;
  const double about = 0.05 / frequency;
  Mean jammed_xx, jammed_zz, active_xx, active_zz, roll, strength;
  for (const Period& period : periods) {
    jammed_xx.add(mean_between(state, "stress_xx", period.start - about, period.start + about));
    jammed_zz.add(mean_between(state, "stress_zz", period.start - about, period.start + about));
    active_xx.add(mean_between(state, "stress_xx", period.active.onset, period.active.peak));
    active_zz.add(mean_between(state, "stress_zz", period.active.onset, period.active.peak));
    const double back = falls_back(run.wall, period, 0.9);
    roll.add(mean_between(state, "roll", period.active.peak, back));
    strength.add(mean_between(state, "roll_strength", period.active.peak, back));
  }
  b.jammed_xx = jammed_xx.value();
  b.jammed_zz = jammed_zz.value();
  b.active_xx = active_xx.value();
  b.active_zz = active_zz.value();
  b.roll = roll.value();
  b.roll_strength = strength.value();
}

void read_packing(const Tables& run, const Periods& periods, Behaviour& b) {
  Mean extension, contraction, box;
  for (const Period& period : periods) {
    const auto change = [&](const char* column, double from, double to) {
      return value_at(run.packing, column, to) - value_at(run.packing, column, from);
    };
    extension.add(change("rho_inner", period.active.onset, period.active.peak));
    contraction.add(change("rho_inner", period.active.peak, falls_back(run.wall, period, 0.9)));
    box.add(change("rho_box", period.active.onset, period.active.peak));
  }
  b.rho_extension = extension.value();
  b.rho_contraction = contraction.value();
  b.box_extension = box.value();
}

}  // namespace

Behaviour behaviour_of(const Tables& run, const Periods& periods, double frequency) {
  Behaviour b;
  if (periods.empty()) return b;
  read_wall(run.wall, periods, frequency, b);
  read_state(run, periods, frequency, b);
  read_packing(run, periods, b);
  return b;
}

std::vector<Point> mean_loop(const Table& wall, const Periods& periods) {
  constexpr int phases = 400;
  if (periods.empty()) return {};
  const std::vector<double>&t = wall["t"], &x = wall["x"], &v = wall["v"];
  std::vector<Point> loop(phases, {0, 0});
  for (const Period& period : periods)
    for (int k = 0; k < phases; ++k) {
      const double at = period.start + (period.finish - period.start) * k / phases;
      const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, at);
      const std::size_t i = std::size_t(after - t.begin());
      const double share = std::clamp((at - t[i - 1]) / (t[i] - t[i - 1]), 0.0, 1.0);
      const double n = double(periods.size());
      loop[std::size_t(k)].x += (x[i - 1] + share * (x[i] - x[i - 1]) - period.jam_before) / n;
      loop[std::size_t(k)].y += (v[i - 1] + share * (v[i] - v[i - 1])) / n;
    }
  return loop;
}

}  // namespace study
