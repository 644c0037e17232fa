// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>

namespace moreau::detail {

/// Allocates whole cache lines, so that what is as long as a line, or a register, lies on one line.
template <class X>
struct CacheLineAllocator {
  using value_type = X;
  static constexpr std::align_val_t line{64};

  CacheLineAllocator() = default;
  template <class Y>
  CacheLineAllocator(const CacheLineAllocator<Y>&) {}  // NOLINT(google-explicit-constructor)
  X* allocate(std::size_t count) {
    return static_cast<X*>(::operator new(count * sizeof(X), line));
  }
  void deallocate(X* memory, std::size_t) { ::operator delete(memory, line); }
  template <class Y>
  bool operator==(const CacheLineAllocator<Y>&) const {
    return true;
  }
};

}  // namespace moreau::detail
