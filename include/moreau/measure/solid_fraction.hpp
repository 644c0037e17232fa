// SPDX-License-Identifier: MIT
// The fraction of a control volume that is filled by grains, computed exactly, without sampling.
#pragma once

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "moreau/core/periodic_cell.hpp"
#include "moreau/measure/clip.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/detail/clip_sphere.hpp"
#include "moreau/mesh/surface_mesh.hpp"

namespace moreau {

namespace detail {

/// The share of the volume inside a surface that lies in a control volume [-].
/// @param mesh  in body axes [m]
template <class S>
typename S::Scalar share_between(const SurfaceMesh<S>& mesh, const Pose<S>& pose,
                                 const Aabb<S>& control_volume, ClipWorkspace<S>& workspace) {
  Rings<S>& rings = workspace.rings;
  rings.clear();
  Aabb<S> around;
  std::size_t corner = 0;
  for (const std::int32_t end : mesh.ends) {
    for (; corner < std::size_t(end); ++corner) {
      rings.points.push_back(pose.rotation * mesh.points[std::size_t(mesh.corners[corner])]);
      around.merge(rings.points.back());
    }
    rings.close();
  }
  const typename S::Scalar whole = enclosed_volume(rings);
  const Aabb<S> limits{control_volume.lower - pose.position, control_volume.upper - pose.position};
  return whole > 0 ? volume_between(around, limits, workspace) / whole : 0;
}

}  // namespace detail

/// The volume of that part of a capsule, a cylinder, a rounded shape or a convex shape of one's own with volume() which
/// lies in a control volume [m^D]. Exact for a grain that lies in the control volume as a whole. For a grain that the control
/// volume cuts, it is the part of a mesh with 642 points (in the plane 64) inscribed in its surface,
/// to about 1 % of the grain.
/// Arguments and exceptions are those of clipped_volume of a polytope (measure/clip.hpp).
template <ConvexShape Shape, class S = SpaceOf<Shape>>
requires HasVolume<Shape> &&(!Polytope<Shape> && !CompoundShape<Shape> &&
                             !requires(const Shape& shape) { shape.visit([](const auto&) {}); })
    typename S::Scalar clipped_volume(const Shape& shape, const Pose<S>& pose,
                                      const Aabb<S>& control_volume, ClipWorkspace<S>& workspace) {
  require_control_volume(control_volume, "clipped_volume");
  const Aabb<S> bounds = shape.bounding_box(pose);
  if (control_volume.contains(bounds)) return shape.volume();
  if (!control_volume.overlaps(bounds)) return 0;
  static const SurfaceMesher<S> mesher(3);
  SurfaceMesh<S> mesh;
  mesher.mesh(shape, mesh);
  return shape.volume() * detail::share_between(mesh, pose, control_volume, workspace);
}

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

/// The volume of that part of a shape of several types (OneOf) which lies in a control volume [m^D].
template <class Shape, class S = SpaceOf<Shape>>
requires requires(const Shape& shape) {
  shape.visit([](const auto&) {});
}
typename S::Scalar clipped_volume(const Shape& shape, const Pose<S>& pose,
                                  const Aabb<S>& control_volume, ClipWorkspace<S>& workspace) {
  return shape.visit([&](const auto& held) -> typename S::Scalar {
    return clipped_volume(held, pose, control_volume, workspace);
  });
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
  double solid = 0;
  for (std::size_t k = 0; k < grain_count; ++k)
    solid += double(clipped_volume(shape_of(k), pose_of(k), control_volume, workspace));
  return typename S::Scalar(solid / double(volume(control_volume)));
}

namespace detail {

/// Calls use(pose) for every image of a shape, along this axis and those after it, whose bounding box
/// reaches into the control volume.
template <class S>
void for_images(const PeriodicCell<S>& cell, int axis, const Aabb<S>& bounds, const Pose<S>& pose,
                const Aabb<S>& control_volume, const auto& use) {
  if (axis == S::dim) return use(pose);
  if (!cell.is_periodic(axis)) return for_images(cell, axis + 1, bounds, pose, control_volume, use);
  const typename S::Scalar length = cell.length()[axis];
  using Scalar = typename S::Scalar;
  const Scalar first = std::ceil((control_volume.lower[axis] - bounds.upper[axis]) / length);
  const Scalar last = std::floor((control_volume.upper[axis] - bounds.lower[axis]) / length);
  // The sum of a large Scalar and 1 can be the same Scalar.
  for (std::size_t k = 0; first <= last && Scalar(k) <= last - first; ++k) {
    Pose<S> image = pose;
    image.position[axis] += (first + Scalar(k)) * length;
    for_images(cell, axis + 1, bounds, image, control_volume, use);
  }
}

/// The same in a lattice, in which any image may reach into the control volume.
template <class S>
void for_images_in_lattice(const PeriodicCell<S>& cell, const Aabb<S>& bounds, const Pose<S>& pose,
                           const Aabb<S>& control_volume, const auto& use) {
  using Vector = typename S::Vector;
  const typename S::Matrix inverse = cell.vectors().inverse();
  const Vector between =
                   (control_volume.lower + control_volume.upper - bounds.lower - bounds.upper) / 2,
               reach =
                   (control_volume.upper - control_volume.lower + bounds.upper - bounds.lower) / 2,
               middle = inverse * between, spread = inverse.cwiseAbs() * reach;
  const Vector first = (middle - spread).array().ceil(), last = (middle + spread).array().floor(),
               counts = (last - first).array() + 1;
  if (!(counts.minCoeff() >= 1)) return;
  // An image after the other, counted along each vector of the cell.
  std::array<std::size_t, S::dim> at{};
  for (int axis = 0; axis < S::dim;) {
    Vector n;
    for (int k = 0; k < S::dim; ++k) n[k] = first[k] + typename S::Scalar(at[std::size_t(k)]);
    const Vector shift = cell.shift(n);
    const Aabb<S> moved{bounds.lower + shift, bounds.upper + shift};
    if (moved.overlaps(control_volume)) use(Pose<S>(pose.position + shift, pose.rotation));
    for (axis = 0; axis < S::dim; ++axis) {
      std::size_t& place = at[std::size_t(axis)];
      if (typename S::Scalar(++place) < counts[axis]) break;
      place = 0;
    }
  }
}

}  // namespace detail

/// The solid fraction of the grains of a simulation in a control volume [-]; see above. In a periodic
/// cell, all images of the grains count.
/// @param simulation     a Simulation
/// @param control_volume world axes [m]
/// @param workspace      buffers, which may be reused for the next call
template <class Simulation, class S = typename Simulation::S>
typename S::Scalar solid_fraction(const Simulation& simulation, const Aabb<S>& control_volume,
                                  ClipWorkspace<S>& workspace) {
  require_control_volume(control_volume, "solid_fraction");
  double solid = 0;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const auto& shape = simulation.shape_of_grain(k);
    const Pose<S>& pose = simulation.pose(simulation.grain(k));
    const auto add = [&](const Pose<S>& image) {
      solid += double(clipped_volume(shape, image, control_volume, workspace));
    };
    const Aabb<S> bounds = shape.bounding_box(pose);
    if (simulation.cell().is_lattice())
      detail::for_images_in_lattice(simulation.cell(), bounds, pose, control_volume, add);
    else
      detail::for_images(simulation.cell(), 0, bounds, pose, control_volume, add);
  }
  return typename S::Scalar(solid / double(volume(control_volume)));
}
/// The same with buffers of its own.
template <class Simulation, class S = typename Simulation::S>
typename S::Scalar solid_fraction(const Simulation& simulation, const Aabb<S>& control_volume) {
  ClipWorkspace<S> workspace;
  return solid_fraction(simulation, control_volume, workspace);
}

}  // namespace moreau
