// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "parameters.hpp"

namespace ratcheting {

using Json = nlohmann::ordered_json;

/// The parameters that determine the results of a run, as under "parameters" in run.json; SI units.
/// Snapshots, pictures, plots and the folder are left out.
Json to_json(const Parameters& p);

}  // namespace ratcheting
