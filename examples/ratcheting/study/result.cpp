// SPDX-License-Identifier: MIT
#include "result.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "../active_phase.hpp"

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
  period.dx_max = json.at("dx_max");
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
  if (const std::string wide = versions.value("instructions", ""); !wide.empty())
    f.versions += ", " + wide;
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
  if (json.contains("passive_field")) {
    const auto& field = json["passive_field"];
    f.roll = field.at("roll");
    f.roll_strength = field.at("strength");
    f.roll_agreement = field.at("agreement");
  }
  return f;
}

WallClock read_clock(const nlohmann::json& json) {
  const auto& seconds = json.at("wall_clock_seconds");
  return {seconds.value("prepare", 0.0), seconds.value("vibrate", 0.0),
          json.at("solver").at("median_ms_total")};
}

/// @throws std::runtime_error if a table misses a step, ends early or goes back in time
void require_complete(const std::filesystem::path& folder, const Tables& run, const Result& r) {
  const Parameters& p = r.c.parameters;
  const auto fail = [&](const char* file, const std::string& what) {
    throw std::runtime_error((folder / file).string() + " " + what);
  };
  if (run.wall.rows() != r.facts.steps)
    fail("wall.csv", "has " + std::to_string(run.wall.rows()) + " rows for " +
                         std::to_string(r.facts.steps) + " steps");
  for (const char* column : {"t", "f", "x", "v", "f_g"})
    for (const double value : run.wall[column])
      if (!std::isfinite(value))
        fail("wall.csv", std::string("has a value in ") + column + " that is not finite");
  const auto require_time = [&](const Table& table, const char* file) {
    const std::vector<double>& t = table["t"];
    const double end = p.begin() + p.duration;
    // Rows stand for several steps, which need not divide the duration.
    const double spacing = t.size() > 1 ? t.back() - t[t.size() - 2] : 0;
    if (t.empty() || !(std::abs(t.back() - end) < std::max(0.002 * p.duration, spacing)))
      fail(file, "does not end at " + std::to_string(end) + " s");
    if (std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return !(a < b); }) !=
        t.end())
      fail(file, "has times that do not rise");
  };
  require_time(run.wall, "wall.csv");
  require_time(run.state, "state.csv");
  require_time(run.packing, "packing.csv");
  for (const char* file : {"velocity_field.csv", "chains_active.csv", "chains_jammed.csv"})
    if (std::filesystem::exists(folder / file)) Table(folder / file);
}

/// Sets the active phase of every period.
void find_active(const Table& wall, Result& r) {
  const Parameters& p = r.c.parameters;
  const double before = ratcheting::time_before_minimum(r.weight, p.fmin, p.fmax, p.frequency);
  for (ratcheting::Period& period : r.periods)
    period.active =
        ratcheting::active_phase(wall["t"], wall["x"], wall["v"], wall["f_g"], period.start,
                                 period.force_minimum - before, period.finish);
}

/// Mean of a field over the periods where it is finite; nan if there is none.
double mean(const std::vector<ratcheting::Period>& periods, const auto& field) {
  double sum = 0, count = 0;
  for (const ratcheting::Period& period : periods) {
    const double value = field(period);
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : none;
}

void summarize_wall(Result& r) {
  using ratcheting::Period;
  const auto& periods = r.periods;
  r.dx_max = mean(periods, [](const Period& p) { return p.dx_max; });
  r.dx_spread = std::sqrt(mean(
      periods, [&](const Period& p) { return (p.dx_max - r.dx_max) * (p.dx_max - r.dx_max); }));
  r.v_max = mean(periods, [](const Period& p) { return p.active.v_in; });
  r.delay = mean(periods, [](const Period& p) { return p.delay(); });
  r.net_contraction = mean(periods, [](const Period& p) { return p.jam_before - p.jam_after; });
  r.dx_active = mean(periods, [](const Period& p) { return p.active.dx; });
  r.drift = mean(periods, [](const Period& p) { return p.active.drift; });
  r.thrust = mean(periods, [](const Period& p) { return p.active.thrust; });
  const auto carried = [&](double ratcheting::CarriedGrains::*field) {
    return mean(periods, [=](const Period& p) { return p.active.carried.*field; });
  };
  r.steady_thrust = carried(&ratcheting::CarriedGrains::thrust) / r.weight;
  r.carried_share = carried(&ratcheting::CarriedGrains::mass) / r.mass;
  r.explained = carried(&ratcheting::CarriedGrains::explained);
  r.contracting = 0;
  for (const Period& p : periods) r.contracting += p.jam_after < p.jam_before;
  r.constant = r.dx_max / r.scaled_load();
}

/// @returns see Result::rest_share
double rest_share(const Table& wall, const std::vector<ratcheting::Period>& periods) {
  const std::vector<double>&t = wall["t"], &v = wall["v"];
  return mean(periods, [&](const ratcheting::Period& p) {
    std::vector<double> speeds;
    for (std::size_t k = 0; k < t.size(); ++k)
      if (t[k] >= p.start && t[k] <= p.finish) speeds.push_back(std::abs(v[k]));
    if (speeds.empty()) return none;
    const double rest = 0.01 * *std::max_element(speeds.begin(), speeds.end());
    const auto resting =
        std::count_if(speeds.begin(), speeds.end(), [=](double speed) { return speed < rest; });
    return double(resting) / double(speeds.size());
  });
}

void summarize_packing(const Table& packing, Result& r) {
  const Parameters& p = r.c.parameters;
  const auto inner = [&](double t) { return value_at(packing, "rho_inner", t); };
  r.rho_initial = inner(p.begin());
  r.rho_0 = inner(p.from.empty() ? std::min(0.2, p.duration) : p.first_maximum());
  r.rho_final = packing["rho_inner"].back();
  r.box_initial = packing["rho_box"].front();
  r.box_final = packing["rho_box"].back();
  r.rate = r.compaction_per_period = none;
  if (r.periods.empty()) return;
  const auto add_jam = [&](double t, double x) {
    r.jams.push_back({t, x, inner(t), value_at(packing, "rho_box", t)});
  };
  for (const ratcheting::Period& period : r.periods) add_jam(period.start, period.jam_before);
  add_jam(r.periods.back().finish, r.periods.back().jam_after);
  const double begin = r.periods.front().start, end = r.periods.back().finish;
  r.rate = (inner(end) - inner(begin)) / r.rho_0 / (end - begin);
  r.compaction_per_period = r.rate / p.frequency;
}

/// Whether a phase portrait shows the run: 5 and 10 Hz.
bool is_in_portrait(const Case& c) {
  const bool in_series = std::any_of(c.sets.begin(), c.sets.end(), [&](const std::string& set) {
    return set == "frequencies" || set == "uncorrected" || set == "fine" || set == "tight" ||
           (set == "one-state" && c.parameters.fmax == 6000);
  });
  return in_series && (c.parameters.frequency == 5 || c.parameters.frequency == 10);
}

/// Whether figures show the trajectory, the fields and the force chains of the run: the first
/// sample at 5 Hz.
bool is_baseline(const Case& c) {
  return (c.sets.contains("frequencies") || c.sets.contains("course")) &&
         c.parameters.frequency == 5 && c.parameters.seed == 1;
}

/// Some columns, every `every`-th row.
Columns columns_of(const Table& table, const std::vector<std::string>& names,
                   std::size_t every = 1) {
  Columns columns;
  for (const std::string& name : names) {
    std::vector<double>& values = columns.emplace_back(name, std::vector<double>()).second;
    for (std::size_t row = 0; row < table.rows(); row += every)
      values.push_back(six(table[name][row]));
  }
  return columns;
}

void add_packing(const Tables& run, Result& r) {
  std::vector<std::string> columns{"t", "rho_inner", "rho_box"};
  if (r.c.parameters.method == "compliant")
    columns.insert(columns.end(), {"rho_to_wall", "rho_to_lid", "rho_moving"});
  r.tables.emplace_back("packing", columns_of(run.packing, columns));
}

/// Adds the mean displacements in a period, if the run has them.
void add_field(const std::filesystem::path& folder, Result& r) {
  const std::filesystem::path file = folder / "displacement_field.csv";
  if (std::filesystem::exists(file))
    r.tables.emplace_back("displacement_field",
                          columns_of(Table(file), {"x", "z", "u_x", "u_z", "grains"}));
}

/// Adds the columns of trajectory, packing, velocity field and force chains.
void add_course(const std::filesystem::path& folder, const Tables& run, Result& r) {
  r.tables.emplace_back("wall", columns_of(run.wall, {"t", "f", "x", "v", "f_g"}, 2));
  add_packing(run, r);
  r.tables.emplace_back("state", columns_of(run.state, {"t", "x", "stress_xx", "stress_zz", "roll",
                                                        "roll_strength"}));
  const auto add_file = [&](const std::string& name, const std::vector<std::string>& columns) {
    const std::filesystem::path file = folder / (name + ".csv");
    if (std::filesystem::exists(file))
      r.tables.emplace_back(name, columns_of(Table(file), columns));
  };
  add_file("velocity_field", {"x", "z", "v_x", "v_z", "grains"});
  add_field(folder, r);
  for (const char* state : {"chains_active", "chains_jammed"})
    add_file(state, {"x_from", "z_from", "x_to", "z_to", "normal_force"});
}

/// Adds the solid fraction at force maxima, at numbers of periods that grow by factors of at least
/// 1.05.
void add_long(const Table& packing, Result& r) {
  const Parameters& p = r.c.parameters;
  Columns columns{{"t", {}}, {"periods", {}}, {"rho_inner", {}}, {"rho_box", {}}};
  double next = 0.75;
  for (double period = 0.75; period / p.frequency <= p.begin() + p.duration; period += 1) {
    if (period < next) continue;
    next = 1.05 * period;
    const double t = period / p.frequency;
    columns[0].second.push_back(six(t));
    columns[1].second.push_back(period);
    for (std::size_t k : {2u, 3u})
      columns[k].second.push_back(six(value_at(packing, columns[k].first, t)));
  }
  r.tables.emplace_back("long", std::move(columns));
}

}  // namespace

Push Result::push() const {
  const Parameters& p = c.parameters;
  return {thrust, p.fmin, p.fmax, p.frequency, mass, wall_mass};
}

double Result::flight_displacement() const {
  if (!(std::isfinite(steady_thrust) && wall_mass + carried_share * mass > 0)) return none;
  Push flight = push();
  flight.thrust = steady_thrust * weight;
  return sine_displacement(flight, carried_share);
}

double Result::scaled_load() const {
  const Parameters& p = c.parameters;
  return weight * weight / ((mass + wall_mass) * p.fmax * p.frequency * p.frequency);
}

Result measure(const std::filesystem::path& folder, const Case& c) {
  Result r{};
  r.c = c;
  const double frequency = c.parameters.frequency;
  std::ifstream file(folder / "run.json");
  const auto json = nlohmann::json::parse(file);
  const Tables run{Table(folder / "wall.csv"), Table(folder / "state.csv"),
                   Table(folder / "packing.csv")};
  r.facts = read_facts(json);
  require_complete(folder, run, r);
  r.clock = read_clock(json);
  r.mass = json.at("sample").at("mass");
  r.wall_mass = json.at("sample").at("wall_mass");
  r.length = json.at("box").at("length");
  r.height = json.at("box").at("height");
  r.weight = r.mass * c.parameters.gravity;
  for (const auto& entry : json.at("periods")) {
    const ratcheting::Period period = read_period(entry, frequency);
    if (period.start >= filling_time - 1e-9 || !c.parameters.from.empty())
      r.periods.push_back(period);
  }
  find_active(run.wall, r);
  summarize_wall(r);
  if (const double share = rest_share(run.wall, r.periods); std::isfinite(share))
    r.rest_share = share;
  summarize_packing(run.packing, r);
  r.behaviour = behaviour_of(run, r.periods, frequency);
  if (is_in_portrait(c)) r.loop = mean_loop(run.wall, r.periods);
  if (is_baseline(c)) {
    add_course(folder, run, r);
  } else if (c.sets.contains("course")) {
    add_packing(run, r);
    add_field(folder, r);
  }
  if (c.sets.contains("static"))
    r.tables.emplace_back("wall", columns_of(run.wall, {"t", "x", "f_g"}, 5));
  if (c.sets.contains("long") || c.sets.contains("thousand")) add_long(run.packing, r);
  return r;
}

}  // namespace study
