// SPDX-License-Identifier: MIT
// From the full polygon of contact to a few points that carry nearly the same load.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "moreau/detect/manifold.hpp"

namespace moreau {

/// How reduce() chooses.
struct Reduction {
  /// Points within this fraction of the contact's extent of the deepest one are as deep; the first
  /// of them by key stays, so that the choice does not follow the rounding.
  double as_deep = 1e-6;
  /// The points of the step before are kept while they span this fraction of the best area.
  double keep = 0.8;
  /// Three points whose triangle is flatter than this fraction of extent squared say no more than
  /// two.
  double flat = 1e-6;
  /// Points closer together than this, and a triangle lower than this, say no more than one point,
  /// or two [m]. Two points at nearly one place make the contact problem nearly singular.
  double resolution = 0;
};

namespace detail {

/// A choice among the points of one manifold, found by going through all pairs that complete the
/// deepest point.
template <class S>
class PointChoice {
 public:
  using T = typename S::Scalar;
  using Points = std::vector<ManifoldPoint<S>>;

  PointChoice(const Points& points, const Reduction& reduction) : points_(points) {
    T deepest = points[0].gap;
    for (const auto& point : points) {
      deepest = std::min(deepest, point.gap);
      extent2_ = std::max(extent2_, (point.position - points[0].position).squaredNorm());
    }
    const T as_deep = static_cast<T>(reduction.as_deep);
    while (!(points[first_].gap <= deepest + as_deep * std::sqrt(extent2_))) ++first_;
  }

  std::size_t first() const { return first_; }
  T extent2() const { return extent2_; }
  T distance2(std::size_t i) const {
    return (points_[i].position - points_[first_].position).squaredNorm();
  }
  /// Four times the squared area of the triangle with the deepest point [m^4].
  T area2(std::size_t i, std::size_t j) const {
    const auto p = points_[i].position - points_[first_].position;
    const auto q = points_[j].position - points_[first_].position;
    const T dot = p.dot(q);
    return p.squaredNorm() * q.squaredNorm() - dot * dot;
  }
  std::size_t farthest() const {
    std::size_t best = first_;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_better(distance2(i), distance2(best))) best = i;
    return best;
  }
  std::array<std::size_t, 2> widest() const {
    std::array<std::size_t, 2> best{first_, first_};
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (std::size_t j = i + 1; j < points_.size(); ++j)
        if (is_better(area2(i, j), area2(best[0], best[1]))) best = {i, j};
    return best;
  }

 private:
  /// By more than rounding: of equals the first by key stays.
  static bool is_better(T value, T best) { return value > best * T(1 + 1e-6); }

  const Points& points_;
  std::size_t first_ = 0;
  T extent2_ = 0;
};

/// The two other points of the previous triangle, if all three are here and the deepest is one.
template <class S>
bool find_previous(const Manifold<S>& manifold, std::span<const FeatureKey> previous,
                   std::size_t deepest, std::array<std::size_t, 2>& others) {
  if (previous.size() != 3) return false;
  std::size_t count = 0;
  for (const FeatureKey key : previous) {
    std::size_t i = 0;
    while (i < manifold.points.size() && manifold.points[i].feature != key) ++i;
    if (i == manifold.points.size()) return false;
    if (i == deepest) continue;
    if (count == 2) return false;
    others[count++] = i;
  }
  return count == 2;
}

template <class S>
void keep_points(Manifold<S>& manifold, std::span<std::size_t> chosen) {
  std::sort(chosen.begin(), chosen.end());
  const auto end = std::unique(chosen.begin(), chosen.end());
  const auto count = static_cast<std::size_t>(end - chosen.begin());
  for (std::size_t k = 0; k < count; ++k) manifold.points[k] = manifold.points[chosen[k]];
  manifold.points.erase(manifold.points.begin() + static_cast<std::ptrdiff_t>(count),
                        manifold.points.end());
}

}  // namespace detail

/// Keeps at most max_points (1, 2 or 3) points: the deepest; with it the farthest from it; or the
/// two that span the largest triangle with it. The same points give the same choice; the class
/// stays that of the full contact.
/// @param previous  keys that were kept at the step before. That triangle stays while it has the
///                  deepest point and most of the best area; pass none for a choice without memory
template <class S>
void reduce(Manifold<S>& manifold, std::size_t max_points,
            std::span<const FeatureKey> previous = {}, const Reduction& reduction = {}) {
  using T = typename S::Scalar;
  if (manifold.points.size() <= max_points &&
      (reduction.resolution <= 0 || manifold.points.size() <= 1))
    return;
  const detail::PointChoice<S> choice(manifold.points, reduction);
  std::array<std::size_t, 3> chosen{choice.first(), choice.first(), choice.first()};
  const T resolution2 = static_cast<T>(reduction.resolution * reduction.resolution);
  const std::size_t farthest = choice.farthest();
  if (max_points >= 2 && choice.distance2(farthest) > resolution2) {
    chosen[1] = farthest;
    const auto widest =
        max_points >= 3 ? choice.widest() : std::array{choice.first(), choice.first()};
    const T area2 = choice.area2(widest[0], widest[1]);
    const T flat = static_cast<T>(reduction.flat) * choice.extent2();
    const T keep = static_cast<T>(reduction.keep);
    if (area2 > flat * flat && area2 > resolution2 * choice.extent2()) {
      std::array<std::size_t, 2> old;
      const bool stays = detail::find_previous(manifold, previous, choice.first(), old) &&
                         choice.area2(old[0], old[1]) >= keep * keep * area2;
      std::copy_n((stays ? old : widest).begin(), 2, chosen.begin() + 1);
    }
  }
  detail::keep_points(manifold, std::span<std::size_t>(chosen));
}

}  // namespace moreau
