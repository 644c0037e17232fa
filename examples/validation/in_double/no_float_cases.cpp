// SPDX-License-Identifier: MIT
// The program `validation` has no cases in single precision, which take as long to compile as all others. The program
// `validation_with_float` has them (in_float/).
#include "suite.hpp"

namespace validation {

std::vector<Case> closed_forms_in_float() {
  return {};
}
std::vector<Case> structures_in_float() {
  return {};
}
std::vector<Case> invariants_in_float() {
  return {};
}

}  // namespace validation
