// SPDX-License-Identifier: MIT
#include "worlds/world_impl.hpp"

template moreau::StepReport scenes::World<moreau::Sphere<moreau::Space<2>>>::step(double);
template struct scenes::BoxOfGrains<moreau::Sphere<moreau::Space<2>>>;
