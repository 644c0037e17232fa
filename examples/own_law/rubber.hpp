// SPDX-License-Identifier: MIT
// A regularized law of one's own: rubber, which stiffens as it is pressed, with a friction that is
// viscous up to Coulomb's limit. It keeps no memory.
#pragma once

#include <algorithm>

#include "moreau/law/regularized.hpp"

struct Rubber {
  double stiffness = 1e4;  ///< of a light touch [N/m]
  double depth = 1e-4;     ///< at which it is twice as stiff [m]
  double damping = 1;      ///< along the normal [N s/m]
  double drag = 1;         ///< across it [N s/m]
  double mu = 0.5;         ///< friction [-]

  /// On b, in the contact's frame, normal first [N].
  template <class S>
  typename S::Vector force(const moreau::ContactMotion<S>& motion, typename S::Vector&) const {
    constexpr int tangents = S::dim - 1;
    typename S::Vector f = S::Vector::Zero();
    if (motion.gap >= 0) return f;
    const double overlap = -double(motion.gap);
    const double elastic = stiffness * overlap * (1 + overlap / (2 * depth));
    const double push = std::max(0.0, elastic - damping * double(motion.velocity[0]));
    const auto slip = motion.velocity.template tail<tangents>();
    const double speed = double(slip.norm());
    const double share = drag * speed > mu * push ? mu * push / speed : drag;
    using T = typename S::Scalar;
    f[0] = T(push);
    f.template tail<tangents>() = -T(share) * slip;
    return f;
  }
};

static_assert(moreau::RegularizedLaw<Rubber, moreau::Space<3>>);  // says what is missing
