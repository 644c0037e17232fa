// SPDX-License-Identifier: MIT
// What is known of each case: the formula that it is held to, and where it stands.
#pragma once

#include <string>

namespace validation {

struct Answer {
  const char* formula;
  const char* source;
};

/// @throws std::logic_error for a case that has none
const Answer& answer_of(const std::string& name);

}  // namespace validation
