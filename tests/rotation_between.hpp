// SPDX-License-Identifier: MIT
// The rotation from one direction to another. Eigen's FromTwoVectors gives the same by a singular value
// decomposition, which takes a compiler seconds in every unit.
#pragma once

#include <Eigen/Geometry>

#include <cmath>

/// The shortest rotation that turns the direction of a into that of b; they are not opposite.
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d axis = a.cross(b);
  return Eigen::Quaterniond(std::sqrt(a.squaredNorm() * b.squaredNorm()) + a.dot(b), axis.x(),
                            axis.y(), axis.z())
      .normalized();
}
