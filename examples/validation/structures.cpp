// SPDX-License-Identifier: MIT
#include "cases/arch.hpp"
#include "cases/painleve.hpp"
#include "cases/pyramid.hpp"
#include "cases/stacks.hpp"
#include "suite.hpp"

namespace validation {

std::vector<Case> structures() {
  return {{"column", column_of_bodies, false},
          {"stack", stack_of_boxes, false},
          {"pyramid", pyramid_of_balls, false},
          {"painleve", painleve_rod, false},
          {"arch", semicircular_arch, true}};
}

}  // namespace validation
