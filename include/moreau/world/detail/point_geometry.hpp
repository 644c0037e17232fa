// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/motion/mobility.hpp"

namespace moreau::detail {

/// Contact points and the masses of their bodies, with the names of BodyDelassus: what the direct method for
/// islands needs of an operator.
template <class S>
struct PointGeometry {
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;  ///< the rows of a contact

  std::span<const Contact<S>> contacts;
  std::span<const InverseMass<S>> masses;  ///< of all bodies

  std::size_t size() const { return contacts.size(); }
  std::size_t body_count() const { return masses.size(); }
  std::array<std::uint32_t, 2> bodies(std::size_t c) const {
    return {contacts[c].a, contacts[c].b};
  }
  const typename S::Matrix& frame(std::size_t c) const { return contacts[c].frame; }
  const Vector& lever_a(std::size_t c) const { return contacts[c].lever_a; }
  const Vector& lever_b(std::size_t c) const { return contacts[c].lever_b; }
  const InverseMass<S>& inverse_mass(std::size_t body) const { return masses[body]; }
};

}  // namespace moreau::detail
