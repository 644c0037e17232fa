// SPDX-License-Identifier: MIT
#include "cases/prism.hpp"
#include "cases/statics.hpp"
#include "cases/symmetries.hpp"
#include "suite.hpp"

namespace validation {

std::vector<Case> invariants() {
  return {{"symmetries", symmetries_of_experiments, false}, {"momentum", momentum_is_kept, false},
          {"prisms", prisms_and_polygons, false},           {"balance", balance_of_forces, false},
          {"energy", energy_does_not_grow, true},           {"energy_of_fall", energy_falls, true}};
}

}  // namespace validation
