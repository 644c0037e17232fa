// SPDX-License-Identifier: MIT
// The share of each class of contacts (vertex-face, edge-edge, ...) in number and force.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "moreau/measure/detail/of_simulation.hpp"
#include "moreau/measure/pair_forces.hpp"

namespace moreau {

/// The share of one class of contacts.
struct ContactClassShare {
  std::size_t pairs = 0;   ///< number of pairs of bodies with a contact of this class that carries
                           ///< force
  std::size_t points = 0;  ///< number of contact points of these pairs that carry force
  double neighbours = 0;   ///< mean number of neighbours of a grain with a contact of this class
                           ///< [-]; a pair of two grains counts twice, a pair of a grain and a wall
                           ///< once
  double force = 0;        ///< sum of the normal forces of this class, divided by the sum over all
                           ///< classes, in [0, 1] [-]
};

/// The share of every ContactClass.
struct ContactClasses {
  /// The shares in the order of the enumerators of ContactClass.
  std::array<ContactClassShare, static_cast<std::size_t>(ContactClass::face_face) + 1> shares;

  /// The share of one class.
  const ContactClassShare& operator[](ContactClass c) const {
    return shares[static_cast<std::size_t>(c)];
  }
};

/// The coordination by class of contact. The sum of `neighbours` over all classes is the
/// coordination number that CoordinationCounter returns if it removes no rattlers.
/// @param pairs       result of pair_forces()
/// @param grain_count number of grains; if it is 0, all `neighbours` are 0
/// @param is_grain    function: index of a body (BodyId::index()) -> true for a grain, false for a
///                    wall
template <class S>
ContactClasses contact_classes(std::span<const PairForce<S>> pairs, std::size_t grain_count,
                               const auto& is_grain) {
  ContactClasses result;
  double sum = 0;
  for (const PairForce<S>& pair : pairs) {
    ContactClassShare& share = result.shares[static_cast<std::size_t>(pair.contact_class)];
    ++share.pairs;
    share.points += pair.points;
    share.neighbours += (is_grain(pair.a) ? 1 : 0) + (is_grain(pair.b) ? 1 : 0);
    share.force += double(pair.normal_force);
    sum += double(pair.normal_force);
  }
  for (ContactClassShare& share : result.shares) {
    share.neighbours = grain_count > 0 ? share.neighbours / double(grain_count) : 0;
    share.force = sum > 0 ? share.force / sum : 0;
  }
  return result;
}

/// The same for the grains of a simulation and its last step. As in coordination(), an obstacle counts as a wall.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
/// @throws std::invalid_argument if the step is not positive
template <class Simulation>
ContactClasses contact_classes(const Simulation& simulation, typename Simulation::Scalar step) {
  using S = typename Simulation::S;
  const auto pairs = pair_forces(simulation, step);
  const auto is_free = detail::free_grain_in(simulation);
  std::size_t grains = 0;
  for (std::size_t body = 0; body < simulation.bodies().size(); ++body)
    grains += is_free(body) ? 1u : 0u;
  return contact_classes<S>(std::span<const PairForce<S>>(pairs), grains, is_free);
}

}  // namespace moreau
