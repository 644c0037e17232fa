// SPDX-License-Identifier: MIT
#include "polygons.hpp"

bool scenes::run_polygons_float(const Options& options) {
  return run_polygons_of<float>(options);
}
