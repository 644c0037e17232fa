// SPDX-License-Identifier: MIT
#include "tables.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "moreau/io/output_file.hpp"

namespace study {

namespace {

/// Comma-separated values, numbers to nine digits: what the same runs give on any day.
class CsvLine {
 public:
  CsvLine& operator<<(const std::string& text) {
    line_ += (line_.empty() ? "" : ",") + text;
    return *this;
  }
  CsvLine& operator<<(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return *this << std::string(text);
  }
  std::string end() && { return std::move(line_) + "\n"; }

 private:
  std::string line_;
};

/// To so many significant digits.
std::string text_of(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string joined(const std::set<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// What an earlier report told of runs whose folders may be gone; nothing without the file.
std::map<std::string, WallClock> read_wall_clock(const std::filesystem::path& path) {
  std::map<std::string, WallClock> clocks;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    char name[128];
    WallClock clock;
    if (std::sscanf(line.c_str(), "%*[^,],%127[^,],%lf,%lf,%*[^,],%lf", name, &clock.prepare,
                    &clock.vibrate, &clock.median_ms) == 4)
      clocks[name] = clock;
  }
  return clocks;
}

}  // namespace

void write_cases(const std::filesystem::path& folder, const std::vector<Result>& results) {
  std::string text =
      "case,name,sets,shape,seed,frequency,fmax,fmin,gravity,wall_mass_ratio,box_ratio,size_scale,"
      "reading,lid_force,step,tolerance,corrected,duration,mass,wall_mass,length,height,settled,"
      "periods,dx_max,dx_spread,dx_active,drift,v_max,delay,thrust_over_weight,net_contraction,"
      "contracting,"
      "rho_initial,rho_0,rho_final,rho_box_initial,rho_box_final,rate,compaction_per_period,C,"
      "dx_over_closed_form_third,steady_thrust_over_weight,carried_share,explained,"
      "dx_over_flight,early_rate_inner,early_rate_box,steps,capped_steps,mean_sweeps,worst_"
      "residual,mean_overlap_over_d,"
      "max_overlap_over_d,grains,method,stiffness,friction,flatness,fewest_vertices,most_vertices,"
      "wall_"
      "speed,from,judged\n";
  for (const Result& r : results) {
    const Parameters& p = r.c.parameters;
    CsvLine line;
    line << double(r.c.number) << r.c.name << joined(r.c.sets) << p.shape << double(p.seed)
         << p.frequency << p.fmax << p.fmin << p.gravity << p.wall_mass_ratio << p.box_ratio
         << p.size_scale
         << (p.size_reading == moreau::SizeReading::circumdiameter ? "circumdiameter"
                                                                   : "circumradius")
         << p.lid_force << p.step << p.tolerance << double(p.correction) << p.duration << r.mass
         << r.wall_mass << r.length << r.height << double(r.facts.settled)
         << double(r.periods.size()) << r.dx_max << r.dx_spread << r.dx_active << r.drift << r.v_max
         << r.delay << r.thrust / r.weight << r.net_contraction << double(r.contracting)
         << r.rho_initial << r.rho_0 << r.rho_final << r.box_initial << r.box_final << r.rate
         << r.compaction_per_period << r.constant
         << r.dx_active / sine_displacement(r.push(), 1.0 / 3) << r.steady_thrust << r.carried_share
         << r.explained << r.dx_active / r.flight_displacement() << r.early_rate(&Jam::rho_inner)
         << r.early_rate(&Jam::rho_box);
    const Facts& f = r.facts;
    line << double(f.steps) << double(f.capped_steps) << f.mean_sweeps << f.worst_residual
         << f.mean_overlap << f.max_overlap;
    line << double(p.grains) << p.method << p.stiffness << p.friction << p.flatness
         << double(p.fewest_vertices) << double(p.most_vertices) << p.wall_speed
         << (p.from.empty() ? "filling" : p.from) << double(r.is_judged());
    text += std::move(line).end();
  }
  moreau::write_atomically(folder / "cases.csv", text);
}

void write_wall_clock(const std::filesystem::path& folder, const std::vector<Result>& results) {
  const std::map<std::string, WallClock> told = read_wall_clock(folder / "wall_clock.csv");
  std::string csv = "case,name,prepare,vibrate,steps,median_ms_per_step\n";
  std::map<std::pair<std::string, std::string>, std::pair<double, std::size_t>> of_series;
  double all = 0, steps = 0;
  std::size_t known = 0;
  for (const Result& r : results) {
    const auto before = told.find(r.c.name);
    if (!r.clock && before == told.end()) continue;
    const WallClock clock = r.clock ? *r.clock : before->second;
    CsvLine line;
    line << double(r.c.number) << r.c.name << clock.prepare << clock.vibrate
         << double(r.facts.steps) << clock.median_ms;
    csv += std::move(line).end();
    const double seconds = clock.prepare + clock.vibrate;
    all += seconds;
    steps += double(r.facts.steps);
    ++known;
    for (const std::string& set : r.c.sets) {
      auto& [sum, runs] =
          of_series[{set, r.c.parameters.shape + ", seed " + std::to_string(r.c.parameters.seed)}];
      sum += seconds;
      ++runs;
    }
  }
  moreau::write_atomically(folder / "wall_clock.csv", csv);
  std::string text = "# Wall clock\n\nSeconds of one process each, preparation and vibration. " +
                     std::to_string(known) + " runs (of " + std::to_string(results.size() - known) +
                     " it is not known), " + text_of(all / 60, 4) + " min in all, " +
                     text_of(1e3 * all / steps, 3) +
                     " ms per step of the vibration. A run in several series counts in each.\n\n"
                     "| series | sample | runs | min |\n|---|---|---|---|\n";
  for (const auto& [key, value] : of_series)
    text += "| " + key.first + " | " + key.second + " | " + std::to_string(value.second) + " | " +
            text_of(value.first / 60, 3) + " |\n";
  moreau::write_atomically(folder / "wall_clock.md", text);
}

void write_remaining(const std::filesystem::path& folder, const std::string& name,
                     const std::vector<Case>& plan, const std::vector<Result>& results) {
  std::set<std::string> done;
  for (const Result& r : results) done.insert(r.c.name);
  struct Left {
    std::size_t runs = 0, all = 0;
    double steps = 0, seconds = 0;
  };
  std::map<std::string, Left> of_series;
  Left whole;
  for (const Case& c : plan) {
    const bool missing = !done.contains(c.name);
    const auto add = [&](Left& left) {
      ++left.all;
      if (!missing) return;
      ++left.runs;
      left.steps += c.parameters.duration / c.parameters.step;
      left.seconds += seconds_of(c.parameters);
    };
    add(whole);
    for (const std::string& set : c.sets) add(of_series[set]);
  }
  std::string text = "| series | runs not done, of | steps | core-hours |\n|---|---|---|---|\n";
  const auto row = [&](const std::string& series, const Left& left) {
    text += "| " + series + " | " + std::to_string(left.runs) + " of " + std::to_string(left.all) +
            " | " + std::to_string(std::llround(left.steps)) + " | " +
            text_of(left.seconds / 3600, 2) + " |\n";
  };
  for (const auto& [series, left] : of_series) row(series, left);
  row("all (a run in several series counts once)", whole);
  moreau::write_atomically(folder / ("remaining-" + name + ".md"), text);
}

}  // namespace study
