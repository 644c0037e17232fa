// SPDX-License-Identifier: MIT
// Comparisons that are known to fail.
#pragma once

#include "cases/record.hpp"

namespace validation {

/// Reason why a comparison is known to fail; null for a comparison that should pass. In most cases
/// the reason is that single precision has seven digits.
const char* known_miss(const Row& row);

}  // namespace validation
