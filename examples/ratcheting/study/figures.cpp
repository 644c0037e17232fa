// SPDX-License-Identifier: MIT
#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <map>
#include <stdexcept>
#include <string_view>

#include "moreau/io/csv.hpp"
#include "moreau/io/output_file.hpp"

#include "table.hpp"

namespace study {

namespace fs = std::filesystem;

namespace {

fs::path data_file(const fs::path& folder, const std::string& name, const std::string& shape) {
  return folder / "data" / (name + "_" + shape + ".csv");
}

/// The columns of a run's own tables, to six digits.
void write_tables(const fs::path& folder, const Result& r) {
  const Parameters& p = r.c.parameters;
  for (const auto& [name, columns] : r.tables) {
    std::string text;
    for (const auto& column : columns) text += (text.empty() ? "" : ",") + column.first;
    text += '\n';
    char digits[32];
    for (std::size_t row = 0; row < columns.front().second.size(); ++row) {
      for (std::size_t k = 0; k < columns.size(); ++k) {
        std::snprintf(digits, sizeof digits, k == 0 ? "%.6g" : ",%.6g", columns[k].second[row]);
        text += digits;
      }
      text += '\n';
    }
    const std::string file =
        name == "long" ? name + std::to_string(std::lround(p.frequency)) : name;
    moreau::write_atomically(data_file(folder, file, p.shape), text);
  }
}

/// When and where the wall jams, starts and turns.
void write_events(const fs::path& folder, const Result& r) {
  const Parameters& p = r.c.parameters;
  moreau::CsvWriter file(data_file(folder, "events", p.shape),
                         {"period", "t_before", "x_before", "t_onset", "t_force_min", "t_peak",
                          "x_peak", "t_after", "x_after"});
  for (const ratcheting::Period& period : r.periods)
    file.row(std::lround(period.force_minimum * p.frequency - 0.25), six(period.start),
             six(period.jam_before), six(period.active.onset), six(period.force_minimum),
             six(period.active.peak), six(period.x_peak()), six(period.finish),
             six(period.jam_after));
  file.close();
}

void write_loop(const fs::path& folder, const Result& r) {
  const Parameters& p = r.c.parameters;
  const int nu = static_cast<int>(std::lround(p.frequency));
  moreau::CsvWriter file(data_file(folder, "loop" + std::to_string(nu), p.shape),
                         {"x", "v", "x_scaled", "v_scaled"});
  for (const Point& point : r.loop)
    file.row(six(point.x), six(point.y), six(point.x * p.frequency * p.frequency),
             six(point.y * p.frequency));
  file.close();
}

/// Mean and spread over the samples at each value of the parameter.
void write_series(const fs::path& folder, const std::vector<Result>& results,
                  const ShapeSummary& shape, const char* set, double Parameters::*parameter) {
  std::map<double, Series> at;
  for (const SampleSummary& sample : shape.samples)
    for (const Result* r : series_of(results, set, shape.shape, sample.seed, parameter))
      at[r->c.parameters.*parameter].push_back(r);
  if (at.empty()) return;
  moreau::CsvWriter file(data_file(folder, set, shape.shape),
                         {"value", "dx_max", "dx_spread", "v_max", "v_spread", "rate",
                          "rate_spread", "thrust_over_weight", "constant", "samples", "dx_active",
                          "active_spread", "early_rate_box", "early_spread"});
  for (const auto& entry : at) {
    const Series& runs = entry.second;
    const auto of = [&](const auto& field) {
      std::vector<double> values;
      for (const Result* r : runs) values.push_back(field(*r));
      return estimate(values);
    };
    const Estimate dx = of([](const Result& r) { return r.dx_max; });
    const Estimate active = of([](const Result& r) { return r.dx_active; });
    const Estimate v = of([](const Result& r) { return r.v_max; });
    const Estimate rate = of([](const Result& r) { return r.rate; });
    const Estimate thrust = of([](const Result& r) { return r.thrust / r.weight; });
    const Estimate early = of([](const Result& r) { return r.early_rate(&Jam::rho_box); });
    const Estimate constant = of([](const Result& r) { return r.constant; });
    file.row(six(entry.first), six(dx.mean), six(dx.spread), six(v.mean), six(v.spread),
             six(rate.mean), six(rate.spread), six(thrust.mean), six(constant.mean), dx.samples,
             six(active.mean), six(active.spread), six(early.mean), six(early.spread));
  }
  file.close();
}

constexpr double smallest_size = 0.025;  // of the baseline's grains, d [m]

/// One line per run: what was varied (1 frequency, 2 force, 3 gravity, 4 wall mass), load,
/// displacement; the closed form's with beta = 1/3, with the fitted beta, and with thrust and beta
/// of the force on the wall; those two, over the way out without creep against d.
void write_master(const fs::path& folder, const std::vector<Result>& results,
                  const ShapeSummary& shape) {
  moreau::CsvWriter file(data_file(folder, "master", shape.shape),
                         {"varied", "load", "dx_max", "predicted_third", "predicted", "dx_active",
                          "flight", "way_over_d", "steady_thrust_over_weight", "carried_share"});
  for (const SampleSummary& sample : shape.samples)
    for (const Result* r : master_series(results, shape.shape, sample.seed)) {
      const auto& sets = r->c.sets;
      const int varied = sets.contains("frequencies") ? 1
                         : sets.contains("fmax")      ? 2
                         : sets.contains("gravity")   ? 3
                                                      : 4;
      file.row(double(varied), six(r->scaled_load()), six(r->dx_max),
               six(sine_displacement(r->push(), 1.0 / 3)),
               six(sine_displacement(r->push(), sample.prediction.beta)), six(r->dx_active),
               six(r->flight_displacement()), six(r->dx_active / smallest_size),
               six(r->steady_thrust), six(r->carried_share));
    }
  file.close();
}

/// 1: the baseline's gravity and sizes, 2: other gravity, 3: other sizes.
void write_relaxation(const fs::path& folder, const std::vector<Result>& results,
                      const ShapeSummary& shape) {
  const Series series = series_of(results, "relaxation", shape.shape, 1);
  if (series.empty()) return;
  moreau::CsvWriter file(data_file(folder, "relaxation", shape.shape),
                         {"condition", "frequency", "scaled_frequency", "rate", "scaled_rate"});
  for (const Result* r : series) {
    const Parameters& p = r->c.parameters;
    const double unit = std::sqrt(p.gravity / (0.025 * p.size_scale));
    const int condition = p.gravity != 9.81 ? 2 : p.size_scale != 1 ? 3 : 1;
    file.row(double(condition), p.frequency, six(p.frequency / unit), six(r->rate),
             six(r->rate / unit));
  }
  file.close();
}

/// Lines name,value that the scripts look up: NAME_shape.
class Values {
 public:
  void add(const std::string& name, double value) {
    if (!std::isfinite(value)) return;
    char text[32];
    std::snprintf(text, sizeof text, ",%.6g\n", value);
    lines_ += name + text;
  }
  void write(const fs::path& path) const {
    moreau::write_atomically(path, "name,value\n" + lines_);
  }

 private:
  std::string lines_;
};

void add_values(const ShapeSummary& s, Values& values) {
  using Sample = SampleSummary;
  const auto add = [&](const char* name, const auto& of) {
    values.add(std::string(name) + "_" + s.shape, over_samples(s, of).mean);
  };
  const auto add_law = [&](const std::string& name, const auto& law) {
    values.add(name + "_exponent_" + s.shape,
               over_samples(s, [&](const Sample& x) { return law(x).exponent; }).mean);
    values.add(name + "_prefactor_" + s.shape,
               over_samples(s, [&](const Sample& x) { return law(x).prefactor; }).mean);
  };
  add_law("dx_frequency", [](const Sample& x) { return x.whole.frequency; });
  add_law("active_frequency", [](const Sample& x) { return x.active.frequency; });
  add_law("active_fmax", [](const Sample& x) { return x.active.fmax; });
  add_law("active_gravity", [](const Sample& x) { return x.active.gravity; });
  add("active_wall_beta", [](const Sample& x) { return x.active.wall_share.beta; });
  add("active_C", [](const Sample& x) { return x.active.master.factor; });
  add_law("v_frequency", [](const Sample& x) { return x.v_frequency; });
  add_law("dx_fmax", [](const Sample& x) { return x.whole.fmax; });
  add_law("dx_gravity", [](const Sample& x) { return x.whole.gravity; });
  add("C", [](const Sample& x) { return x.whole.master.factor; });
  add("C_scatter", [](const Sample& x) { return x.whole.master.scatter; });
  add("beta", [](const Sample& x) { return x.prediction.beta; });
  add("wall_beta", [](const Sample& x) { return x.whole.wall_share.beta; });
  add("nu_c", [](const Sample& x) { return x.rate.branches.nu_c; });
  add("rate_prefactor", [](const Sample& x) { return x.rate.branches.prefactor; });
  add("single_nu_c", [](const Sample& x) { return x.rate.single.nu_c; });
  add("single_prefactor", [](const Sample& x) { return x.rate.single.prefactor; });
  for (const Sample& sample : s.samples) {
    if (sample.seed != 1 || sample.base == nullptr) continue;
    const Behaviour& b = sample.behaviour;
    values.add("jammed_xx_" + s.shape, b.jammed_xx);
    values.add("jammed_zz_" + s.shape, b.jammed_zz);
    values.add("active_xx_" + s.shape, b.active_xx);
    values.add("active_zz_" + s.shape, b.active_zz);
    values.add("length_" + s.shape, sample.base->length);
    values.add("load_" + s.shape, sample.base->scaled_load());
    values.add("height_" + s.shape, sample.base->height);
    const Parameters& p = sample.base->c.parameters;
    values.add("mass_ratio_" + s.shape, p.wall_mass_ratio);
    values.add("roll_" + s.shape, sample.base->facts.roll);
    values.add("roll_strength_" + s.shape, sample.base->facts.roll_strength);
    values.add("loop_distance_" + s.shape, sample.loop_distance);  // of the loops that are drawn
  }
}

void write_shape(const fs::path& folder, const std::vector<Result>& results,
                 const ShapeSummary& shape) {
  for (const double frequency : {5.0, 10.0}) {
    const Result* r =
        find(results, "frequencies", shape.shape, 1, &Parameters::frequency, frequency);
    if (r == nullptr) continue;
    write_loop(folder, *r);
    if (frequency == 5) write_events(folder, *r);
  }
  write_series(folder, results, shape, "frequencies", &Parameters::frequency);
  write_series(folder, results, shape, "fmax", &Parameters::fmax);
  write_series(folder, results, shape, "gravity", &Parameters::gravity);
  write_series(folder, results, shape, "wall-mass", &Parameters::wall_mass_ratio);
  write_master(folder, results, shape);
  write_relaxation(folder, results, shape);
  for (const Result& r : results)
    if (r.c.parameters.shape == shape.shape) write_tables(folder, r);
}

}  // namespace

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all{
      {"x_t",
       "The wall's displacement under the harmonic force, 5 Hz (paper, fig. 4)",
       {"frequencies"}},
      {"one_period",
       "One period: blocked, out (a to b), back in (b to c) (paper, fig. 5)",
       {"frequencies"}},
      {"velocity_field",
       "Velocities while the wall moves in, at its largest speed (paper, fig. 6)",
       {"frequencies"}},
      {"f_g_x",
       "Force of the grains on the wall over its displacement (paper, fig. 7)",
       {"frequencies"}},
      {"force_chains",
       "Normal forces, jammed and active, in a section, each panel relative to its own mean "
       "(paper, "
       "fig. 8)",
       {"frequencies"}},
      {"rho_t", "Change of the solid fraction over time (paper, fig. 9)", {"frequencies"}},
      {"rho_x",
       "Change of the solid fraction over the displacement (paper, fig. 10)",
       {"frequencies"}},
      {"phase_portrait",
       "Phase portraits at 5 and 10 Hz, raw and scaled (paper, fig. 11)",
       {"frequencies"}},
      {"dx_v_frequency",
       "Largest displacement and passive speed over the frequency (paper, fig. 12)",
       {"frequencies"}},
      {"dx_fmax", "Largest displacement over the force (paper, fig. 13)", {"fmax"}},
      {"dx_gravity", "Largest displacement over gravity (paper, fig. 14)", {"gravity"}},
      {"dx_wall_mass", "Largest displacement over the mass of the wall", {"wall-mass"}},
      {"master",
       "Largest displacement over the scaled load, with C and with the closed form from the "
       "measured thrust (paper, fig. 15)",
       {"frequencies", "fmax", "gravity", "wall-mass"}},
      {"flight",
       "Thrust of the grains and mass that they add to the wall while it moves out, over the way "
       "out",
       {"frequencies", "fmax", "gravity", "wall-mass"}},
      {"compaction_rate",
       "Compaction rate over the frequency with both forms (paper, fig. 16)",
       {"frequencies"}},
      {"relaxation", "Compaction rate for other gravity and other sizes", {"relaxation"}},
      {"rho_log_t", "Solid fraction over a hundred periods", {"long"}}};
  return all;
}

void write_figure_data(const fs::path& folder, const std::vector<Result>& results,
                       const std::vector<ShapeSummary>& shapes) {
  fs::create_directories(folder / "data");
  Values values;
  for (const ShapeSummary& shape : shapes) {
    write_shape(folder, results, shape);
    add_values(shape, values);
  }
  values.write(folder / "data" / "values.csv");
}

std::vector<std::string> draw_figures(const fs::path& folder, const fs::path& scripts,
                                      const std::vector<Result>& results,
                                      const std::vector<std::string>& names) {
  if (!fs::exists(scripts / "style.gp"))
    throw std::invalid_argument("--plots: " + scripts.string() + " has no style.gp");
  fs::create_directories(folder / "figures");
  std::vector<std::string> missing;
  for (const Figure& figure : figures()) {
    const std::string name = figure.name;
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
    const bool has_runs = std::any_of(results.begin(), results.end(), [&](const Result& r) {
      return std::any_of(figure.sets.begin(), figure.sets.end(),
                         [&](const std::string& set) { return r.c.sets.contains(set); });
    });
    if (!has_runs) continue;
    for (const char* format : {"png", "svg"}) {
      const fs::path log = folder / "figures" / (name + "." + format + ".log");
      const std::string command =
          "gnuplot -e \"data='" + (folder / "data").string() + "'; format='" + format + "'; out='" +
          (folder / "figures" / (name + "." + format)).string() + "'\" '" +
          (scripts / (name + ".gp")).string() + "' >'" + log.string() + "' 2>&1";
      if (std::system(command.c_str()) == 0) {
        fs::remove(log);
      } else {
        missing.push_back(name + "." + format + ", see " + log.string());
      }
    }
  }
  return missing;
}

}  // namespace study
