// SPDX-License-Identifier: MIT
// Tables for the figures, and the figures from them by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result.hpp"
#include "summary.hpp"

namespace study {

/// A figure of the paper, or beyond it.
struct Figure {
  const char* name;               ///< of plots/NAME.gp, and of NAME.png and NAME.svg
  const char* caption;            ///< a line for the report
  std::vector<std::string> sets;  ///< whose cases it shows
};
const std::vector<Figure>& figures();

/// Writes data/*.csv below the folder of the results: what every figure draws.
void write_figure_data(const std::filesystem::path& folder, const std::vector<Result>& results,
                       const std::vector<ShapeSummary>& shapes);

/// Draws figures/NAME.png and .svg below the folder: those of whose series there are runs.
/// @param scripts folder of NAME.gp
/// @param names   nothing: all
/// @returns those that gnuplot could not draw, with what it said; all, if there is no gnuplot
/// @throws std::invalid_argument if there are no scripts
std::vector<std::string> draw_figures(const std::filesystem::path& folder,
                                      const std::filesystem::path& scripts,
                                      const std::vector<Result>& results,
                                      const std::vector<std::string>& names);

}  // namespace study
