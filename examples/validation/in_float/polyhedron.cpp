// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

template class moreau::Polyhedron<float>;

namespace validation {
template moreau::StepReport World<Polyhedron<float>, Coulomb<Polyhedron<float>>>::step(double);
template moreau::StepReport World<Polyhedron<float>, Springs<Polyhedron<float>>>::step(double);
}  // namespace validation
