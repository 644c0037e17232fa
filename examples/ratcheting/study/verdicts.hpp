// SPDX-License-Identifier: MIT
// The paper's statements against what was measured: one row each, one cell per shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result.hpp"
#include "summary.hpp"
#include "wording.hpp"

namespace study {

struct Cell {
  std::string value;          ///< empty: not measured yet
  std::optional<bool> holds;  ///< nothing: reported, not judged
};

struct Row {
  std::string quantity, paper, accepted;
  std::vector<Cell> cells;  ///< in the order of the shapes
  bool is_setting = false;  ///< of how the case is set up, not of what comes out
};

/// @param shapes any; the ranges for polygons and disks are the paper's for 2D where it has some
std::vector<Row> judge(const std::vector<Result>& results, const std::vector<ShapeSummary>& shapes);

}  // namespace study
