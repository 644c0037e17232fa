// SPDX-License-Identifier: MIT
// Runs the validation cases and writes a table of expected and measured values.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "moreau/version.hpp"

#include "misses.hpp"
#include "report.hpp"
#include "suite.hpp"

namespace validation {

namespace {

struct Options {
  std::vector<std::string> only;
  std::string output = "validation-output";
  bool quick = false;
};

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& group : {closed_forms(), structures(), invariants(), packings(),
                            closed_forms_in_float(), structures_in_float(), invariants_in_float()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

bool is_wanted(const Case& one, const Options& options) {
  if (options.only.empty()) return !(options.quick && one.takes_long);
  return std::find(options.only.begin(), options.only.end(), one.name) != options.only.end();
}

Result run(const Case& one, Effort effort) {
  Result result{one.name, {}, 0};
  const auto start = std::chrono::steady_clock::now();
  one.run(result.record, effort);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void print(const Result& result) {
  std::size_t passed = 0;
  for (const Row& row : result.record.rows()) passed += row.pass();
  std::printf("%-16s %zu of %zu, %.1f s\n", result.name.c_str(), passed,
              result.record.rows().size(), result.seconds);
  for (const Row& row : result.record.rows())
    if (!row.pass())
      std::printf("  %s %s (%s): expected %g, measured %g, error %g, tolerance %g\n",
                  known_miss(row) ? "known miss:" : "FAILED:", row.name.c_str(), row.space.c_str(),
                  row.expected, row.measured, row.error, row.tolerance);
  std::fflush(stdout);
}

void print_totals(const std::vector<Result>& results) {
  std::size_t all = 0, passed = 0, known = 0;
  double seconds = 0;
  for (const Result& result : results) {
    seconds += result.seconds;
    for (const Row& row : result.record.rows()) {
      ++all;
      passed += row.pass();
      known += !row.pass() && known_miss(row);
    }
  }
  std::printf("%zu comparisons in %.0f s: %zu pass, %zu are known misses (misses.cpp), %zu fail\n",
              all, seconds, passed, known, all - passed - known);
}

/// @returns 0 if every comparison passes or is a known miss, else 1
int run(const Options& options) {
  std::filesystem::create_directories(options.output);
  std::vector<Result> results;
  bool passed = true;
  for (const Case& one : all_cases()) {
    if (!is_wanted(one, options)) continue;
    results.push_back(run(one, options.quick ? Effort::quick : Effort::full));
    print(results.back());
    for (const Row& row : results.back().record.rows())
      passed = passed && (row.pass() || known_miss(row));
    write(options.output, results);
  }
  plot(options.output);
  print_totals(results);
  std::printf("table.md, table.csv and the curves are in %s\n", options.output.c_str());
  return passed ? 0 : 1;
}

}  // namespace

}  // namespace validation

int main(int argc, char** argv) {
  validation::Options options;
  std::vector<std::string> names;
  for (const validation::Case& one : validation::all_cases()) names.emplace_back(one.name);
  CLI::App app{
      "Compares the library with known answers and writes a table of expected and measured "
      "values."};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.add_option("--only", options.only, "run only the cases with these names")
      ->check(CLI::IsMember(names));
  app.add_option(
         "--output", options.output,
         "folder for the results; created if it does not exist, files in it are overwritten")
      ->capture_default_str();
  app.add_flag("--quick", options.quick,
               "run smaller samples, without the cases that take minutes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return validation::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
