// SPDX-License-Identifier: MIT
#include "structures.hpp"

namespace validation {

std::vector<Case> structures_in_float() {
  return structures_in<float>();
}

}  // namespace validation
