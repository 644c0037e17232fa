// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "scene.hpp"

namespace testbed {

/// A new scene. Each shape in the plane and in space is compiled once (scenes_in_plane.cpp,
/// scenes_in_space.cpp).
/// @throws std::invalid_argument for settings that the scene cannot have
template <class Shape>
std::unique_ptr<AnyScene> make_scene_of(SceneKind kind, const Settings& settings);
std::unique_ptr<AnyScene> make_scene(SceneKind kind, ShapeKind shape, const Settings& settings);
/// The tables of settings.hpp as JSON.
std::string describe();
/// Channels, plots and bounds of a scene as JSON.
std::string describe(const AnyScene& scene);

}  // namespace testbed
