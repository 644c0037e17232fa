// SPDX-License-Identifier: MIT
// From the full polygon of contact to a few points that carry nearly the same load.
//
// Three points carry what presses on their triangle. A pressure that wants to leave it, beyond one
// of its sides, tips the bodies about that side, until a point that was left out penetrates. It is
// taken in then, with those two others with which the bodies would come to rest under the pressure
// as it was: of all triangles that hold it the lowest. The load can move on to it, and the tipping
// ends. Chosen by area alone, the triangle loses the pressure again, and the bodies rock for ever.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "moreau/detect/manifold.hpp"

namespace moreau {

/// How reduce() chooses. Shares are of the size of the contact [-], lengths in [m].
struct Reduction {
  /// Points within this fraction of the contact's extent of the deepest one [-] are as deep; the
  /// first of them by key stays, so that the choice does not follow the rounding.
  double as_deep = 1e-6;
  /// The points of the step before are kept while they span this fraction of the best area [-].
  double keep = 0.8;
  /// Three points whose triangle is flatter than this fraction of extent squared [-] say no more
  /// than two.
  double flat = 1e-6;
  /// Points closer together than this, and a triangle lower than this, say no more than one point,
  /// or two [m]. Two points at nearly one place make the contact problem nearly singular.
  double resolution = 0;
  /// The points of the step before may all be so much shallower than the deepest one [m].
  double shallower = 0;
  /// Where three points are no farther above the deepest one than this, the others, which are open,
  /// are not asked [m].
  double near = std::numeric_limits<double>::infinity();
};

/// A point that was kept at the step before.
struct KeptPoint {
  FeatureKey feature;  ///< of the point
  double push = 0;     ///< normal impulse that it carried, >= 0 [N s]
};

namespace detail {

/// Four times the squared area of a triangle [m^4].
template <class S>
typename S::Scalar area2(const ManifoldPoint<S>& a, const ManifoldPoint<S>& b,
                         const ManifoldPoint<S>& c) {
  const typename S::Vector p = b.position - a.position, q = c.position - a.position;
  const typename S::Scalar dot = p.dot(q);
  return p.squaredNorm() * q.squaredNorm() - dot * dot;
}

/// A choice among the points of one manifold, found by going through all pairs that complete the
/// deepest point.
template <class S>
class PointChoice {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Points = std::vector<ManifoldPoint<S>>;

  PointChoice(const Points& points, std::span<const KeptPoint> previous, const Reduction& reduction)
      : points_(points) {
    T deepest = points[0].gap;
    for (const auto& point : points) {
      deepest = std::min(deepest, point.gap);
      extent2_ = std::max(extent2_, (point.position - points[0].position).squaredNorm());
    }
    equal_ = static_cast<T>(reduction.as_deep) * std::sqrt(extent2_);
    while (!(points[first_].gap <= deepest + equal_)) ++first_;
    nearly_ = std::max(equal_, static_cast<T>(reduction.shallower));
    highest_ = deepest + static_cast<T>(reduction.near);
    if (std::count_if(points.begin(), points.end(), [&](const auto& p) { return is_near(p); }) < 3)
      highest_ = std::numeric_limits<T>::infinity();
    find_pressure(previous);
  }

  std::size_t first() const { return first_; }
  T extent2() const { return extent2_; }
  T distance2(std::size_t i) const {
    return (points_[i].position - points_[first_].position).squaredNorm();
  }
  T area2(std::size_t i, std::size_t j) const {
    return detail::area2(points_[first_], points_[i], points_[j]);
  }
  std::size_t farthest() const {
    std::size_t best = first_;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_better(distance2(i), distance2(best))) best = i;
    return best;
  }
  /// The triangle with the deepest point on which the bodies come to rest under the pressure: of
  /// those that hold it the lowest there; of equals, as where the pressure lies on a side, the one
  /// whose corners close first; of equals again the widest. If none holds it, the widest.
  std::array<std::size_t, 2> best() const {
    std::array<std::size_t, 2> best{first_, first_};
    T lowest = std::numeric_limits<T>::infinity(), closest = lowest;
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (std::size_t j = i + 1; j < points_.size(); ++j) {
        if (!is_near(points_[i]) || !is_near(points_[j])) continue;
        const T height = height_of_pressure(i, j);
        const T open = loaded_ ? std::max(points_[i].gap, points_[j].gap) : T(0);
        const int order =
            ordered(height, lowest) != 0 ? ordered(height, lowest) : ordered(open, closest);
        if (order > 0 || (order == 0 && !is_better(area2(i, j), area2(best[0], best[1])))) continue;
        best = {i, j};
        lowest = height;
        closest = open;
      }
    return best;
  }

 private:
  /// By more than rounding: of equals the first by key stays.
  static bool is_better(T value, T best) { return value > best * T(1 + 1e-6); }
  /// -1, 0 or 1: whether a gap is smaller, nearly equal, or larger.
  int ordered(T gap, T other) const {
    return gap < other - nearly_ ? -1 : (gap > other + nearly_ ? 1 : 0);
  }
  bool is_near(const ManifoldPoint<S>& point) const { return point.gap <= highest_; }

  /// Where the points of the step before, at their places of now, carried the load.
  void find_pressure(std::span<const KeptPoint> previous) {
    T sum = 0;
    for (const KeptPoint& old : previous)
      for (const auto& point : points_) {
        if (point.feature != old.feature) continue;
        sum += static_cast<T>(old.push);
        pressure_ += static_cast<T>(old.push) * (point.position - points_[first_].position);
      }
    loaded_ = sum > 0;
    if (loaded_) pressure_ /= sum;
  }
  /// Gap between the bodies at the pressure as the triangle with the deepest point has it; infinite
  /// if the pressure lies more than a little beside it.
  T height_of_pressure(std::size_t i, std::size_t j) const {
    constexpr T beside = T(0.02), infinity = std::numeric_limits<T>::infinity();
    if (!loaded_) return infinity;
    const Vector p = points_[i].position - points_[first_].position;
    const Vector q = points_[j].position - points_[first_].position;
    const T pp = p.squaredNorm(), qq = q.squaredNorm(), pq = p.dot(q), area = pp * qq - pq * pq;
    if (!(area > 0)) return infinity;
    const T a = (qq * p.dot(pressure_) - pq * q.dot(pressure_)) / area;
    const T b = (pp * q.dot(pressure_) - pq * p.dot(pressure_)) / area;
    if (!(a >= -beside && b >= -beside && a + b <= 1 + beside)) return infinity;
    return (1 - a - b) * points_[first_].gap + a * points_[i].gap + b * points_[j].gap;
  }

  const Points& points_;
  std::size_t first_ = 0;
  T extent2_ = 0, equal_ = 0, nearly_ = 0, highest_ = 0;
  Vector pressure_ = Vector::Zero();  ///< its centre, from the deepest point [m]
  bool loaded_ = false;
};

/// The triangle of the step before, if all of it is here and one point is deep enough.
/// @param lowest gap that counts as such [m]
template <class S>
bool find_previous(const Manifold<S>& manifold, std::span<const KeptPoint> previous,
                   typename S::Scalar lowest, std::array<std::size_t, 3>& triangle) {
  if (previous.size() != 3) return false;
  bool deep = false;
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t& i = triangle[k] = 0;
    while (i < manifold.points.size() && manifold.points[i].feature != previous[k].feature) ++i;
    if (i == manifold.points.size()) return false;
    deep = deep || manifold.points[i].gap <= lowest;
  }
  return deep;
}

/// Whether all points push: the pressure lies within them.
inline bool carries(std::span<const KeptPoint> previous) {
  return std::all_of(previous.begin(), previous.end(),
                     [](const KeptPoint& point) { return point.push > 0; });
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
/// two that span with it the lowest triangle under the previous pressure, or without one the
/// widest. The same points and the same memory give the same choice; the class stays that of the
/// full contact.
/// @param manifold   in: all points, sorted by feature; out: those that are kept, in that order
/// @param max_points 1, 2 or 3
/// @param previous   what was kept at the step before. That triangle stays while it has one of the
///                   deepest points and all of it pushes, or has most of the best area; pass none
///                   for a choice without memory
/// @param reduction  how to choose
template <class S>
void reduce(Manifold<S>& manifold, std::size_t max_points, std::span<const KeptPoint> previous = {},
            const Reduction& reduction = {}) {
  using T = typename S::Scalar;
  const auto& points = manifold.points;
  if (points.size() <= max_points && (reduction.resolution <= 0 || points.size() <= 1)) return;
  const detail::PointChoice<S> choice(points, previous, reduction);
  std::array<std::size_t, 3> chosen{choice.first(), choice.first(), choice.first()};
  const T resolution2 = static_cast<T>(reduction.resolution * reduction.resolution);
  const std::size_t farthest = choice.farthest();
  if (max_points >= 2 && choice.distance2(farthest) > resolution2) {
    chosen[1] = farthest;
    const auto best = max_points >= 3 ? choice.best() : std::array{choice.first(), choice.first()};
    const T area2 = choice.area2(best[0], best[1]);
    const T flat = static_cast<T>(reduction.flat) * choice.extent2();
    const T keep = static_cast<T>(reduction.keep);
    if (area2 > flat * flat && area2 > resolution2 * choice.extent2()) {
      const T lowest = points[choice.first()].gap + static_cast<T>(reduction.shallower);
      std::array<std::size_t, 3> old;
      const bool stays =
          detail::find_previous(manifold, previous, lowest, old) &&
          (detail::carries(previous) ||
           detail::area2(points[old[0]], points[old[1]], points[old[2]]) >= keep * keep * area2);
      chosen = stays ? old : std::array{choice.first(), best[0], best[1]};
    }
  }
  detail::keep_points(manifold, std::span<std::size_t>(chosen));
}

}  // namespace moreau
