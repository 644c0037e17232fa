// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

template class moreau::Polyhedron<double>;

namespace validation {
template moreau::StepReport World<Polyhedron<>, Coulomb<Polyhedron<>>>::step(double);
template moreau::StepReport
World<Polyhedron<>, Coulomb<Polyhedron<>>, moreau::ProximalFallback<>>::step(double);
template moreau::StepReport World<Polyhedron<>, Springs<Polyhedron<>>>::step(double);
}  // namespace validation
