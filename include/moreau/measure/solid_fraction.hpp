// SPDX-License-Identifier: MIT
// The share of a control volume that grains fill, computed exactly, without sample points.
#pragma once

#include <cstddef>

#include "moreau/measure/clip.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/detail/clip_sphere.hpp"

namespace moreau {

/// The solid fraction in a control volume [-]. Where grains overlap, the overlap counts twice.
/// @param control_volume  world axes [m]; if it reaches beyond the container, so does the void that
///                        is counted: require_inside() checks that
/// @param grain_count     number of grains
/// @param shape_of        k -> the shape of grain k
/// @param pose_of         k -> its pose, world axes [m]
/// @param workspace       buffers, reused
/// @returns volume of the grains in the control volume over its volume
/// @throws std::invalid_argument if the control volume is empty, inverted or not finite
template <class S, class ShapeOf, class PoseOf>
typename S::Scalar solid_fraction(const Aabb<S>& control_volume, std::size_t grain_count,
                                  const ShapeOf& shape_of, const PoseOf& pose_of,
                                  ClipWorkspace<S>& workspace) {
  require_control_volume(control_volume, "solid_fraction");
  typename S::Scalar solid = 0;
  for (std::size_t k = 0; k < grain_count; ++k)
    solid += clipped_volume(shape_of(k), pose_of(k), control_volume, workspace);
  return solid / volume(control_volume);
}

}  // namespace moreau
