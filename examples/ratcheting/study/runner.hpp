// SPDX-License-Identifier: MIT
// Runs cases as processes of `ratcheting`, several at once.
//
// The folder of a case is complete or absent: the run writes into NAME.partial, which is renamed
// when the run has ended without an error; the run is then added to the table of the runs
// (store.hpp). So the study can be stopped at any time, also by kill -9, and continued later. The
// processes end with the study. A case that starts from a checkpoint waits for the case that makes it. Each case has a lock, so that two studies with one output folder,
// such as the tasks of a job array, do not run the same case.
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

/// The outcome of run_cases().
struct RunSummary {
  std::size_t ran = 0, skipped = 0, busy = 0;  ///< busy: another study runs it
  std::vector<std::string> failed;             ///< name: what happened
  bool interrupted = false;
  std::string lost;  ///< names of the cases that were running when the study was interrupted
};

/// Runs the cases that are not done, in order, and prints the progress to standard output.
/// @throws std::runtime_error if a folder cannot be made, a process cannot be started, or as
///         is_done() and keep()
RunSummary run_cases(const std::vector<Case>& cases, const RunOptions& options);

}  // namespace study
