// SPDX-License-Identifier: MIT
// The state of an assembly of bonded grains: bonds per grain, strength that is left, fragments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace moreau {

/// The bonds of a simulation in numbers. Walls have no coordination and join no fragments.
struct BondState {
  std::size_t bonds = 0;      ///< that have not broken
  double coordination = 0;    ///< mean number of bonds of a grain [-]
  double strength_left = 0;   ///< mean of Bond::strength_left [-]; 0 without bonds
  double least_strength = 0;  ///< the smallest Bond::strength_left [-]; 0 without bonds
  std::size_t fragments = 0;  ///< sets of grains that bonds connect; a grain without bonds is one
};

/// Measures the bonds of a simulation.
/// @param simulation a Simulation whose law is a BondingLaw
template <class Simulation>
BondState bond_state(const Simulation& simulation) {
  BondState state;
  std::vector<std::uint32_t> root(simulation.bodies().size());
  std::iota(root.begin(), root.end(), 0u);
  const auto root_of = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  state.bonds = simulation.bonds().size();
  state.fragments = simulation.grain_count();
  state.least_strength = state.bonds > 0 ? 1 : 0;
  std::size_t ends = 0;
  for (const auto& bond : simulation.bonds()) {
    const bool has_a = simulation.is_grain(bond.a.index()),
               has_b = simulation.is_grain(bond.b.index());
    ends += std::size_t(has_a) + std::size_t(has_b);
    state.strength_left += double(bond.strength_left) / double(state.bonds);
    state.least_strength = std::min(state.least_strength, double(bond.strength_left));
    if (!has_a || !has_b) continue;
    const std::uint32_t a = root_of(std::uint32_t(bond.a.index())),
                        b = root_of(std::uint32_t(bond.b.index()));
    if (a == b) continue;
    root[std::max(a, b)] = std::min(a, b);
    --state.fragments;
  }
  if (simulation.grain_count() > 0)
    state.coordination = double(ends) / double(simulation.grain_count());
  return state;
}

}  // namespace moreau
