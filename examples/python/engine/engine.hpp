// SPDX-License-Identifier: MIT
// The twelve simulations of the Python module. What takes long to compile, their steps and their contact
// detection, is compiled once in the six units of this folder, and declared extern in every unit that
// includes this header.
#pragma once

#include "moreau/instances/plane.hpp"
#include "moreau/instances/space.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"

namespace moreau_python {
using Coulomb = moreau::SignoriniCoulomb<double>;
using Rolling = moreau::RollingResistance<double>;
using Compliant = moreau::Compliant<Coulomb>;
}  // namespace moreau_python

/// The worlds of one law in one space: grains of one kind of polytope, and balls or disks.
/// @param HOW `extern template`, or `template` in the unit that instantiates them
#define MOREAU_PYTHON_WORLDS(HOW, SpaceT, PolytopeT, LawT)                          \
  HOW class detail::ImpulseDynamics<SpaceT, LawT, MoreauJean, ColouredGaussSeidel>; \
  HOW StepReport Simulation<PolytopeT, LawT>::step(double);                         \
  HOW StepReport Simulation<BallIn<SpaceT>, LawT>::step(double);

namespace moreau {
MOREAU_PYTHON_WORLDS(extern template, Space<3>, Polyhedron<double>, moreau_python::Rolling)
MOREAU_PYTHON_WORLDS(extern template, Space<2>, Polygon<double>, moreau_python::Rolling)
MOREAU_PYTHON_WORLDS(extern template, Space<3>, Polyhedron<double>, moreau_python::Compliant)
MOREAU_PYTHON_WORLDS(extern template, Space<2>, Polygon<double>, moreau_python::Compliant)
}  // namespace moreau
