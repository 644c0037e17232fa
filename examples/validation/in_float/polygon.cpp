// SPDX-License-Identifier: MIT
#include "cases/world_impl.hpp"

template class moreau::Polygon<float>;

namespace validation {
template moreau::StepReport World<Polygon<float>, Coulomb<Polygon<float>>>::step(double);
template moreau::StepReport World<Polygon<float>, Springs<Polygon<float>>>::step(double);
}  // namespace validation
