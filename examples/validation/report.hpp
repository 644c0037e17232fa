// SPDX-License-Identifier: MIT
// The table and the curves of a run as files.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "cases/record.hpp"

namespace validation {

/// What ran, under which name.
struct Result {
  std::string name;
  Record record;
  double seconds;
};

/// Writes table.md, table.csv and one CSV file per curve.
/// @throws std::system_error naming the file if one cannot be written
void write(const std::filesystem::path& folder, std::span<const Result> results);

/// Draws the curves that are there, where gnuplot is.
void plot(const std::filesystem::path& folder);

}  // namespace validation
