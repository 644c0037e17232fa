// SPDX-License-Identifier: MIT
#include "result.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "active_phase.hpp"
#include "runner.hpp"
#include "table.hpp"

namespace study {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

ratcheting::Period read_period(const nlohmann::json& json, double frequency) {
  ratcheting::Period period;
  period.force_minimum = json.at("t_force_minimum");
  period.start = period.force_minimum - 0.5 / frequency;
  period.finish = period.force_minimum + 0.5 / frequency;
  period.jam_before = json.at("x_j");
  period.jam_after = json.at("x_j_after");
  period.onset = json.at("t_onset");
  period.peak = json.at("t_peak");
  period.dx_max = json.at("dx_max");
  period.v_max_active = json.at("v_max_active");
  period.v_max_passive = json.at("v_max_passive");
  period.f_g_active = json.at("f_g_active");
  return period;
}

std::optional<Facts::Range> read_range(const nlohmann::json& sample, const char* key) {
  if (!sample.contains(key)) return std::nullopt;
  return Facts::Range{sample[key][0], sample[key][1]};
}

Facts read_facts(const nlohmann::json& json) {
  Facts f;
  const auto& versions = json.at("versions");
  f.versions = "moreau " + versions.value("moreau", "") + ", Eigen " + versions.value("eigen", "") +
               ", " + versions.value("compiler", "");
  const auto& sample = json.at("sample");
  f.settled = sample.value("settled", false);
  f.vertices = read_range(sample, "vertices");
  f.faces = read_range(sample, "faces");
  if (sample.contains("circumradii"))
    for (const auto& size : sample["circumradii"])
      f.circumradii.emplace_back(size.at("radius"), size.at("grains"));
  const auto& solver = json.at("solver");
  f.steps = solver.at("steps");
  f.capped_steps = solver.at("capped_steps");
  f.mean_sweeps = solver.at("mean_sweeps");
  f.worst_residual = solver.at("worst_residual");
  f.mean_overlap = solver.at("mean_overlap_over_d");
  f.max_overlap = solver.at("max_overlap_over_d");
  f.median_ms = solver.at("median_ms_total");
  f.prepare_seconds = json.at("wall_clock_seconds").value("prepare", 0.0);
  f.vibrate_seconds = json.at("wall_clock_seconds").value("vibrate", 0.0);
  if (json.contains("passive_field")) {
    const auto& field = json["passive_field"];
    f.roll = field.at("roll");
    f.roll_strength = field.at("strength");
    f.roll_agreement = field.at("agreement");
  }
  return f;
}

/// Mean of a field over the periods.
double mean(const std::vector<ratcheting::Period>& periods, const auto& field) {
  if (periods.empty()) return none;
  double sum = 0;
  for (const ratcheting::Period& period : periods) sum += field(period);
  return sum / double(periods.size());
}

void summarize_wall(Result& r) {
  using ratcheting::Period;
  const auto& periods = r.periods;
  r.dx_max = mean(periods, [](const Period& p) { return p.dx_max; });
  r.dx_spread = std::sqrt(mean(
      periods, [&](const Period& p) { return (p.dx_max - r.dx_max) * (p.dx_max - r.dx_max); }));
  r.v_max = mean(periods, [](const Period& p) { return p.v_max_passive; });
  r.delay = mean(periods, [](const Period& p) { return p.delay(); });
  r.net_contraction = mean(periods, [](const Period& p) { return p.jam_before - p.jam_after; });
  r.contracting = 0;
  for (const Period& p : periods) r.contracting += p.jam_after < p.jam_before;
  r.constant = r.dx_max / r.scaled_load();
}

void summarize_active(const Table& wall, Result& r) {
  const Parameters& p = r.c.parameters;
  const double before = time_before_minimum(r.weight, p.fmin, p.fmax, p.frequency);
  const double n = double(r.periods.size());
  double dx = 0, creep = 0, thrust = 0, moved = 0;
  for (const ratcheting::Period& period : r.periods) {
    const ActivePhase phase =
        active_phase(wall["t"], wall["x"], wall["v"], wall["f_g"], period.start,
                     period.force_minimum - before, period.finish);
    dx += phase.dx / n;
    creep += phase.creep / n;
    if (!std::isfinite(phase.thrust)) continue;
    thrust += phase.thrust;
    ++moved;
  }
  r.dx_active = n > 0 ? dx : none;
  r.creep = n > 0 ? creep : none;
  r.thrust = moved > 0 ? thrust / moved : none;
}

void summarize_packing(const Table& packing, Result& r) {
  const Parameters& p = r.c.parameters;
  const auto inner = [&](double t) { return value_at(packing, "rho_inner", t); };
  r.rho_initial = inner(0);
  r.rho_0 = inner(std::min(0.2, p.duration));
  r.rho_final = packing["rho_inner"].back();
  r.box_initial = packing["rho_box"].front();
  r.box_final = packing["rho_box"].back();
  r.rate = r.compaction_per_period = none;
  if (r.periods.empty()) return;
  const double begin = r.periods.front().start, end = r.periods.back().finish;
  r.rate = (inner(end) - inner(begin)) / r.rho_0 / (end - begin);
  r.compaction_per_period = r.rate / p.frequency;
}

}  // namespace

Push Result::push() const {
  const Parameters& p = c.parameters;
  return {thrust, p.fmin, p.fmax, p.frequency, mass, wall_mass};
}

double Result::scaled_load() const {
  const Parameters& p = c.parameters;
  return weight * weight / ((mass + wall_mass) * p.fmax * p.frequency * p.frequency);
}

std::optional<Result> read_result(const std::filesystem::path& output, const Case& c) {
  if (!is_done(output, c)) return std::nullopt;
  const std::filesystem::path folder = folder_of(output, c);
  Result r{};
  r.c = c;
  std::ifstream file(folder / "run.json");
  const auto json = nlohmann::json::parse(file);
  r.facts = read_facts(json);
  r.mass = json.at("sample").at("mass");
  r.wall_mass = json.at("sample").at("wall_mass");
  r.length = json.at("box").at("length");
  r.height = json.at("box").at("height");
  r.weight = r.mass * c.parameters.gravity;
  for (const auto& entry : json.at("periods")) {
    const ratcheting::Period period = read_period(entry, c.parameters.frequency);
    if (period.start >= filling_time - 1e-9) r.periods.push_back(period);
  }
  summarize_wall(r);
  summarize_active(Table(folder / "wall.csv"), r);
  summarize_packing(Table(folder / "packing.csv"), r);
  return r;
}

std::vector<Result> read_results(const std::filesystem::path& output,
                                 const std::vector<Case>& plan) {
  std::vector<Result> results;
  for (const Case& c : plan)
    if (auto result = read_result(output, c)) results.push_back(std::move(*result));
  return results;
}

}  // namespace study
