// SPDX-License-Identifier: MIT
#include "instances/world_impl.hpp"

template moreau::StepReport scenes::World<moreau::Polyhedron<double>>::step(double);
template struct scenes::BoxOfGrains<moreau::Polyhedron<double>>;
