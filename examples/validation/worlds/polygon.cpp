// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

template class moreau::Polygon<double>;

namespace validation {
template moreau::StepReport World<Polygon<>, Coulomb<Polygon<>>>::step(double);
template moreau::StepReport World<Polygon<>, Coulomb<Polygon<>>, moreau::ProximalFallback<>>::step(
    double);
template moreau::StepReport World<Polygon<>, Springs<Polygon<>>>::step(double);
}  // namespace validation
