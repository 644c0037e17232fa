// SPDX-License-Identifier: MIT
// The fraction of a control volume that is filled by grains, computed exactly, without sampling.
#pragma once

#include <cstddef>

#include "moreau/measure/clip.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/detail/clip_sphere.hpp"

namespace moreau {

/// The volume of that part of a compound grain which lies in a control volume, in the plane the area
/// [m^D]: the sum over its parts. If parts overlap, the sum is multiplied by the volume of the grain
/// over that of its parts: exact for a grain that lies in the control volume as a whole, an estimate
/// for a grain that it cuts.
/// Arguments and exceptions are those of clipped_volume of a polytope (measure/clip.hpp).
template <CompoundShape Shape, class S = SpaceOf<Shape>>
typename S::Scalar clipped_volume(const Shape& shape, const Pose<S>& pose,
                                  const Aabb<S>& control_volume, ClipWorkspace<S>& workspace) {
  typename S::Scalar sum = 0;
  for (const auto& part : shape.parts())
    sum += clipped_volume(part.shape, pose * part.pose, control_volume, workspace);
  return sum * shape.volume_share();
}

/// The solid fraction in a control volume [-]: the volume of the grains inside the control volume
/// divided by the volume of the control volume. Where two grains overlap, the overlap counts twice.
/// @param control_volume  world axes [m]. If it reaches beyond the container, the volume outside of
///                        the container counts as void; require_inside() checks that it does not
/// @param grain_count     number of grains
/// @param shape_of        function: k -> shape of grain k
/// @param pose_of         function: k -> pose of grain k, world axes [m]
/// @param workspace       buffers, which may be reused for the next call
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
