// SPDX-License-Identifier: MIT
// A stone that breaks: the parts of a Compound as grains that bonds hold together.
#pragma once

#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

/// Adds the parts of a compound to a simulation of their shape as grains, and bonds those of them that touch: with a
/// common face at its centre of contact. Polytopes that touch at an edge or a corner alone get no bond, round parts get one
/// where they touch. Bonds to other grains are not made. The grain size of the simulation should be
/// that of the smallest part, as that of the smallest grain.
/// @param simulation Simulation of Compound::PartShape under a BondingLaw
/// @param stone      a Compound whose parts do not overlap
/// @param pose       of the frame of the compound, world axes [m]
/// @param density    [kg/m^3], in the plane [kg/m^2], > 0
/// @param material   of all parts: its law has the strength of the bonds
/// @param gap        parts whose gap is at most this are bonded [m], in [0, margin]
/// @returns the ids of the parts, in the order of Compound::parts()
/// @throws std::invalid_argument for a compound whose parts overlap by more than 1e-3 of the volume, and as
///         Simulation::add_grain(), Simulation::bond_touching(). The simulation then has no part of the stone
template <class Simulation, class Compound>
std::vector<BodyId> add_bonded_parts(Simulation& simulation, const Compound& stone,
                                     const Pose<typename Simulation::S>& pose,
                                     typename Simulation::Scalar density, MaterialId material,
                                     typename Simulation::Scalar gap) {
  using Scalar = typename Simulation::Scalar;
  require(stone.volume_share() > Scalar(1 - 1e-3), "add_bonded_parts", "stone.volume_share()",
          stone.volume_share(), "must be 1: grains do not overlap");
  std::vector<BodyId> parts;
  try {
    for (const auto& part : stone.parts())
      parts.push_back(simulation.add_grain(simulation.add_shape(part.shape), pose * part.pose,
                                           density, material));
    // Polytopes with a common face have at least as many contact points as the space has dimensions.
    constexpr std::size_t fewest = Polytope<typename Compound::PartShape> ? Simulation::S::dim : 1;
    simulation.bond_touching(gap, std::span<const BodyId>(parts), fewest);
  } catch (...) {
    simulation.remove_grains(parts);
    throw;
  }
  return parts;
}

}  // namespace moreau
