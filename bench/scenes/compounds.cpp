// SPDX-License-Identifier: MIT
#include "moreau/sample/compound_ballast.hpp"

#include "pressed.hpp"

bool scenes::run_compounds(const Options& options) {
  if (options.scene != "concave") return false;
  Options pressed = options;
  if (pressed.size == 0) pressed.size = 400;
  measure(pressed_box<Compound<Polyhedron<double>>>(pressed), pressed);
  return true;
}
