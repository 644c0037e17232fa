// SPDX-License-Identifier: MIT
// The velocities that the errors of the bodies of an island are relative to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// One velocity per body of an island: set_least(), then find() for each motion. Keeps its memory.
/// @tparam Points IslandPoints
template <class Points>
class IslandScales {
 public:
  using Vector = typename Points::Vector;
  using Coordinates = typename Points::Coordinates;

  void make_room(std::size_t bodies) {
    least_.resize(bodies);
    scale_.resize(bodies);
  }
  /// @param least_of function: body of the problem -> velocity that its errors are relative to at least [m/s]
  void set_least(const Points& points, const auto& least_of) {
    for (std::size_t i = 0; i < least_.size(); ++i) least_[i] = least_of(points.body(i));
  }
  /// Sets the velocity of each body: the sum of the velocities that its contacts give to it, at most `most`, at least that
  /// of set_least(). A light body can be much faster than its neighbours, and impulses that bear a heavy one would each
  /// move it much faster than all of them together.
  /// @param impulses,others of the contacts; the larger of the two counts [N s]
  /// @param most [m/s]
  void find(const Points& points, std::span<const Vector> impulses, std::span<const Vector> others,
            double most) {
    std::fill(scale_.begin(), scale_.end(), 0);
    for (std::size_t k = 0; k < impulses.size(); ++k) {
      const auto& point = points.points()[k];
      const double push = std::max(impulses[k].norm(), others[k].norm());
      if (point.body_a != Points::none) scale_[point.body_a] += push * point.mobility_a;
      if (point.body_b != Points::none) scale_[point.body_b] += push * point.mobility_b;
    }
    for (std::size_t i = 0; i < scale_.size(); ++i)
      scale_[i] = std::max(least_[i], std::min(most, scale_[i] * points.speed(i)));
  }

  std::span<const double> all() const { return scale_; }  ///< one per body of the island [m/s]
  /// 0 for a body that is not in the island [m/s].
  double of(std::uint32_t body) const { return body == Points::none ? 0 : scale_[body]; }
  /// The largest velocity of set_least(), at least `most` [m/s].
  double largest_least(double most) const {
    for (const double least : least_) most = std::max(most, least);
    return most;
  }
  /// Velocity of a body for the length of its y, relative to the velocity of find() [-].
  double relative(const Points& points, std::uint32_t body, double length) const {
    return body == Points::none || length == 0 ? 0 : length * points.speed(body) / scale_[body];
  }
  /// The largest of the bodies in a motion [-].
  double relative(const Points& points, std::span<const Coordinates> motion) const {
    double largest = 0;
    for (std::size_t i = 0; i < motion.size(); ++i)
      largest = std::max(largest, relative(points, std::uint32_t(i), motion[i].norm()));
    return largest;
  }

 private:
  List<double> least_, scale_;  // one per body [m/s]
};

/// Largest velocity of a body in a motion of an island [m/s].
template <class Points>
double fastest_in(const Points& points, std::span<const typename Points::Coordinates> motion) {
  double largest = 0;
  for (std::size_t i = 0; i < motion.size(); ++i)
    largest = std::max(largest, motion[i].norm() * points.speed(i));
  return largest;
}

}  // namespace moreau::detail
