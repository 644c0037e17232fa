// SPDX-License-Identifier: MIT
// reduce: reduces the contact points of a pair to at most three that carry nearly the same load.
//
// Three points can carry a load if its centre of pressure lies in their triangle. If the centre of
// pressure moves beyond a side of the triangle, the bodies tip about that side until a point that
// was left out penetrates. This point is now the deepest one and is chosen. The two points chosen
// with it are those on which the bodies would come to rest under the load of the previous step.
// They are found so: among all triangles that have the deepest point as a corner and contain the
// centre of pressure, take the triangle with the smallest gap at the centre of pressure. The load
// can then move to the new point, and the tipping ends. A choice by the area of the triangle alone
// would lose the centre of pressure again, and the bodies would rock for ever.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/detect/manifold.hpp"

namespace moreau {

/// Parameters of reduce(). Fractions [-] are relative to the extent of the contact: the distance of
/// the farthest contact point from the first one. Lengths are in [m].
struct Reduction {
  /// Points whose gap exceeds the smallest gap by at most this fraction of the extent count as
  /// deepest [-]. Among them the point with the first feature key is chosen, so that the choice
  /// does not depend on rounding.
  double as_deep = 1e-6;
  /// The triangle of the previous step is kept while its area is at least this fraction of the area
  /// of the best triangle [-].
  double keep = 0.8;
  /// A triangle counts as two points if twice its area is at most this fraction of the square of
  /// the extent [-].
  double flat = 1e-6;
  /// Two points closer together than this length count as one point, and a triangle with a smaller
  /// height counts as two points [m]. Two points at nearly the same place make the contact problem
  /// nearly singular.
  double resolution = 0;
  /// The points of the previous step are kept only if the gap of at least one of them exceeds the
  /// smallest gap by at most this length [m].
  double shallower = 0;
  /// If the gaps of three points or more exceed the smallest gap by at most this length [m], all
  /// other points are ignored, because their gaps are open.
  double near = std::numeric_limits<double>::infinity();
};

/// A contact point that was kept in the previous step.
struct KeptPoint {
  FeatureKey feature;  ///< the features that make the point
  double push = 0;     ///< normal impulse of the point in the previous step, >= 0 [N s]
};

namespace detail {

/// Four times the square of the area of a triangle [m^4].
template <class S>
typename S::Scalar area2(const ManifoldPoint<S>& a, const ManifoldPoint<S>& b,
                         const ManifoldPoint<S>& c) {
  const typename S::Vector p = b.position - a.position, q = c.position - a.position;
  const typename S::Scalar dot = p.dot(q);
  return p.squaredNorm() * q.squaredNorm() - dot * dot;
}

/// Selects points of one manifold: the deepest point, and two more points, which are found by
/// comparing all pairs.
template <class S>
class PointChoice {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Points = List<ManifoldPoint<S>>;

  explicit PointChoice(const Points& points) : points_(points) {}

  /// Finds the deepest point and the centre of pressure. Call it before all other functions.
  void update(std::span<const KeptPoint> previous, const Reduction& reduction) {
    T deepest = points_[0].gap;
    for (const auto& point : points_) {
      deepest = std::min(deepest, point.gap);
      extent2_ = std::max(extent2_, (point.position - points_[0].position).squaredNorm());
    }
    equal_ = static_cast<T>(reduction.as_deep) * std::sqrt(extent2_);
    while (!(points_[first_].gap <= deepest + equal_)) ++first_;
    nearly_ = std::max(equal_, static_cast<T>(reduction.shallower));
    highest_ = deepest + static_cast<T>(reduction.near);
    if (std::count_if(points_.begin(), points_.end(), [&](const auto& p) { return is_near(p); }) <
        3)
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
  /// The two points that form the best triangle with the deepest point. If there was a load in the
  /// previous step, the criteria are, in this order:
  ///   1. the smallest gap at the centre of pressure, among triangles that contain it;
  ///   2. if these gaps are nearly equal, for example because the centre of pressure lies on a side
  ///      of two triangles, the triangle whose largest gap is smallest;
  ///   3. if these are nearly equal too, the largest area.
  /// A triangle that does not contain the centre of pressure has an infinite gap in criterion 1.
  /// Without a previous load the triangle of largest area is chosen.
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
  /// Whether a value exceeds the best value by more than rounding. Of equal values the first one is
  /// kept.
  static bool is_better(T value, T best) { return value > best * T(1 + 1e-6); }
  /// -1, 0 or 1: whether `gap` is smaller than, nearly equal to, or larger than `other`.
  int ordered(T gap, T other) const {
    return gap < other - nearly_ ? -1 : (gap > other + nearly_ ? 1 : 0);
  }
  bool is_near(const ManifoldPoint<S>& point) const { return point.gap <= highest_; }

  /// Finds the centre of pressure of the previous step's impulses at the present positions of the
  /// points.
  void find_pressure(std::span<const KeptPoint> previous) {
    T sum = 0;
    for (const KeptPoint& old : previous)
      for (const auto& point : points_) {
        if (point.feature != old.feature) continue;
        sum += static_cast<T>(old.push);
        const Vector apart = point.position - points_[first_].position;
        pressure_ += static_cast<T>(old.push) * apart;
      }
    loaded_ = sum > 0;
    if (loaded_) pressure_ /= sum;
  }
  /// The gap between the bodies at the centre of pressure [m]: linear interpolation over the
  /// triangle of the deepest point and points i and j. Infinite if the centre of pressure lies
  /// outside of the triangle by more than 2 % in barycentric coordinates, or if there was no load.
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
  Vector pressure_ = Vector::Zero();  ///< centre of pressure relative to the deepest point [m]
  bool loaded_ = false;
};

/// Finds the points of the previous step in the manifold.
/// @param lowest    at least one of the three points must have at most this gap [m]
/// @param triangle  out: indices of the three points
/// @returns whether all three points were found and at least one of them has a gap <= lowest
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

/// Whether every point carried an impulse, so that the centre of pressure lay inside their
/// triangle.
inline bool carries(std::span<const KeptPoint> previous) {
  return std::all_of(previous.begin(), previous.end(),
                     [](const KeptPoint& point) { return point.push > 0; });
}

/// Removes all points but the chosen ones.
template <class S>
void keep_points(Manifold<S>& manifold, std::span<std::size_t> chosen) {
  sort_items(chosen);
  const auto end = std::unique(chosen.begin(), chosen.end());
  const auto count = static_cast<std::size_t>(end - chosen.begin());
  for (std::size_t k = 0; k < count; ++k) manifold.points[k] = manifold.points[chosen[k]];
  manifold.points.erase(manifold.points.begin() + static_cast<std::ptrdiff_t>(count),
                        manifold.points.end());
}

}  // namespace detail

/// Keeps at most max_points points of a manifold.
///   1 point: the deepest one.
///   2 points: the deepest point and the point farthest from it.
///   3 points: the deepest point and the two that form with it the triangle with the smallest gap
///     at the centre of pressure of the previous step, or the largest triangle if there is no
///     previous load. If the triangle counts as two points (Reduction), two points are kept.
/// The result depends only on the arguments. The contact class does not change.
/// @param manifold   in: all points, sorted by feature; out: the points kept, in the same order
/// @param max_points 1, 2 or 3
/// @param previous   the points kept in the previous step. Three points are kept again if two
///                   conditions hold. One of them is among the deepest points. All three carried an
///                   impulse, or the area of their triangle is at least reduction.keep times that
///                   of the best triangle. With an empty span the choice has no memory
/// @param reduction  parameters of the choice
template <class S>
void reduce(Manifold<S>& manifold, std::size_t max_points, std::span<const KeptPoint> previous = {},
            const Reduction& reduction = {}) {
  using T = typename S::Scalar;
  const auto& points = manifold.points;
  if (points.size() <= max_points && (reduction.resolution <= 0 || points.size() <= 1)) return;
  detail::PointChoice<S> choice(points);
  choice.update(previous, reduction);
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
