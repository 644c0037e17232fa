// SPDX-License-Identifier: MIT
#pragma once

#include "piles.hpp"
#include "pressed.hpp"

namespace scenes {

template <class T>
bool run_polygons_of(const Options& options) {
  using Shape = Polygon<T>;
  const std::string& name = options.scene;
  if (name == "plane_pressed")
    measure(pressed_box<Shape>(options), options);
  else if (name == "plane_falling")
    measure(pile<Shape>(0, 300, options), options);
  else if (name == "plane_resting")
    measure(pile<Shape>(900, 300, options), options);
  else if (name == "plane_pyramid")
    measure(pyramid<Shape>(options), options);
  else
    return false;
  return true;
}

}  // namespace scenes
