// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace ratcheting {

Progress::Progress() : terminal_(isatty(STDOUT_FILENO) != 0), start_(Clock::now()), last_(start_) {}

bool Progress::due() {
  const auto now = Clock::now();
  const std::chrono::duration<double> since = now - last_;
  if (since.count() < (terminal_ ? 0.2 : 5.0)) return false;
  last_ = now;
  return true;
}

void Progress::preparing(const char* stage, const moreau::StepReport& report, double time) {
  if (!due()) return;
  std::printf("%sprepare: %-11s t = %6.3f s  %6zu points  %5d sweeps  %6.1f ms/step%s",
              terminal_ ? "\r" : "", stage, time, report.points, report.solve.sweeps,
              report.ms_total, terminal_ ? "\033[K" : "\n");
  open_ = terminal_;
  std::fflush(stdout);
}

void Progress::vibrating(std::size_t step, std::size_t total, const moreau::StepReport& report,
                         double x) {
  if (!vibrating_) {
    finish();
    vibrating_ = true;
    start_ = Clock::now();
  }
  if (!due() && step != total) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left = elapsed / double(step) * double(total - step);
  std::printf(
      "%svibrate: step %zu of %zu (%3.0f %%)  x = %+8.3f mm  %5zu points  %4d sweeps  residual "
      "%.0e  %5.1f ms/step  %.0f s left%s",
      terminal_ ? "\r" : "", step, total, 100.0 * double(step) / double(total), 1e3 * x,
      report.points, report.solve.sweeps, report.solve.residual, report.ms_total, left,
      terminal_ ? "\033[K" : "\n");
  open_ = terminal_;
  std::fflush(stdout);
}

void Progress::finish() {
  if (open_) std::printf("\n");
  open_ = false;
}

void plot(const std::string& folder) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    std::printf("gnuplot is not installed: no plots; the data are in %s\n", folder.c_str());
    return;
  }
  for (const char* name :
       {"x_t", "one_period", "f_g_x", "rho_t", "rho_x", "phase_portrait", "solver"}) {
    const std::string command = "gnuplot -e \"folder='" + folder + "'; name='" + name + "'\" '" +
                                RATCHETING_PLOTS + "/run.gp' 2>&1";
    if (std::system(command.c_str()) != 0) std::printf("plot %s failed\n", name);
  }
}

}  // namespace ratcheting
