// SPDX-License-Identifier: MIT
#include "closed_forms.hpp"

namespace validation {

std::vector<Case> closed_forms_in_float() {
  return closed_forms_in<float>();
}

}  // namespace validation
