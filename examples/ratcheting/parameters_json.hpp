// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "parameters.hpp"

namespace ratcheting {

using Json = nlohmann::ordered_json;

/// What decides a run's results, as it stands under "parameters" in run.json; SI units. Snapshots,
/// pictures, plots and the folder are left out.
Json to_json(const Parameters& p);

}  // namespace ratcheting
