// SPDX-License-Identifier: MIT
// All cases by name.
#pragma once

#include <vector>

#include "cases/record.hpp"

namespace validation {

struct Case {
  const char* name;
  void (*run)(Record&, Effort);
  bool takes_long;  ///< skipped with --quick
};

/// Cases with an answer in closed form.
std::vector<Case> closed_forms();
/// Structures of blocks and balls that stand or fall.
std::vector<Case> structures();
/// Properties of every experiment: symmetries and conservation.
std::vector<Case> invariants();
/// Packings and flows of many grains.
std::vector<Case> packings();

// The cases that run in single precision, with the same names.
std::vector<Case> closed_forms_in_float();
std::vector<Case> structures_in_float();
std::vector<Case> invariants_in_float();

}  // namespace validation
