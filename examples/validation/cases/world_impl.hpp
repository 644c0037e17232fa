// SPDX-License-Identifier: MIT
// The part of world.hpp that takes long to compile. One source file per shape, law and solver
// includes it.
#pragma once

#include "world.hpp"

namespace validation {

template <class ShapeT, class Law, class Solver>
moreau::StepReport World<ShapeT, Law, Solver>::step(double step) {
  return Base::step(static_cast<ScalarOf<ShapeT>>(step));
}

}  // namespace validation
