// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Polygon<>, Springs<Polygon<>>>::step(double);
}  // namespace validation
