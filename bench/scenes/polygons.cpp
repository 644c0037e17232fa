// SPDX-License-Identifier: MIT
#include "polygons.hpp"

bool scenes::run_polygons(const Options& options) {
  return run_polygons_of<double>(options);
}
