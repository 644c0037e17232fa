// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <utility>

#include "parameters.hpp"

namespace ratcheting {

/// The shapes and methods that the program was built with: run_shape.cpp registers a Runner for each of
/// them.
class Runner {
 public:
  /// Runs an experiment with one shape by one method and writes all files.
  /// @returns exit status: 0, or 130 if it was interrupted (the files are complete)
  /// @throws std::runtime_error if a file cannot be written, std::invalid_argument if an experiment
  ///         with these values is not possible
  using Function = int (*)(const Parameters&);

  Runner(const char* shape, const char* method, Function function) {
    all()[{shape, method}] = function;
  }
  /// Runs an experiment with the shape in p.shape by the method in p.method.
  /// @throws std::invalid_argument if the program was built without it; std::exception as the run
  static int run(const Parameters& p);

 private:
  using Name = std::pair<std::string, std::string>;  // shape, method
  static std::map<Name, Function>& all();
};

/// Whether Ctrl-C or SIGTERM has been received since catch_interrupts().
bool interrupted();
void catch_interrupts();

}  // namespace ratcheting
