// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>

#include "parameters.hpp"

namespace ratcheting {

/// Reads the command line.
/// @returns the parameters, or nothing if the program must end with exit_status: 0 after --help, 2
///          after a bad value, which the standard error output names
std::optional<Parameters> parse(int argc, char** argv, int& exit_status);

/// Exit status of a program: what run() returns; 2 if a value that the user gave is wrong, 1 after
/// another error. The message of the exception goes to the standard error output.
int exit_status(const auto& run) {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return dynamic_cast<const std::invalid_argument*>(&error) != nullptr ? 2 : 1;
  }
}

}  // namespace ratcheting
