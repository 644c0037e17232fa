// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

namespace moreau {

/// The solver of a Simulation under a regularized law, which leaves nothing to solve.
struct NoSolver {};

/// The default integrator of a law: VelocityVerlet for a regularized law, MoreauJean for a
/// set-valued law.
template <class Law, class S>
using DefaultIntegrator = std::conditional_t<RegularizedLaw<Law, S>, VelocityVerlet, MoreauJean>;
/// The default solver of a law: none for a regularized law, ColouredGaussSeidel for a set-valued law.
template <class Law, class S>
using DefaultSolver = std::conditional_t<RegularizedLaw<Law, S>, NoSolver, ColouredGaussSeidel>;

namespace detail {

/// The default policies of a simulation. For a type that is no shape there are none, so that the
/// compiler's only message is that it is no shape.
template <class ShapeT, class Law>
struct DefaultPolicies {
  using Integrator = void;
  using Broad = void;
  using Solver = void;
};
template <GrainShape ShapeT, class Law>
struct DefaultPolicies<ShapeT, Law> {
  using Integrator = DefaultIntegrator<Law, SpaceOf<ShapeT>>;
  using Broad = CellGrid<SpaceOf<ShapeT>>;
  using Solver = DefaultSolver<Law, SpaceOf<ShapeT>>;
};

}  // namespace detail

}  // namespace moreau
