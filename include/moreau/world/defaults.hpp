// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "moreau/integrate/moreau_jean.hpp"
#include "moreau/integrate/velocity_verlet.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/force_dynamics.hpp"

namespace moreau {

/// What goes with a law unless the user says otherwise.
template <class Law, class S>
using DefaultIntegrator = std::conditional_t<RegularizedLaw<Law, S>, VelocityVerlet, MoreauJean>;
template <class Law, class S>
using DefaultSolver = std::conditional_t<
    RegularizedLaw<Law, S>, NoSolver,
    std::conditional_t<PointLaw<Law, S>, ColouredGaussSeidel, NonlinearGaussSeidel>>;

}  // namespace moreau
