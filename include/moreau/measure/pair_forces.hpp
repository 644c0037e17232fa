// SPDX-License-Identifier: MIT
// The contact force of each pair of bodies: the sum over the pair's contact points. Statistics of
// contact forces count pairs, so that they do not depend on the number of points of a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/measure/detail/of_simulation.hpp"

namespace moreau {

/// Sum over those contact points of a pair that have a normal impulse > 0. All vectors are in world
/// axes.
template <class S>
struct PairForce {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  std::uint32_t a;             ///< index of the first body
  std::uint32_t b;             ///< index of the second body
  std::size_t points;          ///< number of points with normal impulse > 0
  ContactClass contact_class;  ///< contact class of the pair; if its parts touch in several ways
                               ///< (Compound), that of the point with the largest normal force
  Vector normal;        ///< unit, from a to b; if the points have different normals (CylinderWall,
                        ///< Compound), their mean weighted by normal force, normalized
  Vector lever_a;       ///< from the centre of a to the centre of pressure of the contact [m]
  Vector lever_b;       ///< from the centre of b to the centre of pressure of the contact [m]
  Vector force;         ///< force on b [N]
  Scalar normal_force;  ///< sum of the normal forces of the points, > 0 [N]
  Scalar friction_force;  ///< magnitude of the sum of the tangential forces [N]
};

/// Replaces the contents of `pairs` by the pairs that carry force, in the order of `contacts`.
/// @param step length of the step [s], > 0, by which impulses are divided
/// @throws std::invalid_argument if the step is not positive
template <class S, int Rows>
void pair_forces(const Contacts<S, Rows>& contacts, typename S::Scalar step,
                 std::vector<PairForce<S>>& pairs) {
  require_positive(step, "pair_forces", "step");
  pairs.clear();
  typename S::Scalar largest = 0;  // normal force of a point of the present pair
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact<S>& contact = contacts.points[c];
    const typename S::Scalar push = contacts.impulses[c][0] / step;
    if (!(push > 0)) continue;
    if (pairs.empty() || pairs.back().a != contact.a || pairs.back().b != contact.b) {
      largest = 0;
      pairs.push_back({contact.a, contact.b, 0, contacts.classes[c], S::Vector::Zero(),
                       S::Vector::Zero(), S::Vector::Zero(), S::Vector::Zero(), 0, 0});
    }
    PairForce<S>& pair = pairs.back();
    if (push > largest) {
      largest = push;
      pair.contact_class = contacts.classes[c];
    }
    ++pair.points;
    pair.normal += push * contact.frame.col(0);
    pair.lever_a += push * contact.lever_a;
    pair.lever_b += push * contact.lever_b;
    pair.force += contact.frame * contacts.impulse(c) / step;
    pair.normal_force += push;
  }
  for (PairForce<S>& pair : pairs) {
    pair.lever_a /= pair.normal_force;
    pair.lever_b /= pair.normal_force;
    pair.friction_force = (pair.force - pair.normal).norm();
    pair.normal.normalize();
  }
}

/// The pairs of a simulation that carry force in its last step.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
/// @throws std::invalid_argument if the step is not positive, or a hundred times longer or shorter than the last one
template <class Simulation>
std::vector<PairForce<typename Simulation::S>> pair_forces(const Simulation& simulation,
                                                           typename Simulation::Scalar step) {
  require_positive(step, "pair_forces", "step");
  detail::require_unit_of_step(simulation, step, "pair_forces");
  std::vector<PairForce<typename Simulation::S>> pairs;
  pair_forces(simulation.contacts(), step, pairs);
  return pairs;
}

}  // namespace moreau
