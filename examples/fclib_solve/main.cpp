// SPDX-License-Identifier: MIT
// Solves a frictional contact problem from a file in FCLIB's HDF5 form or in the text form of
// Siconos.
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

/// One line per contact, the normal component first, in the units of the file, with all digits.
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

/// Checks the output path before the problem is solved.
/// @throws std::invalid_argument if the output is the input file or its folder does not exist
void require_output(const CommandLine& line) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (line.output.empty()) return;
  if (fs::equivalent(line.output, line.file, none))
    throw std::invalid_argument("--output: '" + line.output + "' is the input file");
  const fs::path folder = fs::absolute(line.output).parent_path();
  if (!fs::is_directory(folder))
    throw std::invalid_argument("--output: folder '" + folder.string() + "' does not exist");
}

/// @returns 0 if the solution converged, else 1
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
    std::fprintf(stderr, "%s: did not converge to the tolerance %g\n", line.file.c_str(),
                 line.solver.tolerance);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  line.solver.max_seconds = 50;
  CLI::App app{
      "Solves a frictional contact problem from a file (FCLIB's HDF5 or the text form of Siconos) "
      "and prints the residual of the solution."};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.option_defaults()->always_capture_default();
  app.add_option("file", line.file, "file with the problem")->required();
  app.add_option("--tolerance", line.solver.tolerance,
                 "for the natural-map residual, after scaling W to a mean diagonal of 1");
  app.add_option("--output", line.output,
                 "text file for the impulses: one line per contact, normal component first");
  app.add_option("--time-limit", line.solver.max_seconds,
                 "stop after this time and return the best result so far [s]");
  app.footer(
      "Exit status: 0 converged; 1 not converged; 2 the input is not valid or the output cannot be "
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
