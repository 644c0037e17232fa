// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <string>
#include <vector>

#include "answers.hpp"
#include "misses.hpp"
#include "suite.hpp"

namespace validation {

/// Runs a case and checks every comparison that is not listed as a known deviation.
inline void check(const Case& one, Effort effort) {
  CHECK_NOTHROW(answer_of(one.name));
  Record record;
  one.run(record, effort);
  CHECK_FALSE(record.rows().empty());
  for (const Row& row : record.rows()) {
    INFO(one.name << ": " << row.name << " (" << row.space << ")");
    INFO("expected " << row.expected << ", measured " << row.measured << ", error " << row.error
                     << ", tolerance " << row.tolerance);
    CHECK((row.pass() || known_miss(row)));
  }
}

/// Runs the cases of a group, except the cases that take minutes.
inline void check_quick(const std::vector<Case>& group) {
  for (const Case& one : group)
    if (!one.takes_long) check(one, Effort::quick);
}

/// Runs one case of a group with its full size.
inline void check_full(const std::vector<Case>& group, const std::string& name) {
  int found = 0;
  for (const Case& one : group) {
    if (one.name != name) continue;
    check(one, Effort::full);
    ++found;
  }
  CHECK(found == 1);
}

}  // namespace validation
