// SPDX-License-Identifier: MIT
// Replaces operator new by one that counts its calls. Include it in one source of a program.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations{0};
std::atomic<std::size_t> bytes_asked_for{0};  // of all calls

void* counted(std::size_t size) noexcept {
  ++allocations;
  bytes_asked_for += size;
  return std::malloc(size);
}
void* counted(std::size_t size, std::align_val_t alignment) noexcept {
  ++allocations;
  bytes_asked_for += size;
  const auto a = static_cast<std::size_t>(alignment);
  return std::aligned_alloc(a, (size + a - 1) / a * a);
}
void* or_throw(void* p) {
  if (!p) throw std::bad_alloc();
  return p;
}

using Size = std::size_t;
using Align = std::align_val_t;
using Nothrow = std::nothrow_t;

}  // namespace

// All forms of operator new are replaced. If a library had its own new[] or nothrow new, its
// allocations would not be counted, and memory would be freed by a delete that does not match. The
// functions are not inline, because the compiler would then report malloc and delete as a mismatch.
[[gnu::noinline]] void* operator new(Size n) {
  return or_throw(counted(n));
}
[[gnu::noinline]] void* operator new[](Size n) {
  return or_throw(counted(n));
}
[[gnu::noinline]] void* operator new(Size n, Align a) {
  return or_throw(counted(n, a));
}
[[gnu::noinline]] void* operator new[](Size n, Align a) {
  return or_throw(counted(n, a));
}
[[gnu::noinline]] void* operator new(Size n, const Nothrow&) noexcept {
  return counted(n);
}
[[gnu::noinline]] void* operator new[](Size n, const Nothrow&) noexcept {
  return counted(n);
}
[[gnu::noinline]] void* operator new(Size n, Align a, const Nothrow&) noexcept {
  return counted(n, a);
}
[[gnu::noinline]] void* operator new[](Size n, Align a, const Nothrow&) noexcept {
  return counted(n, a);
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, Size) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, Align) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, Size, Align) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, const Nothrow&) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, Align, const Nothrow&) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, Size) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, Align) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, Size, Align) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, const Nothrow&) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete[](void* p, Align, const Nothrow&) noexcept {
  std::free(p);
}
