// SPDX-License-Identifier: MIT
// Runs experiments that others published and writes one table of their figures and those of the library.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "moreau/version.hpp"

#include "session.hpp"

namespace experiments {

std::vector<Experiment> all_experiments() {
  return {
      {"sticking",
       "friction that sticks: grip, launched cube, held cube, blocks on points and meshes",
       "mujoco #3328; genesis-world #3115, #2872; bepuphysics2 #410", sticking, 90, 10},
      {"rebound", "a ball on a mesh and on a half-space", "DEM-Engine #73", rebound, 1, 1},
      {"oblique", "oblique impacts of spheres with tangential restitution", "Foerster et al. 1994",
       oblique, 5, 1},
      {"columns", "collapse of columns, plane and axisymmetric", "Lube et al. 2004, 2005", columns,
       3600, 25},
      {"heap", "heap of spheres by discharge between plates", "Zhou et al. 2002", heap, 45000, 10},
      {"dice", "regular polyhedra poured and shaken", "Baker & Kudrolli 2010", dice, 16000, 15},
      {"squeeze", "control of impact: the same bed with rigid contacts and with springs",
       "Dosta et al. 2024", squeeze, 3600, 10},
      {"impact", "a steel ball falls into beds of glass balls", "Dosta et al. 2024", impact, 12000,
       10},
      {"drum", "two sizes of balls in a rotating drum", "Dosta et al. 2024", drum, 3000, 10},
      {"silo", "discharge of 100,000 balls through two orifices", "Dosta et al. 2024", silo, 40000,
       15},
  };
}

namespace {

void plot(const Options& options) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const std::string place = std::filesystem::absolute(options.output).string();
  if (place.find_first_of("'\"\\") != std::string::npos) return;  // not safe on a command line
  const std::string command = "gnuplot -e \"folder='" + place +
                              "'; data='" EXPERIMENTS_DATA "'\" '" EXPERIMENTS_PLOTS
                              "/all.gp' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0)
    std::fprintf(stderr, "gnuplot: some plots could not be drawn\n");
}

bool is_wanted(const Experiment& one, const Options& options) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), one.name) != options.only.end();
}

void list() {
  for (const Experiment& one : all_experiments())
    std::printf("%-9s %s (%s); about %.2g core-hours, with --quick %.0f core-seconds\n", one.name,
                one.what, one.source, one.core_seconds / 3600, one.quick_core_seconds);
}

/// @returns 0, or 75 if the time was over before the end
int run(const Options& options) {
  double total = 0;
  for (const Experiment& one : all_experiments())
    if (is_wanted(one, options)) total += options.quick ? one.quick_core_seconds : one.core_seconds;
  std::printf("about %.2g core-hours, less what is stored in %s\n", total / 3600,
              options.output.c_str());
  Session session(options);
  bool paused = false;
  double left = total;
  for (const Experiment& one : all_experiments()) {
    if (!is_wanted(one, options)) continue;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), ": %.0f %% done, about %.2g core-hours left",
                  100 * (1 - left / total), left / 3600);
    Session::say(one.name + std::string(text.data()));
    left -= options.quick ? one.quick_core_seconds : one.core_seconds;
    session.begin(one.name);
    try {
      one.run(session);
    } catch (const Paused&) {
      paused = true;
    }
    session.write();
    if (paused) break;
  }
  plot(options);
  std::printf("experiments.md, experiments.csv and the curves are in %s%s\n",
              options.output.c_str(), paused ? "; stopped, the same command continues" : "");
  return paused ? 75 : 0;
}

}  // namespace

}  // namespace experiments

int main(int argc, char** argv) {
  experiments::Options options;
  std::vector<std::string> names;
  for (const experiments::Experiment& one : experiments::all_experiments())
    names.emplace_back(one.name);
  bool only_list = false;
  CLI::App app{"Runs experiments that others published, and compares."};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.add_flag("--list", only_list, "list the experiments with their cost");
  app.add_option("--only", options.only, "run only these")->check(CLI::IsMember(names));
  app.add_option("--part", options.part,
                 "of silo, drum, impact, dice, heap and columns: only the runs with this in their "
                 "names, such as "
                 "'small orifice, M1', 'whole drum', '25000 balls' or 'cubes'");
  app.add_option("--output", options.output, "folder for the results; runs that it holds are kept")
      ->capture_default_str();
  app.add_flag("--quick", options.quick, "smaller versions of all: about two minutes");
  app.add_option("--hold", options.hold, "stop after this time [s]; the same command continues")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads, "threads of the long runs")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (only_list) return experiments::list(), 0;
    return experiments::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
