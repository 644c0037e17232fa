// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "moreau/io/output_file.hpp"
#include "moreau/version.hpp"

#include "answers.hpp"
#include "misses.hpp"

namespace validation {

namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", std::gmtime(&now));
  return text.data();
}

/// Compiler, flags and commit of this program.
std::string build() {
#if defined(__clang__)
  std::string text = "clang " __clang_version__;
#else
  std::string text = "g++ " __VERSION__;
#endif
  text += " " VALIDATION_FLAGS;
  if (*VALIDATION_COMMIT != '\0') text += ", commit " VALIDATION_COMMIT;
  return text;
}

std::string verdict(const Row& row) {
  if (row.pass()) return "yes";
  const char* reason = known_miss(row);
  return reason ? std::string("**no**: ") + reason : "**no**";
}

std::string markdown(std::span<const Result> results) {
  std::size_t rows = 0, passed = 0;
  std::string table;
  for (const Result& result : results) {
    const Answer& answer = answer_of(result.name);
    table += "\n## `" + result.name + "`\n\n" + answer.formula + ". Source: " + answer.source +
             ".\n\n| comparison | | expected | measured | error | tolerance | pass "
             "|\n|---|---|---|---|---|---|---|\n";
    for (const Row& row : result.record.rows()) {
      ++rows;
      passed += row.pass();
      table += "| " + row.name + " | " + row.space + " | " + number(row.expected) + " | " +
               number(row.measured) + " | " + number(row.error) + " | " + number(row.tolerance) +
               " | " + verdict(row) + " |\n";
    }
  }
  return "# Validation\n\nmoreau " MOREAU_VERSION_STRING ", " + today() + ", " + build() + ". " +
         std::to_string(passed) + " of " + std::to_string(rows) + " comparisons pass.\n" + table;
}

std::string csv(std::span<const Result> results) {
  std::string table = "case,comparison,space,expected,measured,error,tolerance,pass\n";
  for (const Result& result : results)
    for (const Row& row : result.record.rows())
      table += result.name + ",\"" + row.name + "\"," + row.space + ',' + number(row.expected) +
               ',' + number(row.measured) + ',' + number(row.error) + ',' + number(row.tolerance) +
               ',' + (row.pass() ? '1' : '0') + '\n';
  return table;
}

std::string csv(const Curve& curve) {
  std::string text;
  const auto line = [&](const auto& entries, auto&& format) {
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (k > 0) text.push_back(',');
      text += format(entries[k]);
    }
    text.push_back('\n');
  };
  line(curve.columns, [](const std::string& name) { return name; });
  for (const auto& row : curve.rows) line(row, number);
  return text;
}

void save(const std::filesystem::path& path, const std::string& text) {
  moreau::OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace

void write(const std::filesystem::path& folder, std::span<const Result> results) {
  save(folder / "table.md", markdown(results));
  save(folder / "table.csv", csv(results));
  for (const Result& result : results)
    for (const Curve& curve : result.record.curves())
      save(folder / (curve.name + ".csv"), csv(curve));
}

void plot(const std::filesystem::path& folder) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const std::string place = std::filesystem::absolute(folder).string();
  if (place.find_first_of("'\"\\") != std::string::npos) return;  // not safe on a command line
  const std::string command =
      "gnuplot -e \"folder='" + place + "'\" '" VALIDATION_PLOTS "/all.gp' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0)
    std::fprintf(stderr, "gnuplot: some plots could not be drawn\n");
}

}  // namespace validation
