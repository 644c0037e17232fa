// SPDX-License-Identifier: MIT
#include "polyhedra.hpp"

bool scenes::run_polyhedra(const Options& options) {
  return run_polyhedra_of<double>(options);
}
