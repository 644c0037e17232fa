// SPDX-License-Identifier: MIT
#include "instances/compound.hpp"

template class moreau::ContactDetector<moreau::Compound<moreau::Polyhedron<>>,
                                       moreau::CellGrid<moreau::Space<3>>>;
template moreau::StepReport moreau::Simulation<moreau::Compound<moreau::Polyhedron<>>,
                                               moreau::SignoriniCoulomb<>>::step(double);
