// SPDX-License-Identifier: MIT
#include "cases/bouncing.hpp"
#include "cases/boxes.hpp"
#include "cases/flight.hpp"
#include "cases/incline.hpp"
#include "cases/laws.hpp"
#include "cases/rolling.hpp"
#include "cases/rolling_off.hpp"
#include "suite.hpp"

namespace validation {

std::vector<Case> closed_forms() {
  return {{"free_fall", free_fall, false},
          {"bouncing_ball", bouncing_ball, false},
          {"incline", incline, false},
          {"slip_to_roll", slip_to_roll, false},
          {"oblique_impact", oblique_impact, false},
          {"toppling_block", toppling_block, false},
          {"rocking_block", rocking_block, false},
          {"asymmetric_top", asymmetric_top, false},
          {"off_a_ball", off_a_ball, false},
          {"laws", other_laws, false}};
}

}  // namespace validation
