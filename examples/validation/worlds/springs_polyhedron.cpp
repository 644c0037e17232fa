// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

namespace validation {
template moreau::StepReport World<Polyhedron<>, Springs<Polyhedron<>>>::step(double);
}  // namespace validation
