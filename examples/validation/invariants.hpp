// SPDX-License-Identifier: MIT
#pragma once

#include "cases/prism.hpp"
#include "cases/statics.hpp"
#include "cases/symmetries.hpp"
#include "suite.hpp"

namespace validation {

/// The cases of this group in the scalar T. The energy over 1e5 steps, in double only, is in
/// invariants.cpp.
template <class T>
std::vector<Case> invariants_in() {
  return {{"symmetries", symmetries_of_experiments<T>, false},
          {"momentum", momentum_is_kept<T>, false},
          {"prisms", prisms_and_polygons<T>, false},
          {"balance", balance_of_forces<T>, false}};
}

}  // namespace validation
