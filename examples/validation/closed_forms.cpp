// SPDX-License-Identifier: MIT
#include "closed_forms.hpp"

#include "cases/two_grains.hpp"

namespace validation {

std::vector<Case> closed_forms() {
  auto all = closed_forms_in<double>();
  all.push_back({"two_grains", two_grains, false});
  return all;
}

}  // namespace validation
