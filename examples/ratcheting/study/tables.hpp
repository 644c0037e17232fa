// SPDX-License-Identifier: MIT
// The tables of a study. Wall clock stands in files of its own, so that all others are the same bytes
// whenever the same cases are done. Figures and report are written by report/write.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result.hpp"

namespace study {

/// cases.csv: parameters and results of every run that is done.
void write_cases(const std::filesystem::path& folder, const std::vector<Result>& results);

/// wall_clock.csv and wall_clock.md: seconds of every run and per series. What the results do not
/// know is taken from the wall_clock.csv that is there.
void write_wall_clock(const std::filesystem::path& folder, const std::vector<Result>& results);

/// remaining-NAME.md: runs, steps and estimated core-hours of each series that are not done.
/// @param name of the plan
void write_remaining(const std::filesystem::path& folder, const std::string& name,
                     const std::vector<Case>& plan, const std::vector<Result>& results);

}  // namespace study
