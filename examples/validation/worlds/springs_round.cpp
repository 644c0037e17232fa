// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<>, Springs<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Springs<Disk<>>>::step(double);
template moreau::StepReport World<Ball<>, Hertz<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Hertz<Disk<>>>::step(double);
}  // namespace validation
