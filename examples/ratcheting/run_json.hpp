// SPDX-License-Identifier: MIT
// run.json: everything that went into a run and what came out. SI units, named in the keys where
// they are not obvious.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/version.hpp"

#include "experiment.hpp"
#include "parameters.hpp"
#include "periods.hpp"
#include "recorder.hpp"

namespace ratcheting {

using Json = nlohmann::ordered_json;

Json to_json(const Parameters& p);
Json to_json(const Period& period);
/// @param size the smallest grain's, d [m]
Json to_json(const SolverTotals& totals, double size);
Json versions();

/// Means over periods, with what row 13 and 17 of the study ask for.
/// @param packing the state over time, for the compaction
Json results(const Parameters& p, double mass, double wall_mass, double length,
             const std::vector<Period>& periods, const std::vector<PackingSample>& packing);

/// events.csv: when and where the wall jams, unjams and turns, for the plots.
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
  }
  void resumed(std::size_t step) { json_["resumed_at_step"] = step; }
  void stage(const char* name, double seconds) { json_["wall_clock_seconds"][name] = seconds; }

  /// Of a run that ended within the preparation.
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
    const auto periods = find_periods(recorder.samples(), p);
    json_["results"] =
        ratcheting::results(p, experiment.mass(), experiment.wall_mass(), experiment.length(),
                            periods, recorder.packing_samples());
    json_["periods"] = Json::array();
    for (const Period& period : periods) json_["periods"].push_back(to_json(period));
    json_["solver"] = to_json(recorder.totals(), experiment.simulation().grain_size());
    write(p);
  }
  const Json& results() const { return json_.at("results"); }

 private:
  void write(const Parameters& p) const {
    moreau::write_atomically(std::filesystem::path(p.output) / "run.json", json_.dump(2) + "\n");
  }

  Json json_;
};

}  // namespace ratcheting
