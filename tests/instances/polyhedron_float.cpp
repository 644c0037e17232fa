// SPDX-License-Identifier: MIT
#include "instances/world_impl.hpp"

template moreau::StepReport scenes::World<moreau::Polyhedron<float>>::step(float);
template struct scenes::BoxOfGrains<moreau::Polyhedron<float>>;
