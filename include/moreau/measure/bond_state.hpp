// SPDX-License-Identifier: MIT
// The state of an assembly of bonded grains: bonds per grain, strength that is left, fragments.
#pragma once

#include <algorithm>
#include <cstddef>

#include "moreau/core/disjoint_sets.hpp"
#include "moreau/measure/detail/of_simulation.hpp"

namespace moreau {

/// The bonds of a simulation in numbers. Walls and obstacles, the grains of prescribed motion, have no coordination, join no
/// fragments, and are none.
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
requires requires(const Simulation& simulation) {
  simulation.bonds();
}
BondState bond_state(const Simulation& simulation) {
  BondState state;
  detail::DisjointSets fragments(simulation.bodies().size());
  state.bonds = simulation.bonds().size();
  const auto is_grain = detail::free_grain_in(simulation);
  std::size_t grains = 0;
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) grains += is_grain(i) ? 1u : 0u;
  state.fragments = grains;
  state.least_strength = state.bonds > 0 ? 1 : 0;
  std::size_t ends = 0;
  for (const auto& bond : simulation.bonds()) {
    const bool has_a = is_grain(bond.a.index()), has_b = is_grain(bond.b.index());
    ends += std::size_t(has_a) + std::size_t(has_b);
    state.strength_left += double(bond.strength_left) / double(state.bonds);
    state.least_strength = std::min(state.least_strength, double(bond.strength_left));
    if (has_a && has_b && fragments.unite(bond.a.index(), bond.b.index())) --state.fragments;
  }
  if (grains > 0) state.coordination = double(ends) / double(grains);
  return state;
}

}  // namespace moreau
