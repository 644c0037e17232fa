// SPDX-License-Identifier: MIT
// The tables and the report of a study. Wall clock stands in files of its own, so that all others
// are the same bytes whenever the same cases are done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan.hpp"
#include "result.hpp"
#include "summary.hpp"

namespace study {

/// cases.csv: parameters and results of every run that is done.
void write_cases(const std::filesystem::path& folder, const std::vector<Result>& results);

/// wall_clock.csv and wall_clock.md: seconds of every run and per series. What the results do not
/// know is taken from the wall_clock.csv that is there.
void write_wall_clock(const std::filesystem::path& folder, const std::vector<Result>& results);

/// report.md, with the figures of draw_figures.
/// @param plan_name of all cases, done or not
void write_report(const std::filesystem::path& folder, const std::string& plan_name,
                  const std::vector<Case>& plan, const std::vector<Result>& results,
                  const std::vector<ShapeSummary>& shapes);

}  // namespace study
