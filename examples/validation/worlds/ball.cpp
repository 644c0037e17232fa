// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Ball<>, Coulomb<Ball<>>>::step(double);
}  // namespace validation
