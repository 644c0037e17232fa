// SPDX-License-Identifier: MIT
#include "conformance/broad_phase.hpp"

#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"

#include "types.hpp"

using moreau::CellGrid;
using moreau::Space;
using moreau::SweepAndPrune;

TEST_CASE_TEMPLATE("broad phases find what all pairs finds", S,
                   MOREAU_TYPES((Space<2, double>, Space<3, double>),
                                (Space<2, float>, Space<3, float>))) {
  conformance::broad_phase<S>(SweepAndPrune<S>());
  conformance::broad_phase<S>(CellGrid<S>());
}
