// SPDX-License-Identifier: MIT
#include "closed_forms.hpp"

namespace validation {

std::vector<Case> closed_forms() {
  return closed_forms_in<double>();
}

}  // namespace validation
