// SPDX-License-Identifier: MIT
#pragma once

#include "cases/painleve.hpp"
#include "cases/pyramid.hpp"
#include "cases/stacks.hpp"
#include "suite.hpp"

namespace validation {

/// The cases of this group in the scalar T. The arch, in double only, is in structures.cpp.
template <class T>
std::vector<Case> structures_in() {
  return {{"column", column_of_bodies<T>, false},
          {"stack", stack_of_boxes<T>, false},
          {"pyramid", pyramid_of_balls<T>, false},
          {"painleve", painleve_rod<T>, false}};
}

}  // namespace validation
