// SPDX-License-Identifier: MIT
#include "structures.hpp"

#include "cases/arch.hpp"

namespace validation {

std::vector<Case> structures() {
  auto all = structures_in<double>();
  all.push_back({"arch", semicircular_arch, true});
  return all;
}

}  // namespace validation
