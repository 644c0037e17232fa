// SPDX-License-Identifier: MIT
// A velocity with two components in a simulation in space.
// expect: (use of|call to) deleted (function|constructor).*Components
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using World = moreau::Simulation<moreau::Ball<double>, moreau::SignoriniCoulomb<double>>;

void push(World& world, moreau::BodyId body) {
#ifdef MOREAU_CORRECTED
  world.set_velocity(body, {1, 0, 0});
#else
  world.set_velocity(body, {1, 0});
#endif
}
