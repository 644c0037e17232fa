// SPDX-License-Identifier: MIT
// Solves a frictional contact problem from a file: FCLIB's HDF5 or Siconos' text.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>

#include "moreau/instances/friction_problems.hpp"
#include "moreau/io/fclib.hpp"
#include "moreau/io/output_file.hpp"
#include "moreau/io/siconos_text.hpp"
#include "moreau/version.hpp"

namespace {

struct CommandLine {
  std::string file, output;
  moreau::ProximalOptions solver;
};

/// One contact per line, normal first, in the units of the file, to the last digit.
std::string format_impulses(const Eigen::VectorXd& impulses, Eigen::Index per_contact) {
  std::string text;
  char number[40];
  for (Eigen::Index k = 0; k < impulses.size(); ++k) {
    std::snprintf(number, sizeof number, "%.17g", impulses[k]);
    text += number;
    text += (k + 1) % per_contact == 0 ? '\n' : ' ';
  }
  return text;
}

/// Before the time is spent on solving.
/// @throws std::invalid_argument for an output that is the problem itself or has no folder
void require_output(const CommandLine& line) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (line.output.empty()) return;
  if (fs::equivalent(line.output, line.file, none))
    throw std::invalid_argument("--output: '" + line.output + "' is the problem itself");
  const fs::path folder = fs::absolute(line.output).parent_path();
  if (!fs::is_directory(folder))
    throw std::invalid_argument("--output: there is no folder '" + folder.string() + "'");
}

/// @returns 0, or 1 if the tolerance was not reached
template <class S>
int solve(const moreau::FrictionProblem<S>& problem, const CommandLine& line) {
  Eigen::VectorXd impulses;
  const auto start = std::chrono::steady_clock::now();
  const moreau::ProblemReport report = moreau::ProximalSolver(line.solver).solve(problem, impulses);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("contacts        %ld\n", static_cast<long>(problem.size()));
  std::printf("sweeps          %d\n", report.sweeps);
  std::printf("proximal steps  %d\n", report.proximal_steps);
  std::printf("residual        %.3e\n", report.residual);
  std::printf("seconds         %.3f\n", seconds.count());
  if (!line.output.empty())
    moreau::write_atomically(line.output, format_impulses(impulses, S::dim));
  if (report.converged) return 0;
  if (report.residual <= line.solver.tolerance)
    std::fprintf(stderr, "%s: the impulses grow without bound\n", line.file.c_str());
  else
    std::fprintf(stderr, "%s: not solved to %g\n", line.file.c_str(), line.solver.tolerance);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  line.solver.max_seconds = 50;
  CLI::App app{
      "Solves a frictional contact problem, in FCLIB's HDF5 or Siconos' text form, and says how "
      "well."};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.option_defaults()->always_capture_default();
  app.add_option("file", line.file, "the problem")->required();
  app.add_option("--tolerance", line.solver.tolerance,
                 "on the residual of the natural map, scaled to a mean diagonal of 1");
  app.add_option("--output", line.output, "impulses as text, one contact per line, normal first");
  app.add_option("--time-limit", line.solver.max_seconds,
                 "the best result so far is given after this time [s]");
  app.footer(
      "Exit status: 0 solved, 1 not solved to the tolerance, 2 bad input, or impulses that cannot "
      "be "
      "written.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    require_output(line);
    const moreau::AnyFrictionProblem problem = moreau::is_hdf5(line.file)
                                                   ? moreau::read_fclib(line.file)
                                                   : moreau::read_siconos_text(line.file);
    return std::visit([&](const auto& p) { return solve(p, line); }, problem);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fclib_solve: %s\n", error.what());
    return 2;
  }
}
