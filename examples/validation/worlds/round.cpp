// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<>, Coulomb<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Coulomb<Disk<>>>::step(double);
template moreau::StepReport World<Ball<>, Frictionless<Ball<>>>::step(double);
template moreau::StepReport World<Disk<>, Frictionless<Disk<>>>::step(double);
}  // namespace validation
