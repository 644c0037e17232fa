// SPDX-License-Identifier: MIT
// The exact volume of a polytope inside an axis-aligned box.
//
// The surface of the polytope is stored as oriented rings of points: in space its faces, in the
// plane its outline. The planes of the box cut the rings one after the other:
//
//   1. Each ring is clipped. Where it leaves the kept side of the plane at a point p and returns at
//      a point q, it is closed by the segment from p to q.
//   2. In space the cut leaves a hole in the surface. The rim of the hole consists of the segments
//      from q to p. The hole is filled by triangles (apex, q, p), where apex is any point of the
//      plane, the same for all segments. The segments need not be sorted.
//
// The surface stays closed despite rounding: two neighbouring rings compute the point on their
// common edge from the same two ends in the same order, so that both get the same bits. A plane
// through vertices, edges or whole faces is therefore not a special case.
//
// The volume is a sum of signed simplices with one common corner on the surface (divergence
// theorem). Its error is a few rounding errors of the volume of the whole polytope, however small
// the volume inside the box is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/pose.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

namespace detail {

/// Closed rings of points, stored one after the other.
template <class S>
struct Rings {
  using Vector = typename S::Vector;

  std::vector<Vector> points;
  std::vector<std::size_t> ends;  ///< one past the last point of each ring

  void clear() {
    points.clear();
    ends.clear();
  }
  /// Calls use(start, end) for each ring: its points are points[start] to points[end - 1].
  void for_each_ring(const auto& use) const {
    std::size_t start = 0;
    for (const std::size_t end : ends) {
      use(start, end);
      start = end;
    }
  }
  /// Makes a ring of the points that were added after the last ring. Removes these points if there
  /// are fewer than three.
  void close() {
    const std::size_t start = ends.empty() ? 0 : ends.back();
    if (points.size() - start > 2)
      ends.push_back(points.size());
    else
      points.resize(start);
  }
};

/// The half-space side (x[axis] - limit) <= 0, where side is 1 or -1. A point is kept if it lies in
/// the half-space.
template <class S>
struct AxisPlane {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  int axis;
  Scalar side;
  Scalar limit;

  Scalar height(const Vector& x) const { return side * (x[axis] - limit); }
  bool keeps(const Vector& x) const { return height(x) <= 0; }
  /// The point at which the segment from a kept point to a cut point meets the plane.
  Vector crossing(const Vector& kept, const Vector& cut) const {
    const Scalar below = height(kept);
    Vector x = kept + below / (below - height(cut)) * (cut - kept);
    x[axis] = limit;
    return x;
  }
};

/// Fills the hole that a cut leaves in a surface. In the plane a cut leaves no hole, so this class
/// does nothing.
template <class S>
class Cap {
 public:
  explicit Cap(Rings<S>&) {}
  void add(const typename S::Vector&, const typename S::Vector&) {}
};

template <class T>
class Cap<Space<3, T>> {
 public:
  using Vector = typename Space<3, T>::Vector;

  explicit Cap(Rings<Space<3, T>>& triangles) : triangles_(triangles) {}
  /// Adds a segment of the rim: a ring leaves the kept side at p and returns to it at q.
  void add(const Vector& p, const Vector& q) {
    if (!has_apex_) apex_ = p;
    has_apex_ = true;
    if (p == q || p == apex_ || q == apex_) return;
    for (const Vector& x : {apex_, q, p}) triangles_.points.push_back(x);
    triangles_.close();
  }

 private:
  Rings<Space<3, T>>& triangles_;
  Vector apex_ = Vector::Zero();
  bool has_apex_ = false;
};

/// Appends to `kept` the part of one ring that lies on the kept side of the plane.
template <class S>
void clip_ring(std::span<const typename S::Vector> ring, const AxisPlane<S>& plane, Rings<S>& kept,
               Cap<S>& cap) {
  using Vector = typename S::Vector;
  const Vector* from = &ring.back();
  bool from_kept = plane.keeps(*from);
  // If the ring starts on the cut side, its first return belongs to its last leave.
  const bool starts_cut = !from_kept;
  bool left = false, returned = false;
  Vector leave = Vector::Zero(), first_return = Vector::Zero();
  for (const Vector& to : ring) {
    const bool to_kept = plane.keeps(to);
    if (from_kept && !to_kept) {
      leave = plane.crossing(*from, to);
      left = true;
      kept.points.push_back(leave);
    } else if (!from_kept && to_kept) {
      const Vector back = plane.crossing(to, *from);
      kept.points.push_back(back);
      if (starts_cut && !returned)
        first_return = back;
      else
        cap.add(leave, back);
      returned = true;
    }
    if (to_kept) kept.points.push_back(to);
    from = &to;
    from_kept = to_kept;
  }
  if (starts_cut && left) cap.add(leave, first_return);
  kept.close();
}

template <class S>
void clip(const Rings<S>& rings, const AxisPlane<S>& plane, Rings<S>& kept, Rings<S>& caps) {
  kept.clear();
  caps.clear();
  Cap<S> cap(caps);
  rings.for_each_ring([&](std::size_t start, std::size_t end) {
    clip_ring<S>(std::span(rings.points).subspan(start, end - start), plane, kept, cap);
  });
  const std::size_t shift = kept.points.size();
  kept.points.insert(kept.points.end(), caps.points.begin(), caps.points.end());
  for (const std::size_t end : caps.ends) kept.ends.push_back(shift + end);
}

/// Adds twice (D!) the area of a ring [m^2] to a sum. The area of a counter-clockwise ring is positive.
/// @param origin any point; one near the ring keeps rounding small
template <class T, class Vector>
void add_ring(Space<2, T>, std::span<const Vector> ring, const Vector& origin, T& doubled) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector a = ring[i] - origin;
    const Vector b = ring[i + 1 < ring.size() ? i + 1 : 0] - origin;
    doubled += a.x() * b.y() - a.y() * b.x();
  }
}

/// Adds six times (D!) the volume of the pyramid from the origin to a plane ring [m^3] to a sum. It is
/// positive if the ring is counter-clockwise, seen from the side away from the origin.
template <class T, class Vector>
void add_ring(Space<3, T>, std::span<const Vector> ring, const Vector& origin, T& sixfold) {
  // The sum of the normals of the triangles. Its length is twice the area of the ring.
  Vector normal = Vector::Zero();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    normal += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
  sixfold += (ring[0] - origin).dot(normal);
}

/// The volume inside the rings, in the plane the area [m^D]. The rings must be counter-clockwise, in
/// space seen from outside.
template <class S>
typename S::Scalar enclosed_volume(const Rings<S>& rings) {
  typename S::Scalar sum = 0;
  rings.for_each_ring([&](std::size_t start, std::size_t end) {
    const std::span<const typename S::Vector> points = rings.points;
    add_ring(S{}, points.subspan(start, end - start), points.front(), sum);
  });
  return sum / (S::dim * (S::dim - 1));  // D!
}

/// Appends the outline of a polygon as one ring.
template <class T, class Polygon>
void append_surface(const Polygon&, std::span<const typename Space<2, T>::Vector> vertices,
                    Rings<Space<2, T>>& rings) {
  rings.points.assign(vertices.begin(), vertices.end());
  rings.close();
}

/// Appends the faces of a polyhedron, one ring each.
template <class T, class Polyhedron>
void append_surface(const Polyhedron& shape, std::span<const typename Space<3, T>::Vector> vertices,
                    Rings<Space<3, T>>& rings) {
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    for (const auto vertex : shape.face(f)) rings.points.push_back(vertices[vertex]);
    rings.close();
  }
}

}  // namespace detail

/// Buffers of clipped_volume. They keep their memory from call to call, so that later calls do not
/// allocate.
template <class S>
struct ClipWorkspace {
  std::vector<typename S::Vector> vertices;  ///< vertices of the grain relative to its centre,
                                             ///< world axes [m]
  detail::Rings<S> rings;                    ///< surface of the grain
  detail::Rings<S> kept;                     ///< part of `rings` that remains after a cut
  detail::Rings<S> caps;                     ///< triangles that close the hole of a cut
};

namespace detail {

/// Rotates the vertices of a grain into world axes, stores them in workspace.vertices, and returns
/// their bounding box. All positions are relative to the grain's centre [m].
template <Polytope Shape, class S>
Aabb<S> turn_vertices(const Shape& shape, const Pose<S>& pose, ClipWorkspace<S>& workspace) {
  const typename S::Matrix rotation = pose.rotation.toRotationMatrix();
  Aabb<S> box;
  workspace.vertices.clear();
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i) {
    workspace.vertices.push_back(rotation * shape.vertices().row(i).transpose());
    box.merge(workspace.vertices.back());
  }
  return box;
}

/// The volume of the part inside the box `limits` of the body whose surface is workspace.rings, which are changed. Only
/// those planes of the box are used that cut the body.
/// @param around  bounding box of the surface [m]
/// @param limits  in the axes of the surface [m]
template <class S>
typename S::Scalar volume_between(const Aabb<S>& around, const Aabb<S>& limits,
                                  ClipWorkspace<S>& workspace) {
  using Scalar = typename S::Scalar;
  Rings<S>& rings = workspace.rings;
  const auto cut = [&](const AxisPlane<S>& plane) {
    clip(rings, plane, workspace.kept, workspace.caps);
    std::swap(rings, workspace.kept);
  };
  for (int k = 0; k < S::dim; ++k) {
    if (around.lower[k] < limits.lower[k]) cut({k, Scalar(-1), limits.lower[k]});
    if (around.upper[k] > limits.upper[k]) cut({k, Scalar(1), limits.upper[k]});
  }
  return rings.ends.empty() ? Scalar(0) : std::max(Scalar(0), enclosed_volume(rings));
}

}  // namespace detail

/// The volume of that part of a polytope which lies in a control volume; in the plane the area
/// [m^D]. The error is a few rounding errors of the volume of the whole polytope.
/// @param pose            pose of the polytope, world axes [m]
/// @param control_volume  a box in world axes [m]
/// @param workspace       buffers, which may be reused for the next call
/// @throws std::invalid_argument if the control volume is empty, inverted or not finite
template <Polytope Shape, class S = SpaceOf<Shape>>
typename S::Scalar clipped_volume(const Shape& shape, const Pose<S>& pose,
                                  const Aabb<S>& control_volume, ClipWorkspace<S>& workspace) {
  require_control_volume(control_volume, "clipped_volume");
  // All positions are relative to the grain's centre, so that a grain far from the world's origin
  // loses no digits.
  const Aabb<S> limits{control_volume.lower - pose.position, control_volume.upper - pose.position};
  const typename S::Scalar reach = shape.circumradius();
  if (limits.lower.maxCoeff() >= reach || limits.upper.minCoeff() <= -reach) return 0;
  if (limits.lower.maxCoeff() <= -reach && limits.upper.minCoeff() >= reach) return shape.volume();

  const Aabb<S> around = detail::turn_vertices(shape, pose, workspace);
  if (limits.contains(around)) return shape.volume();
  if (!limits.overlaps(around)) return 0;
  workspace.rings.clear();
  detail::append_surface(shape, std::span<const typename S::Vector>(workspace.vertices),
                         workspace.rings);
  return detail::volume_between(around, limits, workspace);
}

}  // namespace moreau
