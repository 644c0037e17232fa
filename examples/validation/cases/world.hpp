// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/proximal_fallback.hpp"
#include "moreau/world/simulation.hpp"

// The steps are compiled once, in worlds/ and in_float/.
extern template class moreau::Polyhedron<double>;
extern template class moreau::Polygon<double>;
extern template class moreau::Polyhedron<float>;
extern template class moreau::Polygon<float>;

namespace validation {

using moreau::Ball;
using moreau::Disk;
using moreau::Polygon;
using moreau::Polyhedron;

// The laws in the scalar of a shape.
template <class ShapeT>
using ScalarOf = typename moreau::SpaceOf<ShapeT>::Scalar;
template <class ShapeT>
using Coulomb = moreau::SignoriniCoulomb<ScalarOf<ShapeT>>;
template <class ShapeT>
using Frictionless = moreau::Frictionless<ScalarOf<ShapeT>>;
template <class ShapeT>
using Sticky = moreau::Cohesive<Coulomb<ShapeT>>;
template <class ShapeT>
using Rolling = moreau::RollingResistance<ScalarOf<ShapeT>>;
template <class ShapeT>
using Springs = moreau::LinearSpringDashpot<ScalarOf<ShapeT>>;
template <class ShapeT>
using Hertz = moreau::HertzMindlin<ScalarOf<ShapeT>>;

/// A simulation whose step is compiled once for each shape, law and solver, in worlds/ and
/// in_float/, and not in every case. Its policies but the solver are the defaults, whose worlds under Coulomb's law are
/// in moreau_instances.
template <class ShapeT, class Law = Coulomb<ShapeT>,
          class Solver = moreau::DefaultSolver<Law, moreau::SpaceOf<ShapeT>>>
struct World
    : moreau::Simulation<ShapeT, Law, moreau::DefaultIntegrator<Law, moreau::SpaceOf<ShapeT>>,
                         moreau::CellGrid<moreau::SpaceOf<ShapeT>>, Solver> {
  using Base =
      moreau::Simulation<ShapeT, Law, moreau::DefaultIntegrator<Law, moreau::SpaceOf<ShapeT>>,
                         moreau::CellGrid<moreau::SpaceOf<ShapeT>>, Solver>;
  using Base::Base;
  moreau::StepReport step(double step);
};

}  // namespace validation
