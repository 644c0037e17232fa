// SPDX-License-Identifier: MIT
// Moves the vertices of a polyhedron so that its faces are planes. The points of a file have the rounding of its digits: the
// four corners of a face of a cube do not lie in one plane. Contact detection takes a face for a plane.
//
// In turn, the plane of each face with more than three corners is fitted to its corners, and each vertex is moved to the
// planes of its faces by the shortest way. Where three faces meet, as in cubes, prisms and dodecahedra, the second step leaves
// planes exactly, and the iteration ends.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "moreau/shape/detail/face_plane.hpp"

namespace moreau::detail {

/// Moves a point to planes, each with the point moved within those before. A plane that those before determine up to an
/// angle of 0.01 is left out.
class MoveToPlanes {
 public:
  explicit MoveToPlanes(Eigen::Vector3d& point) : point_(point) {}

  void move(const FacePlane<Eigen::Vector3d>& plane) {
    constexpr double least = 0.01;
    Eigen::Vector3d along = plane.normal;
    for (int k = 0; k < count_; ++k) along -= axes_[k].dot(along) * axes_[k];
    const double length = along.norm();
    if (count_ == 3 || length < least) return;
    point_ -= along * (plane.normal.dot(point_ - plane.center) / (length * length));
    axes_[count_++] = along / length;
  }

 private:
  Eigen::Vector3d& point_;
  Eigen::Vector3d axes_[3];
  int count_ = 0;
};

/// Makes the faces planes.
/// @param faces  cyclic lists of points, counter-clockwise seen from outside
/// @param points in, out: [m]
/// @param most   no point may move farther than this [m]
/// @returns whether all faces are planes to the rounding of the coordinates; if not, the points have no meaning
inline bool flatten_faces(std::span<const std::vector<std::uint32_t>> faces,
                          std::vector<Eigen::Vector3d>& points, double most) {
  constexpr int most_rounds = 100;
  const std::vector<Eigen::Vector3d> given = points;
  double size = 0;
  for (const auto& x : points) size = std::max(size, x.cwiseAbs().maxCoeff());
  const double flat = 8 * std::numeric_limits<double>::epsilon() * size;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<MoveToPlanes> moves(points.begin(), points.end());
    double farthest = 0;
    std::vector<FacePlane<Eigen::Vector3d>> planes;
    for (const auto& face : faces)
      planes.push_back(
          face_plane<Eigen::Vector3d>(face.size(), [&](std::size_t k) { return points[face[k]]; }));
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (faces[f].size() == 3) continue;  // it is a plane wherever its corners are
      for (const std::uint32_t v : faces[f]) {
        farthest = std::max(farthest, std::abs(planes[f].normal.dot(points[v] - planes[f].center)));
      }
    }
    if (farthest <= flat) return true;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].size() > 3)
        for (const std::uint32_t v : faces[f]) moves[v].move(planes[f]);
    for (std::size_t v = 0; v < points.size(); ++v)
      if (!((points[v] - given[v]).norm() <= most)) return false;
  }
  return false;
}

}  // namespace moreau::detail
