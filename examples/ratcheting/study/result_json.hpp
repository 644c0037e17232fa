// SPDX-License-Identifier: MIT
// A result as a line of the table of the runs (run_table.hpp), and back to the same bits.
#pragma once

#include <string>

#include "../parameters_json.hpp"
#include "result.hpp"

namespace study {

/// A JSON object on one line: the name of the case, its parameters, all of the result but the wall
/// clock. nan is null.
std::string json_line(const Result& r);

/// The result of a case from the parsed line.
/// @throws std::runtime_error naming what is missing or of another kind
Result result_of(const ratcheting::Json& json, const Case& c);

}  // namespace study
