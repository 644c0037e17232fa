// SPDX-License-Identifier: MIT
#include "instances/compound.hpp"

template class moreau::ContactDetector<moreau::Compound<moreau::Polygon<>>,
                                       moreau::CellGrid<moreau::Space<2>>>;
template moreau::StepReport
moreau::Simulation<moreau::Compound<moreau::Polygon<>>, moreau::SignoriniCoulomb<>>::step(double);
