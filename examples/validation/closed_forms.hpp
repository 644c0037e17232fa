// SPDX-License-Identifier: MIT
#pragma once

#include "cases/bouncing.hpp"
#include "cases/boxes.hpp"
#include "cases/flight.hpp"
#include "cases/incline.hpp"
#include "cases/laws.hpp"
#include "cases/rolling.hpp"
#include "cases/rolling_off.hpp"
#include "suite.hpp"

namespace validation {

/// The cases of this group in the scalar T.
template <class T>
std::vector<Case> closed_forms_in() {
  return {{"free_fall", free_fall<T>, false},
          {"bouncing_ball", bouncing_ball<T>, false},
          {"incline", incline<T>, false},
          {"slip_to_roll", slip_to_roll<T>, false},
          {"oblique_impact", oblique_impacts<T>, false},
          {"toppling_block", toppling_block<T>, false},
          {"rocking_block", rocking_block<T>, false},
          {"asymmetric_top", asymmetric_top<T>, false},
          {"off_a_ball", off_a_ball<T>, false},
          {"laws", other_laws<T>, false}};
}

}  // namespace validation
