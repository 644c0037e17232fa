// SPDX-License-Identifier: MIT
// The rotation from one direction to another. Eigen's FromTwoVectors gives the same by a singular value
// decomposition, which takes a compiler seconds in every unit.
#pragma once

#include <Eigen/Geometry>

#include <cmath>

/// A shortest rotation that turns the direction of a into that of b.
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d axis = a.cross(b);
  if (a.dot(b) < 0 && axis.squaredNorm() <= 1e-24 * a.squaredNorm() * b.squaredNorm()) {
    axis = a.unitOrthogonal();  // opposite: half a turn
    return Eigen::Quaterniond(0, axis.x(), axis.y(), axis.z());
  }
  return Eigen::Quaterniond(std::sqrt(a.squaredNorm() * b.squaredNorm()) + a.dot(b), axis.x(),
                            axis.y(), axis.z())
      .normalized();
}
