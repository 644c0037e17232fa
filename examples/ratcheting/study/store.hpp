// SPDX-License-Identifier: MIT
// Where the runs of a study are, and what is kept of them.
//
// A run's folder has all its files and may be lost. What the tables need of it is kept in a file of
// a few kilobytes, runs/NAME.json below the folder of the results; without the folder the case is
// done by this file, and the report is the same.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"
#include "result.hpp"

namespace study {

struct Places {
  std::filesystem::path output;   ///< a run's folder is output/cases/NAME
  std::filesystem::path results;  ///< what is kept of it: results/runs/NAME.json
};

/// Where the files of a case are.
std::filesystem::path folder_of(const Places& places, const Case& c);

/// Whether there is a file with the case's parameters, or the folder of a complete run with them.
/// What is no such file or has damaged ones does not count, and that is told once on the error
/// output.
bool is_done(const Places& places, const Case& c);

/// Measures the run in a case's folder and keeps the result.
/// @returns what is wrong with the folder; nothing then is kept. Empty if nothing is
/// @throws std::system_error if the result cannot be written
std::string keep(const Places& places, const Case& c);

struct Kept {
  std::vector<Result> results;
  std::size_t unread = 0;  ///< files and folders that do not count
};

/// All that is done, in the order of the plan, from the files; what has a folder is measured anew
/// and has a clock. What was kept of a run whose folder is damaged stays as it is.
/// @throws std::system_error as keep()
Kept read_results(const Places& places, const std::vector<Case>& plan);

}  // namespace study
