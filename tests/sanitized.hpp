// SPDX-License-Identifier: MIT
// What a test does a number of times, it does less often under the sanitizers: the code is some ten
// times slower there, and what they look for shows after a few rounds if it shows at all.
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

/// Rounds to make where the full test makes this many.
constexpr int rounds(int full) {
  return (full + sanitizer_share - 1) / sanitizer_share;
}
