// SPDX-License-Identifier: MIT
// Writes the results of a run: the table and the curves.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "cases/record.hpp"

namespace validation {

/// A case that was run, with its name.
struct Result {
  std::string name;
  Record record;
  double seconds;
};

/// Writes table.md, table.csv and one CSV file per curve.
/// @throws std::system_error naming the file if one cannot be written
void write(const std::filesystem::path& folder, std::span<const Result> results);

/// Draws the curves of the run, if gnuplot is installed.
void plot(const std::filesystem::path& folder);

}  // namespace validation
