// SPDX-License-Identifier: MIT
// The points of an island that lie on one face, and whether the face slides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "moreau/core/compiled_once.hpp"

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
  bool slides() const {
    constexpr double rest = 1e-3;
    return points > 1 && stopped > 0 && slip > rest * stopped;
  }
};

/// Whether a contact presses or is not open.
/// @param impulse,velocity of the contact, normal first [N s, m/s]
/// @param fastest of bodies that do not open a contact [m/s]
bool is_closed(const auto& impulse, const auto& velocity, double fastest) {
  return impulse[0] > 0 || velocity[0] <= fastest;
}

/// The face that begins with a contact.
/// @param points            of the island
/// @param impulse,velocity  of each contact [N s, m/s]
/// @param fastest           as for is_closed()
template <class S, class Point, class Vector>
MOREAU_INLINED inline SlidingFace find_face(std::span<const Point> points,
                                            std::span<const Vector> impulse,
                                            std::span<const Vector> velocity, double fastest,
                                            std::size_t first) {
  SlidingFace face;
  double mobility = 0;
  for (std::size_t k = first; k < points.size() && points[k].face == points[first].face; ++k) {
    const Point& point = points[k];
    face.last = k + 1;
    if (!is_closed(impulse[k], velocity[k], fastest)) continue;
    ++face.points;
    face.sum += impulse[k][0];
    face.slip = std::max(face.slip, slip_of<S>(velocity[k]));
    mobility = std::max(
        mobility, point.friction * (point.a.row(1).squaredNorm() + point.b.row(1).squaredNorm()));
  }
  face.stopped = mobility * face.sum;
  return face;
}

}  // namespace moreau::detail
