// SPDX-License-Identifier: MIT
#include "invariants.hpp"

namespace validation {

std::vector<Case> invariants_in_float() {
  return invariants_in<float>();
}

}  // namespace validation
