// SPDX-License-Identifier: MIT
// No allocation per step after warm-up: operator new and Eigen's own allocation are both watched.
#define EIGEN_RUNTIME_NO_MALLOC
#define eigen_assert(condition)                \
  do {                                         \
    if (!(condition)) eigen_complained = true; \
  } while (false)
static bool eigen_complained = false;

#include <atomic>
#include <cstdlib>
#include <doctest/doctest.h>
#include <new>

#include "world/assemblies.hpp"

namespace {
std::atomic<long> allocations{0};
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

TEST_CASE_TEMPLATE("a packing at rest steps without allocating", ShapeT, moreau::Polyhedron<>,
                   moreau::Polygon<>, moreau::Sphere<moreau::Space<3>>,
                   moreau::Sphere<moreau::Space<2>>) {
  scenes::BoxOfGrains<ShapeT> scene(27);
  for (int k = 0; k < 1500; ++k) scene.simulation.step(5e-4);
  const long before = allocations;
  eigen_complained = false;
  Eigen::internal::set_is_malloc_allowed(false);
  for (int k = 0; k < 200; ++k) scene.simulation.step(5e-4);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations == before);
  CHECK_FALSE(eigen_complained);
}
