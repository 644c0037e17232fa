// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace moreau::detail {

/// Alignment of a List whose elements are as long as a cache line, or a register: each of them lies on one line [byte].
inline constexpr std::size_t cache_line = 64;

}  // namespace moreau::detail
