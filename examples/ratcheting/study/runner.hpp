// SPDX-License-Identifier: MIT
// Runs cases as processes of `ratcheting`, several at once.
//
// A case's folder is complete or absent: the run writes into NAME.partial, which gets its name when
// the run has ended well. So the study can be stopped at any moment, kill -9 included, and goes on
// where it was. The processes die with the study; a lock per case keeps two studies with one
// output folder, such as the tasks of a job array, from running the same case. When a run has
// ended, it is added to the table of the runs (store.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"
#include "store.hpp"

namespace study {

struct RunOptions {
  std::filesystem::path program;  ///< `ratcheting`
  Places places;
  std::size_t jobs = 1;  ///< processes at once
};

/// What became of the cases that were asked for.
struct RunSummary {
  std::size_t ran = 0, skipped = 0, busy = 0;  ///< busy: another study runs it
  std::vector<std::string> failed;             ///< name: what happened
  bool interrupted = false;
  std::string lost;  ///< names of the cases that an interrupt cost
};

/// Runs what is not done, in order, and tells progress on standard output.
/// @throws std::runtime_error if a folder cannot be made, a process cannot be started, or as
///         is_done() and keep()
RunSummary run_cases(const std::vector<Case>& cases, const RunOptions& options);

}  // namespace study
