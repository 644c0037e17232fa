// SPDX-License-Identifier: MIT
// The points of an island that lie on one face, and whether the face slides. While it slides, the friction of its points
// has given limits in place of lifts (solve/island_newton.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/solve/detail/island_points.hpp"

namespace moreau::detail {

/// The speed along the tangents of a contact [m/s], or the length of an impulse along them [N s].
template <class S>
double slip_of(const auto& rows) {
  double square = 0;
  for (int k = 1; k < S::dim; ++k) square += rows[k] * rows[k];
  return std::sqrt(square);
}

/// Contacts of two bodies that follow one another and have one normal (IslandPoints::Point::face).
struct SlidingFace {
  std::size_t last = 0;    ///< one beyond its last contact
  std::size_t points = 0;  ///< that are closed
  double sum = 0;          ///< of the pressure [N s]
  double slip = 0;         ///< of the fastest point [m/s]
  double stopped = 0;      ///< velocity that friction can change in a step, about [m/s]
  double still = 0;        ///< smaller slips are neglected [m/s]
  bool slides() const {
    constexpr double rest = 1e-3;
    return points > 1 && stopped > 0 && slip > std::max(still, rest * stopped);
  }
};

/// Whether a contact presses or is not open.
/// @param impulse,velocity of the contact, normal first [N s, m/s]
/// @param fastest of bodies that do not open a contact [m/s]
bool is_closed(const auto& impulse, const auto& velocity, double fastest) {
  return impulse[0] > 0 || velocity[0] <= fastest;
}

/// What counts as no motion at all.
struct SlidingScales {
  double fastest;  ///< as for is_closed() [m/s]
  std::span<const double>
      body;  ///< of each body of the island: the velocity that its errors are relative to [m/s]
  /// Smaller slips of a contact are neglected [m/s]: ten times the error of velocities. Without this bound every slip of a face
  /// with little pressure would count as sliding.
  double still(const auto& point) const {
    constexpr double share = 1e-4;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t k : {point.body_a, point.body_b})
      if (k < body.size()) least = std::min(least, body[k]);
    return share * least;
  }
};

/// The face that begins with a contact.
/// @param points            of the island
/// @param impulse,velocity  of each contact [N s, m/s]
template <class S, class Point, class Vector>
MOREAU_INLINED inline SlidingFace find_face(std::span<const Point> points,
                                            std::span<const Vector> impulse,
                                            std::span<const Vector> velocity,
                                            const SlidingScales& scales, std::size_t first) {
  SlidingFace face;
  face.still = scales.still(points[first]);
  double mobility = 0;
  for (std::size_t k = first; k < points.size() && points[k].face == points[first].face; ++k) {
    const Point& point = points[k];
    face.last = k + 1;
    if (!is_closed(impulse[k], velocity[k], scales.fastest)) continue;
    ++face.points;
    face.sum += impulse[k][0];
    face.slip = std::max(face.slip, slip_of<S>(velocity[k]));
    mobility = std::max(
        mobility, point.friction * (point.a.row(1).squaredNorm() + point.b.row(1).squaredNorm()));
  }
  face.stopped = mobility * face.sum;
  return face;
}

/// Counts the points on faces of two points and more that slide.
template <class S, class Point, class Vector>
MOREAU_INLINED inline std::size_t count_sliding(std::span<const Point> points,
                                                std::span<const Vector> impulse,
                                                std::span<const Vector> velocity,
                                                const SlidingScales& scales) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < points.size();) {
    const SlidingFace face = find_face<S>(points, impulse, velocity, scales, first);
    if (face.slides()) count += face.points;
    first = face.last;
  }
  return count;
}

/// Makes the pressure of each face uniform. Its sum remains. The friction of a face that slides is on its limit.
/// @param impulse in, out: of each contact [N s]
/// @param limit   out: mu r_n of each contact [N s]
template <class S, class Point, class Vector>
MOREAU_INLINED inline void make_even(std::span<const Point> points,
                                     std::span<const Vector> velocity, const SlidingScales& scales,
                                     std::span<Vector> impulse, std::span<double> limit) {
  for (std::size_t first = 0, last; first < points.size(); first = last) {
    const SlidingFace face =
        find_face<S>(points, std::span<const Vector>(impulse), velocity, scales, first);
    last = face.last;
    for (std::size_t k = first; k < last; ++k) {
      if (face.points > 1)
        impulse[k][0] =
            is_closed(impulse[k], velocity[k], scales.fastest) ? face.sum / double(face.points) : 0;
      limit[k] = points[k].friction * impulse[k][0];
      if (!face.slides()) continue;
      const double slip = slip_of<S>(velocity[k]);
      for (int i = 1; i < S::dim; ++i)
        impulse[k][i] = slip > 0 ? -limit[k] * velocity[k][i] / slip : 0;
    }
  }
}

/// The response of a contact whose friction has a given limit (Tresca's law).
/// @param s compliances in series [1/kg]
/// @param b velocity without an impulse [m/s]
template <class S>
MOREAU_INLINED inline ContactResponse<S::dim> response_within(
    double limit, const Eigen::Matrix<double, S::dim, 1>& s,
    const Eigen::Matrix<double, S::dim, 1>& b) {
  ContactResponse<S::dim> answer;
  auto& [r, stiffness] = answer;
  double square = 0;
  for (int i = 0; i < S::dim; ++i) r[i] = -b[i] / s[i];
  for (int i = 1; i < S::dim; ++i) square += r[i] * r[i];
  stiffness.setZero();
  stiffness(0, 0) = r[0] > 0 ? 1 / s[0] : 0;
  r[0] = std::max(0.0, r[0]);
  const double length = std::sqrt(square), share = length > limit ? limit / length : 1;
  for (int i = 1; i < S::dim; ++i) {
    stiffness(i, i) = share / s[i];
    if (share < 1)
      for (int j = 1; j < S::dim; ++j) stiffness(i, j) -= share / s[i] * r[i] * r[j] / square;
  }
  for (int i = 1; i < S::dim; ++i) r[i] *= share;
  return answer;
}

}  // namespace moreau::detail
