// SPDX-License-Identifier: MIT
// Polyhedron against polyhedron.
#pragma once

#include <limits>
#include <optional>
#include <type_traits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polytope/make_manifold.hpp"
#include "moreau/detect/polytope/polyhedron_axis.hpp"
#include "moreau/detect/polytope/polyhedron_recall.hpp"

namespace moreau {

namespace detail {

/// The axis of a pair: proved from the features of the step before, or searched for.
template <std::floating_point T>
class FoundAxis {
 public:
  using S = Space<3, T>;

  /// @param margin  a gap larger than this need not be known exactly [m]
  FoundAxis(const PolyhedronPair<T>& pair, T margin, PairCache<S>& cache) {
    if (PolyhedronRecall<T> recall(pair);
        recall.prove(cache) && std::abs(recall.axis().gap - margin) > pair.rounding()) {
      axis_ = recall.axis();
      is_beyond_ = axis_.gap > margin;
      return;
    }
    search_.emplace(pair, margin);
    axis_ = search_->axis();
    is_beyond_ = search_->is_beyond();
    cache.remember(axis_);
    if (is_beyond_) cache.kind = AxisKind::none;
  }

  bool is_beyond() const { return is_beyond_; }
  const Axis<S>& axis() const { return axis_; }
  const Simplex<T>* simplex() const { return search_ ? &search_->simplex() : nullptr; }

 private:
  std::optional<PolyhedronAxis<T>> search_;
  Axis<S> axis_;
  bool is_beyond_ = false;
};

}  // namespace detail

/// All points of the contact of two polyhedra; reduce() keeps a few of them.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b,
             std::type_identity_t<T> margin, Manifold<Space<3, T>>& out,
             PairCache<Space<3, T>>& cache) {
  MOREAU_ASSERT(margin >= T(0));
  const detail::PolyhedronPair<T> pair(a, b);
  if (pair.is_apart_at_once(margin, cache)) return false;
  const detail::FoundAxis<T> found(pair, margin, cache);
  if (found.is_beyond()) return false;
  detail::fill(pair, found.axis(), found.simplex(), margin, out);
  return true;
}

/// Signed distance of two polyhedra, exact to rounding, with what is remembered of the pair.
template <std::floating_point T>
SignedDistance<Space<3, T>> distance(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b,
                                     PairCache<Space<3, T>>& cache) {
  using Vector = typename Space<3, T>::Vector;
  const detail::PolyhedronPair<T> pair(a, b);
  const detail::FoundAxis<T> found(pair, std::numeric_limits<T>::infinity(), cache);
  const auto& axis = found.axis();
  const Vector middle = detail::middle_of_contact(pair, axis, found.simplex());
  const Vector half = T(0.5) * axis.gap * axis.normal;
  return {axis.gap, axis.normal, a.center() + (middle - half), a.center() + (middle + half)};
}

/// The same without a memory of the pair.
template <std::floating_point T>
SignedDistance<Space<3, T>> distance(const Placed<Polyhedron<T>>& a,
                                     const Placed<Polyhedron<T>>& b) {
  PairCache<Space<3, T>> none;
  return distance(a, b, none);
}

/// Whether two polyhedra have a point in common. With a cache, the features are found along with
/// the answer, so that they can be remembered.
template <std::floating_point T>
bool overlap(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b,
             PairCache<Space<3, T>>& cache) {
  const detail::PolyhedronPair<T> pair(a, b);
  if (pair.is_apart_at_once(T(0), cache)) return false;
  return !detail::FoundAxis<T>(pair, T(0), cache).is_beyond();
}

/// The same without a memory of the pair. The distance algorithm alone answers where rounding has
/// no say; elsewhere the features are searched, so that the answer is that of the other queries.
template <std::floating_point T>
bool overlap(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b) {
  const detail::PolyhedronPair<T> pair(a, b);
  PairCache<Space<3, T>> none;
  if (pair.is_apart_at_once(T(0), none)) return false;
  detail::Simplex<T> simplex(pair.support(pair.start()));
  typename Space<3, T>::Vector axis = pair.start();
  const auto proximity = detail::gjk<T>([&](const auto& n) { return pair.support(n); }, simplex,
                                        axis, pair.rounding(), pair.size, detail::all_steps);
  if (proximity == detail::Proximity::beyond) return false;
  if (simplex.holds_origin(pair.size * DetectionTolerance<T>::certain)) return true;
  return !detail::FoundAxis<T>(pair, T(0), none).is_beyond();
}

}  // namespace moreau
