// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Disk<>, Frictionless<Disk<>>>::step(double);
}  // namespace validation
