// SPDX-License-Identifier: MIT
#include "run_json.hpp"

#include <algorithm>

namespace ratcheting {

Json to_json(const Period& period) {
  return {{"x_j", period.jam_before},
          {"x_j_after", period.jam_after},
          {"t_onset", period.active.onset},
          {"t_force_minimum", period.force_minimum},
          {"t_peak", period.active.peak},
          {"delay", period.delay()},
          {"dx_max", period.dx_max},
          {"elastic_energy", period.elastic_energy},
          {"drift", period.active.drift},
          {"dx_active", period.active.dx},
          {"v_max_active", period.active.v_out},
          {"v_max_passive", period.active.v_in},
          {"f_g_active", period.active.thrust},
          {"steady_thrust", period.active.carried.thrust},
          {"carried_mass", period.active.carried.mass}};
}

Json to_json(const SolverTotals& t, double size) {
  const auto share = [&](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  return {{"steps", t.steps},
          {"capped_steps", t.capped},
          {"mean_sweeps", t.mean(t.sweeps)},
          {"most_sweeps", t.most_sweeps},
          {"mean_residual", t.mean(t.residual)},
          {"worst_residual", t.worst_residual},
          {"mean_pairs", t.mean(t.pairs)},
          {"mean_points", t.mean(t.points)},
          {"mean_overlap", t.mean(t.mean_overlap)},
          {"mean_overlap_first_tenth", t.mean_overlap_first},
          {"mean_overlap_last_tenth", t.mean_overlap_last},
          {"max_overlap", t.max_overlap},
          {"mean_overlap_over_d", t.mean(t.mean_overlap) / size},
          {"max_overlap_over_d", t.max_overlap / size},
          {"mean_rigid_residual", t.mean(t.rigid_residual)},
          {"max_elastic_overlap", t.max_elastic_overlap},
          {"gained_energy", t.gained},
          {"dissipation", t.dissipation},
          {"correction_work", t.correction_work},
          {"correction_work_over_dissipation", share(t.correction_work, t.dissipation)},
          {"correction_wall_travel", t.correction_travel},
          {"correction_wall_drift", t.correction_drift},
          {"mean_ms_detect", t.mean(t.ms_detect)},
          {"mean_ms_solve", t.mean(t.ms_solve)},
          {"mean_ms_total", t.mean(t.ms_total)},
          {"median_ms_total", t.median_ms()}};
}

Json versions() {
#if defined(__clang__)
  constexpr const char* compiler = __VERSION__;
#else
  constexpr const char* compiler = "g++ " __VERSION__;
#endif
  // The instructions belong to the versions: they change the rounding, and after some time the
  // packing.
#if defined(__AVX512F__)
  constexpr const char* instructions = "AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  constexpr const char* instructions = "AVX2 and FMA";
#else
  constexpr const char* instructions = "no wide instructions";
#endif
  return {
      {"moreau", MOREAU_VERSION_STRING},
      {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                    "." + std::to_string(EIGEN_MINOR_VERSION)},
      {"compiler", compiler},
      {"instructions", instructions}};
}

namespace {

/// The first recorded solid fraction of the control volume at or after t [-].
double rho_at(const std::vector<PackingSample>& packing, double t) {
  const auto after = std::find_if(packing.begin(), packing.end(),
                                  [&](const PackingSample& s) { return s.t >= t - 1e-9; });
  return after == packing.end() ? packing.back().rho_inner : after->rho_inner;
}

}  // namespace

Json results(const Parameters& p, double mass, double wall_mass, double length,
             const std::vector<Period>& periods, const std::vector<PackingSample>& packing) {
  Json json;
  if (packing.empty()) return json;
  const double rho0 = rho_at(packing, std::min(0.2, p.duration));
  json["rho_initial"] = packing.front().rho_inner;
  json["rho_0"] = rho0;
  json["rho_final"] = packing.back().rho_inner;
  json["rho_box_initial"] = packing.front().rho_box;
  json["rho_box_final"] = packing.back().rho_box;
  if (periods.empty()) return json;
  double dx = 0, v = 0, delay = 0, active = 0, moved = 0;
  for (const Period& period : periods) {
    dx += period.dx_max;
    v += period.active.v_in;
    delay += period.delay();
    if (!std::isfinite(period.active.thrust)) continue;
    active += period.active.thrust;
    ++moved;
  }
  const double n = double(periods.size());
  dx /= n, v /= n, delay /= n, active /= moved;
  const double weight = mass * p.gravity;
  json["periods"] = periods.size();
  json["dx_max"] = dx;
  json["v_max_passive"] = v;
  json["delay"] = delay;
  json["net_contraction_per_period"] = (periods.front().jam_before - periods.back().jam_after) / n;
  json["contracting_periods"] =
      std::count_if(periods.begin(), periods.end(),
                    [](const Period& period) { return period.jam_after < period.jam_before; });
  // Compaction between the first and the last force maximum that bounds a period.
  const double first = 0.75 / p.frequency, last = first + n / p.frequency;
  json["compaction_per_period"] = (rho_at(packing, last) - rho_at(packing, first)) / n / rho0;
  json["compaction_rate"] =
      (rho_at(packing, last) - rho_at(packing, first)) / rho0 / (last - first);
  json["contraction_rate"] =
      (periods.front().jam_before - periods.back().jam_after) / length / (last - first);
  json["C"] = dx / ((mass / (mass + wall_mass)) * (weight / p.fmax) * p.gravity /
                    (p.frequency * p.frequency));
  json["active_thrust"] = active;
  json["active_thrust_over_weight"] = active / weight;
  // 0.228 f_a^2 / (M fmax nu^2) with M = m_w + beta m, for a constant active thrust.
  const auto predicted = [&](double beta) {
    return 0.228 * active * active /
           ((wall_mass + beta * mass) * p.fmax * p.frequency * p.frequency);
  };
  json["dx_max_over_prediction"] = {{"beta_1", dx / predicted(1)},
                                    {"beta_1_3", dx / predicted(1.0 / 3)}};
  return json;
}

void write_events(const std::filesystem::path& folder, const std::vector<Period>& periods) {
  moreau::CsvWriter file(folder / "events.csv",
                         {"period", "t_before", "x_before", "t_onset", "t_force_min", "t_peak",
                          "x_peak", "t_after", "x_after"});
  int number = 0;
  for (const Period& period : periods)
    file.row(++number, period.start, period.jam_before, period.active.onset, period.force_minimum,
             period.active.peak, period.x_peak(), period.finish, period.jam_after);
  file.close();
}

}  // namespace ratcheting
