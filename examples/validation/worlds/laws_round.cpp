// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<>, Sticky<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Sticky<Disk<>>>::step(double);
template moreau::StepReport World<Ball<>, Rolling<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Rolling<Disk<>>>::step(double);
template moreau::StepReport World<Ball<>, Springs<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Springs<Disk<>>>::step(double);
template moreau::StepReport World<Ball<>, Hertz<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Hertz<Disk<>>>::step(double);
}  // namespace validation
