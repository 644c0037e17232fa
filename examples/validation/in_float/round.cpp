// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<float>, Coulomb<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Coulomb<Disk<float>>>::step(double);
template moreau::StepReport World<Ball<float>, Frictionless<Ball<float>>>::step(double);
template moreau::StepReport World<Disk<float>, Frictionless<Disk<float>>>::step(double);
}  // namespace validation
