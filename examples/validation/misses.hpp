// SPDX-License-Identifier: MIT
// Comparisons that are known not to pass.
#pragma once

#include "cases/record.hpp"

namespace validation {

/// Why a comparison does not pass, where it is known not to: mostly that float has seven digits.
/// Null for all others.
const char* known_miss(const Row& row);

}  // namespace validation
