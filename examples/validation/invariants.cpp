// SPDX-License-Identifier: MIT
#include "invariants.hpp"

namespace validation {

std::vector<Case> invariants() {
  auto all = invariants_in<double>();
  all.push_back({"energy", energy_does_not_grow, true});
  all.push_back({"energy_of_fall", energy_falls, true});
  return all;
}

}  // namespace validation
