// SPDX-License-Identifier: MIT
// The run from end to end, with grains of one shape and one method. CMake compiles this file once
// for each of RATCHETING_SHAPES and each method, with their names as RATCHETING_SHAPE and
// RATCHETING_METHOD.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <unistd.h>

#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "experiment.hpp"
#include "methods.hpp"
#include "progress.hpp"
#include "recorder.hpp"
#include "run.hpp"
#include "run_json.hpp"
#include "views.hpp"

#define RATCHETING_TEXT_OF(name) #name
#define RATCHETING_TEXT(name) RATCHETING_TEXT_OF(name)

namespace ratcheting {

namespace {

/// The types of the grains, under the names of --shape.
namespace shapes {
using polyhedron = moreau::Polyhedron<double>;
using polygon = moreau::Polygon<double>;
using sphere = moreau::Ball<>;
using disk = moreau::Disk<>;
using compound = moreau::Compound<moreau::Polyhedron<double>>;
using compound_polygon = moreau::Compound<moreau::Polygon<double>>;
}  // namespace shapes

/// The methods, under the names of --method.
namespace methods {
using contact_dynamics = ContactDynamics;
using compliant = CompliantDynamics;
using springs = SpringDynamics;
}  // namespace methods

/// Thickness of the plane's grains such that the sample weighs what the same sample weighs in space
/// [m]; 1 in space.
template <class ShapeT>
double thickness_of(const Parameters& p) {
  std::mt19937_64 own(p.seed), twin(p.seed);
  using Twin = typename SolidTwin<ShapeT>::type;
  return make_grains<Twin>(p, twin).volume / make_grains<ShapeT>(p, own).volume;
}

/// @throws std::invalid_argument if the folder cannot be made or a file cannot be made in it
void require_writable(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::invalid_argument("--output: cannot make folder " + folder + ": " + error.message());
  const auto probe = std::filesystem::path(folder) / "wall.csv";
  if (!std::ofstream(probe, std::ios::app))
    throw std::invalid_argument("--output: cannot write " + probe.string());
}

/// @throws std::invalid_argument for parameters that make no experiment
template <class ExperimentT>
void require_experiment(const Parameters& p, const ExperimentT& experiment) {
  if (p.step > p.duration)
    throw std::invalid_argument("--step: " + std::to_string(p.step) +
                                " s must not exceed --duration " + std::to_string(p.duration) +
                                " s");
  const double inset = Recorder<ExperimentT>::inset(experiment);
  if (std::min(experiment.length(), experiment.width()) <= 2 * inset)
    throw std::invalid_argument("--grains: " + std::to_string(p.grains) + " make a box " +
                                std::to_string(experiment.length()) +
                                " m long, too short for a control volume " + std::to_string(inset) +
                                " m from its side walls; more grains or a larger --box-length");
}

/// Time between two lines of packing.csv [s].
constexpr double packing_interval = 1e-3;

/// Prints a summary: results, warnings, and where the files are.
template <class ExperimentT>
void conclude(const Parameters& p, const ExperimentT& experiment, const SolverTotals& totals,
              const Json& results) {
  const double size = experiment.simulation().grain_size();
  if (results.contains("dx_max"))
    std::printf("mean of %zu periods: dx_max = %.4g mm, C = %.3g\n",
                results["periods"].template get<std::size_t>(),
                1e3 * results["dx_max"].template get<double>(),
                results["C"].template get<double>());
  if (results.contains("rho_initial"))
    std::printf("solid fraction of the control volume: %.4f, at the end %.4f\n",
                results["rho_initial"].template get<double>(),
                results["rho_final"].template get<double>());
  std::printf("overlaps: mean %.1e d, largest %.1e d\n", totals.mean(totals.mean_overlap) / size,
              totals.max_overlap / size);
  if (ExperimentT::solves)
    std::printf("%zu of %zu steps did not converge; cap: %d sweeps\n", totals.capped, totals.steps,
                p.max_sweeps);
  if (!experiment.settled())
    std::printf("note: the sample was still moving when the preparation's %g s were over\n",
                p.preparation_time);
  if (totals.max_overlap > 0.01 * size)
    std::printf(
        "WARNING: an overlap beyond 1 %% of the smallest grain: a smaller --step or a "
        "larger --margin\n");
  std::printf("files in %s\n", p.output.c_str());
}

/// Mass of the lightest grain of the sample [kg].
template <class ShapeT>
double lightest_grain(const Parameters& p, double thickness) {
  std::mt19937_64 random(p.seed);
  double volume = std::numeric_limits<double>::infinity();
  for (const ShapeT& shape : make_grains<ShapeT>(p, random).shapes)
    volume = std::min(volume, shape.volume());
  return p.density * thickness * volume;
}

/// The parameters that determine the results of a run, as a text.
std::string identity(const Parameters& p) {
  Json json = to_json(p);
  json.erase("threads");
  return json.dump();
}

/// The parameters that do not change the packing: force, wall and solver of the experiment.
constexpr const char* later[] = {"frequency",
                                 "fmax",
                                 "fmin",
                                 "gravity",
                                 "wall_mass_ratio",
                                 "duration",
                                 "step",
                                 "lid_raise",
                                 "tolerance",
                                 "stop_test",
                                 "max_sweeps",
                                 "cold_sweeps",
                                 "overlap_correction",
                                 "solver",
                                 "threads",
                                 "cold_start",
                                 "order",
                                 "from",
                                 "from_method",
                                 "hold",
                                 "wall_speed"};

/// The parameters that determine the packing, as a text.
std::string packing_identity(const Parameters& p) {
  Json json = to_json(p);
  for (const char* key : later) json.erase(key);
  return json.dump();
}

/// Reads a checkpoint of another run and makes it the start of this run.
/// @param read reads the checkpoint and returns the parameters that it was made by
/// @throws std::invalid_argument if the file's packing was made by other parameters
template <class ExperimentT, class Read>
void start_from(const Parameters& p, ExperimentT& experiment, const Read& read) {
  if constexpr (ExperimentT::solves) {
    const std::string made_by = read();
    const auto sample = [&](const std::string& made) {
      Json json = Json::parse(made);
      for (const char* key : later) json.erase(key);
      json.erase("stiffness");
      if (!p.from_method.empty()) json.erase("method");
      return json.dump();
    };
    if (sample(made_by) != sample(identity(p)))
      throw std::invalid_argument("--from: " + p.from +
                                  " was made with other parameters: " + made_by);
    experiment.start_again(Json::parse(made_by)["stiffness"].get<double>());
  } else {
    throw std::invalid_argument("--from: --method springs cannot start from a checkpoint");
  }
}

/// Reads a checkpoint of a run into its experiment.
/// @returns the parameters that it was made by
template <class ExperimentT>
std::string read_checkpoint_of(const Parameters& p, ExperimentT& experiment) {
  std::string made_by;
  std::size_t steps = 0, files = 0;
  typename Recorder<ExperimentT>::Record before;
  Views<ExperimentT> views(experiment, p.step, p.output);
  experiment.read_checkpoint(p.from, made_by, steps, files, before, views.grains(),
                             views.contacts());
  return made_by;
}

/// The same with the checkpoint of a run with compliant contacts, for a run with rigid ones.
template <class ShapeT, class ExperimentT>
std::string read_compliant_checkpoint(const Parameters& p, ExperimentT& experiment) {
  if constexpr (std::is_same_v<ExperimentT, Experiment<ShapeT, ContactDynamics>>) {
    Experiment<ShapeT, CompliantDynamics> other(p, experiment.thickness());
    const std::string made_by = read_checkpoint_of(p, other);
    experiment.place_as(other);
    return made_by;
  } else {
    throw std::invalid_argument("--from-method: needs --method contact-dynamics");
  }
}

/// @throws std::invalid_argument if the file's packing was made by other parameters
template <class ExperimentT>
void read_packing(const Parameters& p, ExperimentT& experiment) {
  std::string made_by;
  experiment.read_packing(p.packing, made_by);
  if (made_by != packing_identity(p))
    throw std::invalid_argument("--packing: " + p.packing +
                                " was made with other parameters: " + made_by);
}

/// Several runs may write the same packing at once, so each writes its own file and renames it.
template <class ExperimentT>
void write_packing(const Parameters& p, const ExperimentT& experiment) {
  const std::string own = p.packing + "." + std::to_string(::getpid());
  experiment.write_packing(own, packing_identity(p));
  std::filesystem::rename(own, p.packing);
}

/// Makes or reads the packing, and writes the first line of packing.csv.
/// @returns false if it was interrupted
template <class ExperimentT>
bool prepare(const Parameters& p, ExperimentT& experiment, Recorder<ExperimentT>& recorder,
             RunJson& json, Progress& progress, Stopwatch& watch) {
  try {
    if (!p.from.empty()) {
      recorder.set_control_volume();
      recorder.record_packing();
      json.stage("prepare", watch.lap());
      return true;
    }
    if (!p.packing.empty() && std::filesystem::exists(p.packing)) {
      read_packing(p, experiment);
      std::printf("packing of %s\n", p.packing.c_str());
    } else {
      experiment.compress([&](const char* stage, const moreau::StepReport& report) {
        progress.preparing(stage, report, experiment.simulation().time());
        if (interrupted()) throw Interrupted{};
      });
      if (!p.packing.empty()) write_packing(p, experiment);
    }
    experiment.release();
  } catch (const Interrupted&) {
    progress.finish();
    json.stage("prepare", watch.lap());
    json.write_unprepared(p);
    std::printf("interrupted before the force started: no results\n");
    return false;
  }
  json.stage("prepare", watch.lap());
  recorder.set_control_volume();
  recorder.record_packing();
  return true;
}

template <class ShapeT, class Method>
int run(const Parameters& asked) {
  Stopwatch watch;
  const double thickness = thickness_of<ShapeT>(asked);
  const Parameters p = Method::settled(asked, lightest_grain<ShapeT>(asked, thickness));
  using ExperimentT = Experiment<ShapeT, Method>;
  ExperimentT experiment(p, thickness);
  require_experiment(p, experiment);
  require_writable(p.output);
  Views<ExperimentT> views(experiment, p.step, p.output);
  typename Recorder<ExperimentT>::Record record;
  std::size_t done = 0, snapshots = 0;
  const auto checkpoint = std::filesystem::path(p.output) / "checkpoint.snapshot";
  const bool resumes = p.resume && std::filesystem::exists(checkpoint);
  if (resumes) {
    std::string made_by;
    experiment.read_checkpoint(checkpoint, made_by, done, snapshots, record, views.grains(),
                               views.contacts());
    if (made_by != identity(p))
      throw std::invalid_argument("--resume: " + checkpoint.string() +
                                  " was made with other parameters: " + made_by);
  }
  if (!resumes && !p.from.empty())
    start_from(p, experiment, [&] {
      return p.from_method.empty() ? read_checkpoint_of(p, experiment)
                                   : read_compliant_checkpoint<ShapeT>(p, experiment);
    });
  Recorder<ExperimentT> recorder(p, experiment, record);
  RunJson json(p, experiment);
  Progress progress;
  const auto total = static_cast<std::size_t>(std::llround(p.duration / p.step));
  std::printf("%zu grains, %.4g kg, box %.4g m long\n", p.grains, experiment.mass(),
              experiment.length());
  if (resumes) {
    std::printf("going on after %zu of %zu steps\n", done, total);
    json.resumed(done);
  } else if (!prepare(p, experiment, recorder, json, progress, watch)) {
    return 130;
  }
  if (!resumes && p.snapshots > 0) views.snapshot(0);
  const auto packing_steps =
      static_cast<std::size_t>(std::max(1LL, std::llround(packing_interval / p.step)));
  const double active = 1.25 / p.frequency, jammed = 1.75 / p.frequency;
  const auto show = [&](const char* suffix) {
    views.write_chains(suffix);
    if (p.pictures) views.picture(suffix);
  };
  for (; done < total && !interrupted(); ++done) {
    const moreau::StepReport report = experiment.vibrate();
    recorder.record_step(done + 1, report, total);
    if ((done + 1) % packing_steps == 0) recorder.record_packing();
    const double end = p.begin() + double(done + 1) * p.step;
    if (end >= active && end < active + p.step) show("_active");
    if (end >= jammed && end < jammed + p.step) show("_jammed");
    const std::size_t wanted = std::size_t(p.snapshots) * (done + 1) / total;
    if (wanted > snapshots) views.snapshot(int(snapshots = wanted));
    if (p.checkpoint_every > 0 &&
        ((done + 1) % std::size_t(p.checkpoint_every) == 0 || interrupted()))
      experiment.write_checkpoint(checkpoint, identity(p), done + 1, snapshots, recorder.record(),
                                  views.grains(), views.contacts());
    progress.vibrating(done + 1, total, report, experiment.displacement());
  }
  if (p.pictures) views.picture("");
  progress.finish();
  json.stage("vibrate", watch.lap());
  recorder.sync();
  recorder.passive_field().write(p.output);
  recorder.displacement_field().write(p.output);
  write_events(p.output, find_periods(recorder.samples(), p, experiment.mass() * p.gravity));
  json.write(p, experiment, recorder, done < total);
  if (p.plots) plot(p.output);
  conclude(p, experiment, recorder.totals(), json.results());
  return done < total ? 130 : 0;
}

const Runner runner(RATCHETING_TEXT(RATCHETING_SHAPE), RATCHETING_TEXT(RATCHETING_METHOD),
                    run<shapes::RATCHETING_SHAPE, methods::RATCHETING_METHOD>);

}  // namespace

}  // namespace ratcheting
