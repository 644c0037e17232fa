// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball, Springs>::step(double);
template moreau::StepReport World<Disk, Springs>::step(double);
template moreau::StepReport World<Ball, Hertz>::step(double);
template moreau::StepReport World<Disk, Hertz>::step(double);
}  // namespace validation
