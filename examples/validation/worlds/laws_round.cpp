// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball, Sticky>::step(double);
template moreau::StepReport World<Disk, Sticky>::step(double);
template moreau::StepReport World<Ball, Rolling>::step(double);
template moreau::StepReport World<Disk, Rolling>::step(double);
}  // namespace validation
