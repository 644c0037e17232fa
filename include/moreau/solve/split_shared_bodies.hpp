// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/list.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau {

/// Finds the bodies that have contacts in several processes and divides their mass by the number of
/// their copies; shared_bodies.hpp has the equations.
/// @param contacts of this process
/// @param roots    in: M^-1/2 of every body; out: that of its copy
/// @param touched  a buffer
template <class S>
void split_shared_bodies(SharedBodies& shared, std::span<const Contact<S>> contacts,
                         std::span<MobilityRoot<S>> roots, List<unsigned char>& touched) {
  touched.assign(roots.size(), 0);
  const auto touch = [&](std::uint32_t i) {
    touched[i] = !(roots[i].linear.isZero(0) && roots[i].angular.isZero(0));
  };
  for (const Contact<S>& contact : contacts) {
    touch(contact.a);
    touch(contact.b);
  }
  shared.find(touched);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto factor = std::sqrt(static_cast<typename S::Scalar>(shared.copies(i)));
    roots[i].linear *= factor;
    roots[i].angular *= factor;
  }
}

}  // namespace moreau
