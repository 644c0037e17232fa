// SPDX-License-Identifier: MIT
#include "polyhedra.hpp"

bool scenes::run_polyhedra_float(const Options& options) {
  return run_polyhedra_of<float>(options);
}
