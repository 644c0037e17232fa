// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball, Coulomb>::step(double);
}  // namespace validation
