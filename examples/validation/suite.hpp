// SPDX-License-Identifier: MIT
// All cases by name.
#pragma once

#include <vector>

#include "cases/record.hpp"

namespace validation {

struct Case {
  const char* name;
  void (*run)(Record&, Effort);
  bool takes_long;  ///< left out by --quick
};

/// Cases whose answer is a closed form.
std::vector<Case> closed_forms();
/// Blocks and balls that stand or fall.
std::vector<Case> structures();
/// What holds for any experiment.
std::vector<Case> invariants();
/// Many grains.
std::vector<Case> packings();

// The same in single precision, where they have an answer there; by the same names.
std::vector<Case> closed_forms_in_float();
std::vector<Case> structures_in_float();
std::vector<Case> invariants_in_float();

}  // namespace validation
