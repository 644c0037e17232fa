// SPDX-License-Identifier: MIT
// Runs cases as processes of `ratcheting`, several at once.
//
// A case's folder is complete or absent: the run writes into NAME.partial, which gets its name when
// the run has ended well. So the study can be stopped at any moment, kill -9 included, and goes on
// where it was. The processes die with the study; a lock per case keeps two studies with one
// output folder, such as the tasks of a job array, from running the same case.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"

namespace study {

struct RunOptions {
  std::filesystem::path program;  ///< `ratcheting`
  std::filesystem::path output;   ///< cases go to output/cases/NAME
  std::size_t jobs = 1;           ///< processes at once
};

/// What became of the cases that were asked for.
struct RunSummary {
  std::size_t ran = 0, skipped = 0, busy = 0;  ///< busy: another study runs it
  std::vector<std::string> failed;             ///< name: what happened
  bool interrupted = false;
};

/// Where the files of a case are.
std::filesystem::path folder_of(const std::filesystem::path& output, const Case& c);

/// Whether a complete run with the case's parameters is there.
bool is_done(const std::filesystem::path& output, const Case& c);

/// Runs what is not done, in order, and tells progress on standard output.
/// @throws std::runtime_error if a folder cannot be made or a process cannot be started
RunSummary run_cases(const std::vector<Case>& cases, const RunOptions& options);

}  // namespace study
