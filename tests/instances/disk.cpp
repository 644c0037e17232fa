// SPDX-License-Identifier: MIT
#include "instances/world_impl.hpp"

template moreau::StepReport scenes::World<moreau::Disk<>>::step(double);
template struct scenes::BoxOfGrains<moreau::Disk<>>;
