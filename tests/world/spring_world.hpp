// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/world/simulation.hpp"

namespace scenes {

/// An empty simulation of grains of about 20 mm with a regularized law.
template <class ShapeT>
auto spring_world() {
  using Law = moreau::LinearSpringDashpot<double>;
  return moreau::Simulation<ShapeT, Law>(0.02, moreau::Materials<Law>(1, Law(1e5, 5e4, 0.4, 0.5)));
}

}  // namespace scenes
