// SPDX-License-Identifier: MIT
// The mistake of support_leaks_expression.cpp, in a simulation.
// expect: shape.support\(direction\)
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Ball : moreau::Ball<double> {
#ifdef MOREAU_CORRECTED
  Vector support(const Vector& direction) const {
    return 2 * direction;
  }
#else
  auto support(const Vector& direction) const {
    return 2 * direction;
  }
#endif
};

using Simulation = moreau::Simulation<Ball, moreau::SignoriniCoulomb<double>>;
Simulation* simulation;
