// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "moreau/contact/contact.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau::detail {

/// The rounding of the gap of a contact, which follows from those of the positions of its bodies [m].
template <class S>
typename S::Scalar gap_rounding(const Bodies<S>& bodies, const Contact<S>& contact) {
  using Scalar = typename S::Scalar;
  const auto length = [](const typename S::Vector& x) { return x.template lpNorm<1>(); };
  return 2 * std::numeric_limits<Scalar>::epsilon() *
         (length(bodies.pose[contact.a].position) + length(bodies.pose[contact.b].position) +
          length(contact.lever_a) + length(contact.lever_b));
}

}  // namespace moreau::detail
