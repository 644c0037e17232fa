// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "moreau/world/step_report.hpp"

namespace ratcheting {

/// Wall-clock time since the last lap.
class Stopwatch {
 public:
  double lap() {  ///< [s]
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Prints the progress: on a terminal one line that is overwritten, else a line every few seconds.
class Progress {
 public:
  Progress();
  void preparing(const char* stage, const moreau::StepReport& report, double time);
  void vibrating(std::size_t step, std::size_t total, const moreau::StepReport& report, double x);
  /// Ends the line.
  void finish();

 private:
  bool due();

  using Clock = std::chrono::steady_clock;
  bool terminal_, open_ = false;
  Clock::time_point start_, last_;
  bool vibrating_ = false;
};

/// Draws the plots of a run's folder with gnuplot. Prints a message if gnuplot is not installed.
void plot(const std::string& folder);

}  // namespace ratcheting
