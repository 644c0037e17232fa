// SPDX-License-Identifier: MIT
// An avalanche of any number of grains, of four shapes, with progress, restart and pictures.
//
//   avalanche --shape sphere|polyhedron|disk|polygon --grains N [options]
//
// Writes into the folder: avalanche.csv, pictures, ParaView files, avalanche.snapshot. The same
// command continues a run that was stopped or killed, from its last snapshot, with the same bits.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "moreau/io/csv.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/picture/write_picture.hpp"

#include "avalanche.hpp"

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

struct Options {
  std::string shape;
  std::size_t grains = 0;
  fs::path output = "avalanche-output";
  int threads = 1;
  std::uint64_t seed = 1;
  double minutes = std::numeric_limits<double>::infinity(), snapshot = 120;
};

/// Ends the program after --help, and with status 2 for wrong arguments.
Options read_options(int count, char** arguments) {
  Options options;
  CLI::App app("An avalanche of any number of grains, with progress, restart and pictures",
               "avalanche");
  app.option_defaults()->always_capture_default();
  app.add_option("--shape", options.shape, "of the grains; sets the dimension")
      ->required()
      ->check(CLI::IsMember({"sphere", "polyhedron", "disk", "polygon"}));
  app.add_option("--grains", options.grains, "their number")
      ->required()
      ->check(CLI::Range(100, 100000000));
  app.add_option("--output", options.output,
                 "folder of all files; an unfinished run in it is continued");
  app.add_option("--threads", options.threads, "the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  app.add_option("--seed", options.seed, "of sizes, shapes and places")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_option("--minutes", options.minutes,
                 "stop after so many minutes with a snapshot; the same command continues")
      ->check(CLI::Range(0.0, std::numeric_limits<double>::infinity()));
  app.add_option("--snapshot", options.snapshot, "seconds from one snapshot to the next")
      ->check(CLI::Range(0.0, std::numeric_limits<double>::infinity()));
  try {
    app.parse(count, arguments);
    if (std::isnan(options.minutes) || std::isnan(options.snapshot))
      throw CLI::ValidationError("--minutes, --snapshot", "must be numbers");
  } catch (const CLI::ParseError& end) {
    std::exit(app.exit(end) == 0 ? 0 : 2);
  }
  return options;
}

/// Memory of the process [bytes]; 0 where it cannot be known.
double memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * double(sysconf(_SC_PAGESIZE));
}

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A run with its files.
template <class Shape>
class Run {
 public:
  using Avalanche = avalanche::Avalanche<Shape>;

  explicit Run(const Options& options) : options_(options), avalanche_(options.threads) {
    fs::create_directories(options.output);
    if (fs::exists(snapshot())) {
      const auto start = Clock::now();
      moreau::read_snapshot(snapshot(), avalanche_.simulation, avalanche_.progress, table_size_,
                            grains_, seed_);
      if (grains_ != options.grains || seed_ != options.seed)
        throw std::runtime_error(snapshot().string() + " is of a run with other parameters");
      std::printf("continues at step %llu; read in %.1f s\n", step(), since(start));
    } else {
      grains_ = options.grains, seed_ = options.seed;
      const auto start = Clock::now();
      avalanche_.build(grains_, seed_);
      std::printf("%zu grains built in %.1f s\n", options.grains, since(start));
    }
    std::fflush(stdout);
  }

  /// @returns whether the grains have come to rest or the longest time has passed
  bool go() {
    moreau::CsvWriter table(options_.output / "avalanche.csv",
                            {{"t", "s"},
                             "open",
                             {"front", "m"},
                             {"mean_speed", "m/s"},
                             "points",
                             "sweeps",
                             "residual",
                             {"max_overlap", "m"}},
                            10, table_size_);
    first_step_ = shown_step_ = avalanche_.progress.step;
    start_ = shown_ = saved_ = Clock::now();
    const double longest = avalanche_.longest_flow();
    while (!is_over(longest)) {
      const moreau::StepReport report = avalanche_.step();
      const auto& state = avalanche_.progress;
      if (state.step % 10 == 0)
        table.row(avalanche_.time(), int(state.opened_at > 0), state.front, state.mean_speed,
                  report.points, report.solve.sweeps, report.solve.residual, report.max_overlap);
      if (since(shown_) > (terminal_ ? 0.5 : 10.0)) show(report, longest);
      if (state.opened_at == state.step) draw("at_rest");
      if (state.opened_at > 0 && state.step == state.opened_at + middle()) draw("flow");
      const bool stops = since(start_) > 60 * options_.minutes;
      if (stops || since(saved_) > options_.snapshot) save(table);
      if (stops) return false;
    }
    save(table);
    finish();
    return true;
  }

 private:
  fs::path snapshot() const { return options_.output / "avalanche.snapshot"; }
  unsigned long long step() const { return avalanche_.progress.step; }
  double flow_time() const {
    const auto& state = avalanche_.progress;
    return state.opened_at == 0 ? 0 : double(state.step - state.opened_at) * state.h;
  }
  bool is_over(double longest) const { return avalanche_.is_at_rest() || flow_time() >= longest; }
  std::uint64_t middle() const {
    return static_cast<std::uint64_t>(0.25 * avalanche_.longest_flow() / avalanche_.progress.h);
  }

  void show(const moreau::StepReport& report, double longest) {
    // Of the steps since the last line.
    const double per_step = since(shown_) / double(step() - shown_step_);
    shown_ = Clock::now();
    shown_step_ = step();
    const auto& state = avalanche_.progress;
    const bool settles = state.opened_at == 0;
    const double left = (settles ? longest : longest - flow_time()) / state.h;
    std::printf(
        "%s%s: step %llu, t = %.3f s  %zu points  %3d sweeps  residual %.0e  mean speed %.3f m/s  "
        "%.0f ms/step  at most %.0f s%s%s",
        terminal_ ? "\r" : "", settles ? "settles" : "flows  ", step(), avalanche_.time(),
        report.points, report.solve.sweeps, report.solve.residual, state.mean_speed, 1e3 * per_step,
        left * per_step, settles ? " of flow after the grains rest" : " left",
        terminal_ ? "\033[K" : "\n");
    std::fflush(stdout);
  }
  void save(moreau::CsvWriter& table) {
    table.sync();
    table_size_ = table.size();
    moreau::write_snapshot(snapshot(), avalanche_.simulation, avalanche_.progress, table_size_,
                           grains_, seed_);
    saved_ = Clock::now();
  }
  /// Layers of the first deposit, from bottom to top, in colours from dark to light.
  void draw(const std::string& name) {
#ifndef MOREAU_WITHOUT_PNG
    const auto begin = Clock::now();
    // The walls have the lowest numbers.
    const std::size_t first = avalanche_.simulation.grains()[0].index();
    const auto color = [&](moreau::BodyId grain) {
      return moreau::rendering::speed_color(avalanche_.progress.layer[grain.index() - first] / 7.0);
    };
    moreau::write_picture(options_.output / (name + ".png"), avalanche_.simulation, color,
                          {.width = 1400, .height = 800, .azimuth = 20, .elevation = 18});
    start_ += Clock::now() - begin;  // not a part of the time of the steps
#else
    static_cast<void>(name);
#endif
  }
  void finish() {
    const auto& state = avalanche_.progress;
    const auto took = [](auto&& work) {
      const auto start = Clock::now();
      work();
      return since(start);
    };
    const double steps = double(step() - first_step_);
    const double run = since(start_);
    std::printf(
        "%s%s after %llu steps, %.2f s; the gate opened at step %llu; front %.2f m; "
        "mean speed %.1e (g d)^1/2\n",
        terminal_ ? "\n" : "", avalanche_.is_at_rest() ? "at rest" : "ended", step(),
        avalanche_.time(), static_cast<unsigned long long>(state.opened_at), state.front,
        state.mean_speed / std::sqrt(avalanche::gravity * avalanche::size));
    if (steps > 0)
      std::printf("%.0f steps in %.0f s: %.2f us per grain and step; %llu steps not solved\n",
                  steps, run, 1e6 * run / steps / double(grains_),
                  static_cast<unsigned long long>(state.unsolved));
    std::printf("memory %.0f MB: %.1f kB per grain\n", 1e-6 * memory(),
                1e-3 * memory() / double(grains_));
    std::printf("snapshot: %.0f MB in %.1f s\n", 1e-6 * double(fs::file_size(snapshot())),
                took([&] {
                  moreau::write_snapshot(snapshot(), avalanche_.simulation, state, table_size_,
                                         grains_, seed_);
                }));
    std::printf("ParaView files: %.1f s\n", took([&] {
                  moreau::write_paraview(options_.output / "end", avalanche_.simulation, state.h);
                }));
    std::printf("picture: %.1f s\n", took([&] { draw("end"); }));
  }

  Options options_;
  Avalanche avalanche_;
  std::uint64_t grains_ = 0, seed_ = 0, first_step_ = 0, shown_step_ = 0;
  std::uintmax_t table_size_ = 0;
  Clock::time_point start_, shown_, saved_;
  bool terminal_ = isatty(STDOUT_FILENO) != 0;
};

bool run(const Options& options) {
  if (options.shape == "sphere") return Run<moreau::Ball<double>>(options).go();
  if (options.shape == "polyhedron") return Run<moreau::Polyhedron<double>>(options).go();
  if (options.shape == "disk") return Run<moreau::Disk<double>>(options).go();
  if (options.shape == "polygon") return Run<moreau::Polygon<double>>(options).go();
  throw std::invalid_argument("--shape: there is no " + options.shape);
}

}  // namespace

/// Returns 0 when the run has ended, 3 when it stopped before, 2 for wrong arguments.
int main(int count, char** arguments) {
  try {
    return run(read_options(count, arguments)) ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
