// SPDX-License-Identifier: MIT
// Where the runs of a study are, and which of them count.
//
// A run's folder has all its files and may be deleted. What tables, figures and report need of it
// is its line in the table of the runs (run_table.hpp), some kilobytes. Without the folder the case
// is done by this line, and the report is the same.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"
#include "result.hpp"
#include "run_table.hpp"

namespace study {

struct Places {
  std::filesystem::path output;   ///< a run's folder is output/cases/NAME
  std::filesystem::path results;  ///< tables, figures and report

  std::filesystem::path table() const { return results / "runs.jsonl"; }
};

/// Where the files of a case are.
std::filesystem::path folder_of(const Places& places, const Case& c);

/// Whether the table has a line of the case with its parameters, or its folder has a complete run
/// with them. A line or a folder that cannot be read does not count; the error output says so, once
/// for each.
/// @param table of these places
bool is_done(const Places& places, const RunTable& table, const Case& c);

/// Measures the run in a case's folder and adds it to the table.
/// @returns what is wrong with the folder; then nothing is added. Empty if nothing is wrong
/// @throws std::system_error if the table cannot be written
std::string keep(const Places& places, const Case& c);

struct Kept {
  std::vector<Result> results;
  std::size_t unread = 0;  ///< lines and folders that do not count
};

/// All that is done, in the order of the plan, from the table. A run that has a folder is measured
/// anew first and has a clock. If its folder is damaged, its line stays as it is.
/// @throws std::system_error as keep()
Kept read_results(const Places& places, const std::vector<Case>& plan);

}  // namespace study
