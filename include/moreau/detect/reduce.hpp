// SPDX-License-Identifier: MIT
// reduce: from all contact points of a pair to at most three that carry nearly the same load.
//
// Three points carry a load whose centre of pressure lies in their triangle. If the load moves
// beyond a side of the triangle, the bodies tip about that side until a point that was left out
// penetrates. This deepest point then joins the triangle, together with the two points with which
// the bodies would come to rest under the previous load: among all triangles that hold the centre
// of pressure, the one that is lowest there. The load can move on to the new point, and the tipping
// ends. If the triangle were chosen by its area alone, it would lose the centre of pressure again,
// and the bodies would rock for ever.
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

/// How reduce() chooses points. Fractions [-] are of the size of the contact, lengths are in [m].
struct Reduction {
  /// Points count as equally deep as the deepest one if they lie within this fraction of the
  /// contact's extent above it [-]. The first of them by key is chosen, so that the choice does not
  /// depend on rounding.
  double as_deep = 1e-6;
  /// The points of the step before are kept while they span this fraction of the largest area [-].
  double keep = 0.8;
  /// A triangle flatter than this fraction of the contact's extent squared [-] counts as two
  /// points.
  double flat = 1e-6;
  /// Two points closer together than this count as one point, and a triangle lower than this counts
  /// as two points [m]. Two points at nearly one place make the contact problem nearly singular.
  double resolution = 0;
  /// The points of the step before are kept only if one of them is at most this much shallower than
  /// the deepest point [m].
  double shallower = 0;
  /// If three points or more lie at most this far above the deepest point [m], points that lie
  /// higher, which are open, are not considered.
  double near = std::numeric_limits<double>::infinity();
};

/// A contact point that was kept in the step before.
struct KeptPoint {
  FeatureKey feature;  ///< of the point
  double push = 0;     ///< normal impulse that the point carried, >= 0 [N s]
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

/// A choice among the points of one manifold: the deepest point, and the two others that are found
/// by comparing all pairs.
template <class S>
class PointChoice {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Points = std::vector<ManifoldPoint<S>>;

  explicit PointChoice(const Points& points) : points_(points) {}

  /// Finds the deepest point and the centre of pressure; must come before the other functions.
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
  /// The two points that make with the deepest point the triangle on which the bodies come to rest
  /// under the previous load. Among the triangles that hold the centre of pressure it is the lowest
  /// there; among equally low ones, as if the centre lies on a side, the one whose corners close
  /// first; among equals again the widest. If no triangle holds the centre of pressure, it is the
  /// widest.
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
  /// Whether a value is larger by more than rounding: among equals the first by key stays.
  static bool is_better(T value, T best) { return value > best * T(1 + 1e-6); }
  /// -1, 0 or 1: whether a gap is smaller, nearly equal, or larger.
  int ordered(T gap, T other) const {
    return gap < other - nearly_ ? -1 : (gap > other + nearly_ ? 1 : 0);
  }
  bool is_near(const ManifoldPoint<S>& point) const { return point.gap <= highest_; }

  /// Finds the centre of pressure of the step before, with the points at their present positions.
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
  /// The gap between the bodies at the centre of pressure [m], interpolated over the triangle with
  /// the deepest point; infinite if the centre lies more than a little outside of the triangle.
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

/// Finds the points of the step before in the manifold.
/// @param lowest    at least one of them must have at most this gap [m]
/// @param triangle  their indices
/// @returns whether all three are there and one of them is deep enough
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

/// Whether all points carry a load: the centre of pressure lies within them.
inline bool carries(std::span<const KeptPoint> previous) {
  return std::all_of(previous.begin(), previous.end(),
                     [](const KeptPoint& point) { return point.push > 0; });
}

/// Removes all points but the chosen ones.
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

/// Keeps at most max_points (1, 2 or 3) points of a manifold: the deepest point; and the one
/// farthest from it, or the two that make with it the lowest triangle under the previous load, or
/// the widest triangle without a previous load. The same points and the same memory give the same
/// choice. The class stays that of the full contact.
/// @param manifold   in: all points, sorted by feature; out: the points that are kept, in that
/// order
/// @param max_points 1, 2 or 3
/// @param previous   the points that were kept in the step before. Their triangle stays if it has
/// one
///                   of the deepest points, and if all its points carry a load or it has most of
///                   the largest area; pass none for a choice without memory
/// @param reduction  how to choose
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
