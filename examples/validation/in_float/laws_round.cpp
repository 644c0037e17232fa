// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<float>, Sticky<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Sticky<Disk<float>>>::step(double);
template moreau::StepReport World<Ball<float>, Rolling<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Rolling<Disk<float>>>::step(double);
template moreau::StepReport World<Ball<float>, Springs<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Springs<Disk<float>>>::step(double);
template moreau::StepReport World<Ball<float>, Hertz<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Hertz<Disk<float>>>::step(double);
}  // namespace validation
