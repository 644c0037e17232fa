// SPDX-License-Identifier: MIT
#pragma once

#include "piles.hpp"
#include "pressed.hpp"

namespace scenes {

template <class T>
bool run_polyhedra_of(const Options& options) {
  using Shape = Polyhedron<T>;
  const std::string& name = options.scene;
  if (name == "pressed")
    measure(pressed_box<Shape>(options), options);
  else if (name == "falling")
    measure(pile<Shape>(0, 300, options), options);
  else if (name == "resting")
    measure(pile<Shape>(900, 300, options), options);
  else if (name == "convex_pile")
    measure(convex_pile<Shape>(options), options);
  else if (name == "pyramid")
    measure(pyramid<Shape>(options), options);
  else if (name == "mesh")
    measure(on_mesh<Shape>(options), options);
  else
    return false;
  return true;
}

}  // namespace scenes
