// SPDX-License-Identifier: MIT
// The energy that the contact impulses and couples of a step took from the bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// Energies that the impulses took from the bodies in a step [J].
struct ContactLosses {
  double friction = 0, rolling = 0;  ///< by tangential impulses, by couples
  double dissipation = 0;            ///< by all impulses and couples
  void add(const ContactLosses& other) {
    friction += other.friction;
    rolling += other.rolling;
    dissipation += other.dissipation;
  }
};

template <class S, int Rows>
void add_losses(std::span<const typename S::Twist> velocities, const Contacts<S, Rows>& contacts,
                std::size_t c, const typename S::Vector& before,
                std::span<const typename S::Twist> after, ContactLosses& sum) {
  const Contact<S>& contact = contacts.points[c];
  const std::uint32_t a = contact.a, b = contact.b;
  const typename S::Vector& impulse = contacts.impulse(c);
  if (contacts.impulses[c].isZero(0)) return;
  typename S::Vector mean = relative_velocity(contact, after[a], after[b]);
  for (int k = 0; k < S::dim; ++k) mean[k] = (before[k] + mean[k]) / 2;
  typename S::Scalar along = 0;
  for (int k = 1; k < S::dim; ++k) along += impulse[k] * mean[k];
  const double friction = -double(along);
  sum.friction += friction;
  sum.dissipation += friction - double(impulse[0] * mean[0]);
  if constexpr (!Contacts<S, Rows>::has_couples) return;
  typename S::Twist turn;
  for (int k = 0; k < S::dofs; ++k)
    turn[k] = (velocities[b][k] - velocities[a][k] + after[b][k] - after[a][k]) / 2;
  const double rolling =
      -double((S::angular_frame(contact.frame) * contacts.couple(c)).dot(angular<S>(turn)));
  sum.rolling += rolling;
  sum.dissipation += rolling;
}

/// -sum r . (u before + u after)/2 over the contacts, and the same for the couples.
/// @param velocities one per body: velocity before the step, in the configuration of the contacts
/// @param before     one per contact: relative velocity before the step, contact frame [m/s]
/// @param after      one per body: velocity after the step
template <class S, int Rows>
ContactLosses contact_losses(const Team& team, std::span<const typename S::Twist> velocities,
                             const Contacts<S, Rows>& contacts,
                             std::span<const typename S::Vector> before,
                             std::span<const typename S::Twist> after) {
  return sum_of<ContactLosses>(team, contacts.size(), [&](ContactLosses& sum, std::size_t c) {
    add_losses<S>(velocities, contacts, c, before[c], after, sum);
  });
}

}  // namespace moreau::detail
