// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "parameters.hpp"

namespace ratcheting {

/// A shape that the program was built with: its source file registers how to run the study with it.
class Runner {
 public:
  /// Runs the study with one shape, by the method that is asked for, and writes all files.
  /// @returns exit status: 0, or 130 if interrupted (what was written is complete)
  /// @throws std::runtime_error if a file cannot be written, std::invalid_argument for values that
  /// make
  ///         no experiment
  using Function = int (*)(const Parameters&);

  Runner(const char* shape, Function function) { all()[shape] = function; }
  /// Runs the study with the shape that is asked for.
  /// @throws std::invalid_argument if the program was built without it; std::exception as the run
  static int run(const Parameters& p);

 private:
  static std::map<std::string, Function>& all();
};

/// Set by the signal handler of Ctrl-C; asked after every step.
bool interrupted();
void catch_interrupts();

}  // namespace ratcheting
