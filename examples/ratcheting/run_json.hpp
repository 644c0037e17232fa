// SPDX-License-Identifier: MIT
// run.json: the parameters, versions and results of a run. SI units; the keys give the unit where
// it is not obvious.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/version.hpp"

#include "experiment.hpp"
#include "parameters.hpp"
#include "parameters_json.hpp"
#include "periods.hpp"
#include "recorder.hpp"

namespace ratcheting {

Json to_json(const Period& period);
/// @param size the smallest grain's, d [m]
Json to_json(const SolverTotals& totals, double size);
Json versions();

/// Means over the periods, the compaction rate and the constant C.
/// @param packing solid fractions over time, for the compaction
Json results(const Parameters& p, double mass, double wall_mass, double length,
             const std::vector<Period>& periods, const std::vector<PackingSample>& packing);

/// Writes events.csv for the plots: when and where the wall jams, starts to move and turns.
void write_events(const std::filesystem::path& folder, const std::vector<Period>& periods);

class RunJson {
 public:
  template <class ExperimentT>
  RunJson(const Parameters& p, const ExperimentT& experiment) {
    json_["parameters"] = to_json(p);
    json_["versions"] = versions();
    json_["sample"] = {{"dimension", ExperimentT::S::dim},
                       {"mass", experiment.mass()},
                       {"weight", experiment.mass() * p.gravity},
                       {"thickness", experiment.thickness()}};
    add_counts(experiment);
  }
  void resumed(std::size_t step) { json_["resumed_at_step"] = step; }
  void stage(const char* name, double seconds) { json_["wall_clock_seconds"][name] = seconds; }

  /// Writes the file of a run that ended in the preparation.
  void write_unprepared(const Parameters& p) {
    json_["interrupted"] = true;
    write(p);
  }
  template <class ExperimentT>
  void write(const Parameters& p, const ExperimentT& experiment,
             const Recorder<ExperimentT>& recorder, bool interrupted) {
    json_["interrupted"] = interrupted;
    json_["sample"]["settled"] = experiment.settled();
    json_["sample"]["wall_mass"] = experiment.wall_mass();
    json_["box"] = {{"length", experiment.length()},
                    {"height", experiment.height()},
                    {"height_over_length", experiment.height() / experiment.length()}};
    const auto periods = find_periods(recorder.samples(), p, experiment.mass() * p.gravity);
    json_["results"] =
        ratcheting::results(p, experiment.mass(), experiment.wall_mass(), experiment.length(),
                            periods, recorder.packing_samples());
    if (const auto& field = recorder.passive_field(); !field.empty()) {
      const auto roll = field.roll();
      json_["passive_field"] = {{"t", field.time()},
                                {"wall_velocity", field.wall_velocity()},
                                {"roll", roll.angular_velocity},
                                {"strength", roll.strength},
                                {"agreement", roll.agreement}};
    }
    if (const auto& field = recorder.displacement_field(); field.periods() > 0) {
      const auto roll = field.roll();
      json_["displacement_field"] = {{"periods", field.periods()},
                                     {"roll_per_period", roll.angular_velocity},
                                     {"strength", roll.strength},
                                     {"agreement", roll.agreement}};
    }
    json_["periods"] = Json::array();
    for (const Period& period : periods) json_["periods"].push_back(to_json(period));
    json_["solver"] = to_json(recorder.totals(), experiment.simulation().grain_size());
    write(p);
  }
  const Json& results() const { return json_.at("results"); }

 private:
  /// Adds the number of grains of each circumradius, and the ranges of vertices and faces.
  template <class ExperimentT>
  void add_counts(const ExperimentT& experiment) {
    std::map<double, std::size_t> sizes;
    std::set<std::size_t> vertices, faces;
    const auto& simulation = experiment.simulation();
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const auto& shape = simulation.shape_of_grain(k);
      // Grains of a size differ by rounding: their radii are measured on the scaled shape.
      ++sizes[std::round(1e9 * double(shape.circumradius())) / 1e9];
      if constexpr (requires { shape.vertices(); })
        vertices.insert(std::size_t(shape.vertices().rows()));
      if constexpr (requires { shape.face_count(); }) faces.insert(shape.face_count());
    }
    Json& sample = json_["sample"];
    sample["circumradii"] = Json::array();
    for (const auto& [radius, count] : sizes)
      sample["circumradii"].push_back({{"radius", radius}, {"grains", count}});
    if (!vertices.empty()) sample["vertices"] = {*vertices.begin(), *vertices.rbegin()};
    if (!faces.empty()) sample["faces"] = {*faces.begin(), *faces.rbegin()};
  }
  void write(const Parameters& p) const {
    moreau::write_atomically(std::filesystem::path(p.output) / "run.json", json_.dump(2) + "\n");
  }

  Json json_;
};

}  // namespace ratcheting
