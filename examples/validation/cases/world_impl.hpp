// SPDX-License-Identifier: MIT
// What takes long to compile of world.hpp; included by one source file per shape, law and solver.
#pragma once

#include "world.hpp"

namespace validation {

template <class ShapeT, class Law, class Solver>
moreau::StepReport World<ShapeT, Law, Solver>::step(double step) {
  return Base::step(static_cast<ScalarOf<ShapeT>>(step));
}

}  // namespace validation
