// SPDX-License-Identifier: MIT
// A result as JSON, and back to the same bits.
#pragma once

#include <string>

#include "../parameters_json.hpp"
#include "result.hpp"

namespace study {

/// All of a result, a line per name, with the parameters that decide it. nan is null.
std::string json_text(const Result& r);

/// @returns the result of case c
/// @throws std::runtime_error naming what is missing or of another kind
Result result_of(const ratcheting::Json& json, const Case& c);

}  // namespace study
