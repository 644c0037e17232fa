// SPDX-License-Identifier: MIT
// All scenes of one shape, for the sources that instantiate them.
#pragma once

#include <memory>

#include "arch.hpp"
#include "box.hpp"
#include "column.hpp"
#include "dominoes.hpp"
#include "drum.hpp"
#include "make_scene.hpp"
#include "plate.hpp"
#include "pyramid.hpp"

namespace testbed {

template <class Shape>
std::unique_ptr<AnyScene> make_scene_of(SceneKind kind, const Settings& settings) {
  std::unique_ptr<AnyScene> scene;
  switch (kind) {
    case SceneKind::box:
      scene = std::make_unique<Box<Shape>>(settings);
      break;
    case SceneKind::column:
      scene = std::make_unique<Column<Shape>>(settings);
      break;
    case SceneKind::drum:
      scene = std::make_unique<Drum<Shape>>(settings);
      break;
    case SceneKind::arch:
      scene = std::make_unique<Arch<Shape>>(settings);
      break;
    case SceneKind::pyramid:
      scene = std::make_unique<Pyramid<Shape>>(settings);
      break;
    case SceneKind::dominoes:
      scene = std::make_unique<Dominoes<Shape>>(settings);
      break;
    case SceneKind::plate:
      scene = std::make_unique<Plate<Shape>>(settings);
      break;
  }
  scene->apply(settings);
  return scene;
}

}  // namespace testbed
