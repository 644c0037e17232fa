// SPDX-License-Identifier: MIT
// A law for the plane in a simulation in space. The message names the call that is not valid.
// expect: law.solve\(block, vector, vector\)
#include "moreau/law/concepts.hpp"

#ifdef MOREAU_CORRECTED
using S = moreau::Space<3>;
#else
using S = moreau::Space<2>;
#endif

struct Frictionless {
  double velocity_offset(double gap, double before, double step) const;
  S::Vector solve(const moreau::LocalBlock<S>& block, const S::Vector& b,
                  const S::Vector& guess) const;
  S::Vector natural_map(const S::Vector& velocity, const S::Vector& impulse) const;
};

template <class Law>
requires moreau::SetValuedLaw<Law, moreau::Space<3>>
struct Contacts {
};

Contacts<Frictionless> contacts;
