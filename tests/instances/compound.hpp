// SPDX-License-Identifier: MIT
// The worlds of compound grains, whose step is compiled once for each kind of part, in compound_*.cpp.
#pragma once

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {
extern template class ContactDetector<Compound<Polygon<>>, CellGrid<Space<2>>>;
extern template class ContactDetector<Compound<Polyhedron<>>, CellGrid<Space<3>>>;
extern template StepReport Simulation<Compound<Polygon<>>, SignoriniCoulomb<>>::step(double);
extern template StepReport Simulation<Compound<Polyhedron<>>, SignoriniCoulomb<>>::step(double);
}  // namespace moreau
