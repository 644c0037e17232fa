// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>

namespace moreau {

/// The plane of a face of a polyhedron, in the coordinates of the polyhedron's vertices.
/// @tparam Vector a vector of Eigen, or detail::LongVector
template <class Vector>
struct FacePlane {
  using T = typename Vector::Scalar;  ///< scalar of the vectors

  Vector center = Vector::Zero();  ///< mean of the vertices [m]
  Vector axis = Vector::Zero();    ///< unit, from the center to the farthest vertex: the long
                                   ///< direction of the face
  Vector normal = Vector::Zero();  ///< unit, outward
  T width = 0;  ///< approximate width perpendicular to the axis: area / length [m]
};

/// The plane through the mean of a polygon's vertices, perpendicular to its area vector. The area
/// vector of a sliver is a small difference of large products. The component of its error along the
/// sliver would tilt the plane most. So the normal is made orthogonal to the long axis.
/// @param count number of vertices, >= 3; not checked
/// @param at    function: k -> vertex k [m], for k < count; counter-clockwise seen from outside
template <class Vector, class At>
FacePlane<Vector> face_plane(std::size_t count, const At& at) {
  using T = typename Vector::Scalar;
  FacePlane<Vector> plane;
  for (std::size_t k = 0; k < count; ++k) plane.center += at(k);
  plane.center /= static_cast<T>(count);
  Vector area = Vector::Zero(), longest = Vector::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector x = at(k) - plane.center;
    area += x.cross(at(k + 1 == count ? 0 : k + 1) - plane.center) / T(2);
    if (x.squaredNorm() > longest.squaredNorm()) longest = x;
  }
  plane.axis = longest.normalized();
  plane.normal = Vector(area - Vector(plane.axis * plane.axis.dot(area))).normalized();
  plane.width = area.norm() / longest.norm();
  return plane;
}

}  // namespace moreau
