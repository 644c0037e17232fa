// SPDX-License-Identifier: MIT
// Under the sanitizers, repeated parts of a test are repeated less often. The code is about ten
// times slower with sanitizers, and most errors that they detect occur in the first rounds.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define MOREAU_TEST_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MOREAU_TEST_SANITIZED 1
#endif
#endif

#ifdef MOREAU_TEST_SANITIZED
constexpr int sanitizer_share = 4;
#else
constexpr int sanitizer_share = 1;
#endif

/// The number of rounds to make if the full test makes `full` rounds.
constexpr int rounds(int full) {
  return (full + sanitizer_share - 1) / sanitizer_share;
}
