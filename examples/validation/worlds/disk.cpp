// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Disk<>, Coulomb<Disk<>>>::step(double);
}  // namespace validation
