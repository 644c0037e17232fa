// SPDX-License-Identifier: MIT
#include "instances/world_impl.hpp"

template moreau::StepReport scenes::World<moreau::Ball<>>::step(double);
template struct scenes::BoxOfGrains<moreau::Ball<>>;
