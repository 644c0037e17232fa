// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "parameters.hpp"

namespace ratcheting {

/// Reads the command line.
/// @returns the parameters, or nothing where the program has to end with exit_status: 0 after
/// --help,
///          2 after a bad value, which is named on standard error
std::optional<Parameters> parse(int argc, char** argv, int& exit_status);

}  // namespace ratcheting
