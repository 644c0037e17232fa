// SPDX-License-Identifier: MIT
// A contact law of one's own: greased faces. Normal impulses obey Signorini's condition; the
// tangential one is viscous, r_t = -drag u_t, as long as the pressure keeps the grease between the
// faces, |r_t| <= friction r_n.
#pragma once

#include <algorithm>

#include "moreau/law/concepts.hpp"
#include "moreau/law/signorini_coulomb.hpp"

struct Greased {
  double drag = 1;  ///< impulse per speed and contact point [N s / (m/s)]: viscosity x time step
  double friction = 1;  ///< of the faces [-]

  /// A contact may close its gap within the step.
  double velocity_offset(double gap, double, double step) const {
    return std::max(0.0, gap) / step;
  }

  /// Grease is a dashpot in series with Coulomb friction. The law is Coulomb's law if u_t is replaced by
  /// u_t + r_t / drag.
  template <class S>
  typename S::Vector solve(const moreau::LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const {
    moreau::LocalBlock<S> yielding = block;
    yielding.slip.array() += 1 / drag;
    return moreau::SignoriniCoulomb<>(friction).solve(yielding, b, guess);
  }

  /// Zero exactly on solutions; the solver's residual is made of it. r is the impulse times scale.
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r, double scale = 1) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    Vector yielding = u;
    yielding.template tail<tangents>() += r.template tail<tangents>() / (scale * drag);
    return moreau::SignoriniCoulomb<>(friction).natural_map(yielding, r);
  }
};

static_assert(moreau::SetValuedLaw<Greased, moreau::Space<2>>);  // says what is missing
