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

/// The integrator that goes with a law unless the user says otherwise: VelocityVerlet for a
/// regularized law, MoreauJean for a set-valued one.
template <class Law, class S>
using DefaultIntegrator = std::conditional_t<RegularizedLaw<Law, S>, VelocityVerlet, MoreauJean>;
/// The solver that does: none for a regularized law, ColouredGaussSeidel for a law of points,
/// NonlinearGaussSeidel for one that rolls.
template <class Law, class S>
using DefaultSolver = std::conditional_t<
    RegularizedLaw<Law, S>, NoSolver,
    std::conditional_t<PointLaw<Law, S>, ColouredGaussSeidel, NonlinearGaussSeidel>>;

}  // namespace moreau
