// SPDX-License-Identifier: MIT
// What takes long to compile of world.hpp; included by one source file per shape and law.
#pragma once

#include "world.hpp"

namespace validation {

template <class ShapeT, class Law>
moreau::StepReport World<ShapeT, Law>::step(double step) {
  return Base::step(static_cast<ScalarOf<ShapeT>>(step));
}

}  // namespace validation
