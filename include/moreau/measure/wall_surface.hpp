// SPDX-License-Identifier: MIT
// The parts of the walls of a simulation that are near its grains, as faces to draw.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/world/body_access.hpp"

namespace moreau::detail {

/// One wall. A face is a list of points in world axes [m]: two points are a segment of a line (in
/// the plane), more are a polygon, counter-clockwise seen from the grains.
template <class S>
struct WallSurface {
  BodyId body;
  std::vector<std::vector<typename S::Vector>> faces;
  /// Lines to draw in place of the edges of the faces: the convex ridges and the rim of a mesh wall.
  std::vector<std::vector<typename S::Vector>> lines = {};
};

/// The pose of a grain at its place in the periodic cell.
template <class Simulation>
Pose<typename Simulation::S> pose_in_cell(const Simulation& simulation, BodyId grain) {
  Pose<typename Simulation::S> pose = simulation.pose(grain);
  pose.position = simulation.cell().wrap(pose.position);
  return pose;
}

/// The bounding box of all grains [m], each at its place in the periodic cell; empty without
/// grains.
template <class Simulation>
Aabb<typename Simulation::S> box_of_grains(const Simulation& simulation) {
  Aabb<typename Simulation::S> box;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const auto own =
        simulation.shape_of_grain(k).bounding_box(pose_in_cell(simulation, simulation.grain(k)));
    box.merge(own.lower);
    box.merge(own.upper);
  }
  return box;
}

/// The corners of a box.
template <class S>
std::vector<typename S::Vector> corners_of(const Aabb<S>& box) {
  std::vector<typename S::Vector> corners;
  for (unsigned bits = 0; bits < 1u << S::dim; ++bits) {
    typename S::Vector& x = corners.emplace_back(box.lower);
    for (int k = 0; k < S::dim; ++k)
      if ((bits >> k & 1u) != 0) x[k] = box.upper[k];
  }
  return corners;
}

/// The least and the largest coordinate of points along a direction, counted from `origin`.
template <class Vector>
std::pair<typename Vector::Scalar, typename Vector::Scalar> range_along(
    const Vector& direction, const std::type_identity_t<Vector>& origin,
    const std::vector<Vector>& points) {
  auto range = std::pair(direction.dot(points[0] - origin), direction.dot(points[0] - origin));
  for (const Vector& x : points) {
    range.first = std::min(range.first, direction.dot(x - origin));
    range.second = std::max(range.second, direction.dot(x - origin));
  }
  return range;
}

/// The part of a convex face on the side normal . (x - point) >= -tolerance of a plane
/// (Sutherland-Hodgman).
template <class Vector>
std::vector<Vector> clipped(const std::vector<Vector>& face, const Vector& normal,
                            const std::type_identity_t<Vector>& point,
                            typename Vector::Scalar tolerance) {
  std::vector<Vector> inside;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vector &a = face[k], &b = face[(k + 1) % face.size()];
    const auto from = normal.dot(a - point) + tolerance, to = normal.dot(b - point) + tolerance;
    if (from >= 0) inside.push_back(a);
    const bool is_edge = k + 1 < face.size() || face.size() > 2;  // a segment has a single edge
    if (is_edge && (from >= 0) != (to >= 0)) inside.push_back(a + from / (from - to) * (b - a));
  }
  return inside;
}

/// The projection of a box onto the plane of a half-space, as one face.
template <class S>
std::vector<typename S::Vector> project(const std::vector<typename S::Vector>& corners,
                                        const Pose<S>& wall) {
  using Vector = typename S::Vector;
  const typename S::Matrix frame = wall.rotation.toRotationMatrix();  // normal, tangents
  std::vector<Vector> face{wall.position};
  for (int k = 1; k < S::dim; ++k) {
    const Vector tangent = frame.col(k);
    const auto [low, high] = range_along(tangent, wall.position, corners);
    const std::vector<Vector> before = face;
    for (Vector& x : face) x += low * tangent;
    for (std::size_t i = before.size(); i-- > 0;) face.push_back(before[i] + high * tangent);
  }
  return face;
}

/// The faces of a cylinder wall: 64 strips, as long as the box; in the plane 64 segments.
template <class S>
std::vector<std::vector<typename S::Vector>> cylinder_faces(
    const std::vector<typename S::Vector>& corners, const Pose<S>& pose,
    const CylinderWall<S>& shape) {
  using Vector = typename S::Vector;
  using Scalar = typename S::Scalar;
  const typename S::Angular axis = shape.axis_at(pose.rotation);
  // A turn about the axis annihilates the direction of the axis. In the plane there is no such
  // direction, and `along` stays zero.
  Vector across = Vector::Zero(), along = Vector::Zero();
  for (int k = 0; k < S::dim; ++k) {
    const Vector e = Vector::Unit(k), turned = S::spin(axis, e);
    if (turned.norm() > across.norm()) across = turned;
    const Vector rest = e + S::spin(axis, turned);
    if (rest.norm() > std::max(along.norm(), Scalar(1e-3))) along = rest;
  }
  across.normalize();
  along = along.isZero(0) ? along : along.normalized();
  const Vector side = S::spin(axis, across);
  const auto [low, high] = range_along(along, pose.position, corners);
  const Vector center = pose.position + low * along;
  constexpr int count = 64;
  const auto rim = [&](int k) -> Vector {
    const Scalar angle = 2 * std::numbers::pi_v<Scalar> * Scalar(k % count) / count;
    return center + shape.radius() * (std::cos(angle) * across + std::sin(angle) * side);
  };
  const Vector length = (high - low) * along;
  std::vector<std::vector<Vector>> faces;
  for (int k = 0; k < count; ++k) {
    auto& face = faces.emplace_back(std::vector<Vector>{rim(k), rim(k + 1)});
    if (!length.isZero(0)) face.insert(face.end(), {rim(k + 1) + length, rim(k) + length});
  }
  return faces;
}

/// The facets of a mesh wall, and its convex ridges.
template <class S>
WallSurface<S> mesh_surface(const MeshBody<S>& mesh, const Pose<S>& pose) {
  WallSurface<S> surface{mesh.body, {}, {}};
  const auto add = [&](auto& list, const auto& vertices) {
    auto& points = list.emplace_back();
    for (const std::uint32_t v : vertices) points.push_back(pose(mesh.shape.vertex(v)));
  };
  for (const auto& facet : mesh.shape.mesh().facets) add(surface.faces, facet);
  for (std::size_t r = 0; r < mesh.shape.ridge_count(); ++r)
    add(surface.lines, mesh.shape.ridge(r).vertices);
  return surface;
}

/// The walls of a simulation near its grains. Mesh walls are drawn as they are. A half-space is drawn as far as the bounding box of
/// the grains, extended by a grain size, reaches along it, and ends at the other half-spaces. A
/// half-space farther from the grains than the diagonal of this box is left out. Without grains
/// there are mesh walls only.
template <class Simulation>
std::vector<WallSurface<typename Simulation::S>> wall_surfaces(const Simulation& simulation) {
  using S = typename Simulation::S;
  std::vector<WallSurface<S>> surfaces;
  const auto add_meshes = [&] {
    for (const MeshBody<S>& mesh : simulation.mesh_walls())
      surfaces.push_back(mesh_surface<S>(mesh, simulation.pose(mesh.body)));
  };
  if (simulation.grain_count() == 0) {
    add_meshes();
    return surfaces;
  }
  const Aabb<S> box = box_of_grains(simulation).inflated(simulation.grain_size());
  const auto corners = corners_of(box);
  const auto diagonal = (box.upper - box.lower).norm();
  const auto normal_of = [&](BodyId wall) ->
      typename S::Vector { return simulation.pose(wall).rotation.toRotationMatrix().col(0); };
  for (const BodyId wall : simulation.walls()) {
    const auto [near, far] = range_along(normal_of(wall), simulation.pose(wall).position, corners);
    if (near > diagonal || far < 0) continue;
    auto face = project<S>(corners, simulation.pose(wall));
    for (const BodyId other : simulation.walls())
      if (other != wall && face.size() > 1)
        face = clipped(face, normal_of(other), simulation.pose(other).position,
                       typename S::Scalar(1e-6) * diagonal);
    if (face.size() > 1) surfaces.push_back({wall, {face}});
  }
  for (const CylinderBody<S>& cylinder : simulation.cylinders())
    surfaces.push_back({cylinder.body, cylinder_faces<S>(corners, simulation.pose(cylinder.body),
                                                         cylinder.shape)});
  add_meshes();
  return surfaces;
}

}  // namespace moreau::detail
