// SPDX-License-Identifier: MIT
// A million steps of a packing at rest. The packing must not drift or gain energy, and must not use
// more memory than after the first ten thousand steps.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <malloc.h>

#include "moreau/measure/energy.hpp"

#include "world/assemblies.hpp"

using namespace moreau;

namespace {

template <class ShapeT>
double potential(const scenes::World<ShapeT>& world) {
  double sum = 0;
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const std::size_t i = world.grain(k).index();
    sum -= world.bodies().grain_mass[i] * world.gravity().dot(world.bodies().pose[i].position);
  }
  return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("a million steps at rest", ShapeT, Polyhedron<>, Polygon<>, Disk<>) {
  scenes::BoxOfGrains<ShapeT> box(12);
  auto& world = box.simulation;
  for (int k = 0; k < 10000; ++k) world.step(5e-4);
  // Unit of energy: the weight of a grain times its size.
  const double unit = world.bodies().grain_mass[box.grains[0].index()] * world.gravity().norm() *
                      world.grain_size();
  const double start = potential(world);
  const std::size_t memory = mallinfo2().uordblks;
  double moving = 0, capped = 0;
  for (int k = 0; k < 1000000; ++k) {
    capped += world.step(5e-4).solve.capped;
    if (k % 1000 == 0) moving = std::max(moving, kinetic_energy(world).total());
  }
  const double drift = (potential(world) - start) / unit;
  MESSAGE("drift of the potential energy ", drift, ", largest kinetic energy ", moving / unit,
          " m g d, steps capped ", capped, ", bytes more ",
          double(mallinfo2().uordblks) - double(memory));
  CHECK(moving < 1e-6 * unit);
  CHECK(std::abs(drift) < 1e-3);
  CHECK(mallinfo2().uordblks <= memory + 4096);
}
