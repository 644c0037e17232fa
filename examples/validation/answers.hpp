// SPDX-License-Identifier: MIT
// The known answer of each case: its formula and its source.
#pragma once

#include <string>

namespace validation {

struct Answer {
  const char* formula;
  const char* source;
};

/// @throws std::logic_error if a case has no formula
const Answer& answer_of(const std::string& name);

}  // namespace validation
