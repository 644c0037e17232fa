// SPDX-License-Identifier: MIT
// Pairs of convex shapes for which only the general algorithms are available: one of the shapes is
// known only by its support function, or the pair has no function of its own. The contact has one
// point.
//
// Shapes that are apart are treated by GJK (gjk.hpp). For overlapping shapes, EPA (epa.hpp) finds
// an axis n of limited accuracy. An iteration then improves n:
//   1. Move b out of a along n, by a little more than the depth along n.
//   2. The direction between the nearest points, found by GJK, is the new n.
// Let m be the exact axis: the normal of C = B - A, the set of all differences b - a, at the point
// of its surface nearest to the origin. Let p be the depth and R the radius of curvature of C at
// this point. One iteration reduces an angle e between n and m to about e p / R. If the surface of
// C is flat there, one iteration finds m.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "moreau/detect/convex/epa.hpp"
#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/convex/smooth_axis.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/detect/tolerance.hpp"

namespace moreau {

namespace detail {

template <class A, class B>
class ConvexPair {
 public:
  using S = SpaceOf<A>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Lifted = Eigen::Matrix<T, 3, 1>;

  ConvexPair(const Placed<A>& a, const Placed<B>& b)
      : a_(a),
        b_(b),
        offset_(b.center() - a.center()),
        size_(extent(a.bounding_box()) + extent(b.bounding_box())) {}

  /// Signed distance of the pair, by Newton's method if the surfaces are smooth (smooth_axis.hpp).
  /// @param margin  if the gap exceeds this, the result may be any gap that exceeds it [m]
  /// @param axis    in: first guess of the axis, unit, or zero: the direction between the centres;
  ///                out: the axis
  SignedDistance<S> distance(T margin, Vector& axis) const {
    if (axis.isZero(0)) axis = is_concentric() ? Vector(Vector::UnitX()) : offset_.normalized();
    const auto reach_along = [this](const Vector& n) { return reach(n); };
    const T proved = std::max(size_ * T(1e-9), precise());
    SmoothAxisSearch<S, decltype(reach_along)> search(reach_along, margin, precise(), proved);
    SignedDistance<S> found;
    if (const auto smooth = search.run(axis)) {
      const Vector witness = a_.center() + smooth->on_a;
      found = {smooth->gap, smooth->normal, witness, witness + smooth->gap * smooth->normal};
    } else {
      found = distance(margin);
    }
    if (found.gap < std::numeric_limits<T>::infinity()) axis = found.normal;
    return found;
  }
  /// Signed distance of the pair by GJK and EPA. The function is not inlined, so that all callers
  /// get the same bits.
  /// @param margin  if the gap exceeds this, the result may be any gap that exceeds it [m]
  [[gnu::noinline]] SignedDistance<S> distance(
      T margin = std::numeric_limits<T>::infinity()) const {
    SignedDistance<S> found;
    const Vector start = is_concentric() ? Vector(Vector::UnitX()) : offset_;
    return is_apart(start, Vector::Zero(), margin, found) ? found : depth();
  }

 private:
  static T extent(const Aabb<S>& box) { return (box.upper - box.lower).norm(); }
  /// Finds the nearest points if the shapes are apart. On a curved surface GJK may stop early,
  /// because the points of its simplex are close together. So GJK is started again from the axis
  /// found, until the distance equals the separation along the axis.
  /// @param shift   displacement of b, world axes [m]
  /// @param margin  if the gap exceeds this, the result may be any gap that exceeds it [m]
  /// @returns whether the shapes are apart with b displaced by `shift`
  bool is_apart(const Vector& start, const Vector& shift, T margin,
                SignedDistance<S>& found) const {
    Lifted axis = Lifted::Zero();
    axis.template head<S::dim>() = start;
    for (int attempt = 0; attempt < 16; ++attempt) {
      if (!run_gjk(axis, shift, margin, found)) return false;
      if (found.gap > margin) return true;
      const Vector& across = found.normal;
      if (found.gap - (separation(across) + across.dot(shift)) <= precise()) break;
      axis.template head<S::dim>() = across;
    }
    return true;
  }
  /// Runs GJK once.
  /// @param start  first search direction, of any length
  /// @param shift  displacement of b, world axes [m]
  /// @returns whether the shapes are apart with b displaced by `shift`
  bool run_gjk(const Lifted& start, const Vector& shift, T margin, SignedDistance<S>& found) const {
    std::array<Vector, all_steps + 2> on_a;
    std::uint32_t count = 0;
    // A pair in the plane is treated as a pair in space with all points at z = 0.
    const auto support = [&](const Lifted& n) -> DifferencePoint<Lifted> {
      Vector direction = n.template head<S::dim>();
      if (direction.isZero(0)) direction = Vector::UnitX();
      const auto extreme = reach(-direction);
      on_a[count] = extreme.on_a;
      Lifted point = Lifted::Zero();
      point.template head<S::dim>() = extreme.point + shift;
      ++count;
      return {point, count - 1, count - 1};
    };
    Lifted axis = start;
    Simplex<T> simplex(support(axis), size_);
    const Proximity proximity = gjk<T>(support, simplex, axis, margin, size_, all_steps);
    if (proximity == Proximity::touching) return false;
    found.gap = std::numeric_limits<T>::infinity();
    if (proximity == Proximity::beyond) return true;
    const Vector apart = simplex.nearest().template head<S::dim>();
    found.gap = apart.norm();
    found.normal = apart / found.gap;
    found.witness_a = a_.center();
    const auto weights = weights_of(simplex);
    for (int i = 0; i < simplex.size(); ++i)
      found.witness_a += weights[static_cast<std::size_t>(i)] * on_a[simplex[i].a];
    found.witness_b = found.witness_a + apart;
    return true;
  }
  /// Accuracy of a distance between curved surfaces, which rounding of the surface points limits
  /// [m].
  T precise() const { return size_ * T(512) * std::numeric_limits<T>::epsilon(); }
  bool is_concentric() const { return !(offset_.norm() > rounding()); }
  T rounding() const { return size_ * DetectionTolerance<T>::rounding; }
  ExtremePoint<Vector> reach(const Vector& n) const {
    const Vector on_a = a_.support(-n);
    return {offset_ + (b_.support(n) - on_a), on_a};
  }
  /// Accuracy to which EPA finds the depth before the iteration with GJK [m].
  T rough() const { return std::max(size_ * T(2e-4), precise()); }
  /// Distance of the shapes after b has been moved out of a [m].
  T aside() const { return size_ * T(1e-2); }
  /// If the depth exceeds this, the iteration converges slowly, and EPA is run to full accuracy too
  /// [m].
  T deep() const { return size_ * T(2e-2); }
  /// The separation along a unit vector n [m]. It is a lower bound of the gap.
  T separation(const Vector& n) const { return n.dot(reach(-n).point); }

  SignedDistance<S> depth() const {
    const auto reach_along = [this](const Vector& n) { return reach(n); };
    const auto polytope = epa(S{}, reach_along, rough());
    SignedDistance<S> best = climb_from(polytope.nearest());
    // Other faces of the polytope may lead to a smaller depth. Of faces with nearly the same normal
    // only one is tried, because the iteration leads to the same axis from each of them.
    std::array<Vector, 8> seen{best.normal};
    std::size_t count = 1;
    for (std::size_t f = 0; f < polytope.size() && count < seen.size(); ++f) {
      const auto face = polytope.face(f);
      if (!(face.offset < -best.gap)) continue;
      bool is_new = true;
      for (std::size_t k = 0; k < count; ++k)
        is_new = is_new && seen[k].dot(-face.outward) < T(0.95);
      if (!is_new) continue;
      const SignedDistance<S> other = climb_from(face);
      seen[count++] = other.normal;
      if (other.gap > best.gap + precise()) best = other;
    }
    if (-best.gap < deep()) return best;
    const SignedDistance<S> other = climb_from(epa(S{}, reach_along, precise()).nearest());
    return other.gap > best.gap ? other : best;
  }
  /// Improves the axis, starting from the normal of a face of the polytope, by the iteration
  /// described at the top of this file.
  /// @param face of the polytope that EPA has made inside b - a, world axes; its outward normal points against the axis
  /// @returns gap [m], unit normal from a to b, and witness points, world axes
  SignedDistance<S> climb_from(const NearestFace<Vector>& face) const {
    Vector normal = -face.outward, witness = a_.center() + face.on_a, turn = Vector::Zero();
    T gap = separation(normal);
    for (int step = 0; step < all_steps; ++step) {
      SignedDistance<S> moved{gap, normal, witness, witness};
      if (!is_apart(normal, (aside() - gap) * normal, std::numeric_limits<T>::infinity(), moved))
        break;
      const T better = separation(moved.normal), gain = better - gap;
      if (!(gain >= T(0))) break;
      const Vector last = turn;
      turn = moved.normal - normal;
      normal = moved.normal;
      gap = better;
      witness = moved.witness_a;
      const T rate = last.isZero(0) ? T(0) : turn.norm() / last.norm();
      if (gain <= precise() / T(16) * (T(1) - rate * rate)) break;
      go_farther(turn, rate, normal, gap);
    }
    return {gap, normal, witness, witness + gap * normal};
  }
  /// If the changes of the normal shrink at a constant rate, extrapolates the normal to their
  /// limit.
  void go_farther(const Vector& turn, T rate, Vector& normal, T& gap) const {
    if (!(rate > T(0) && rate < T(1))) return;
    const Vector end = (normal + rate / (T(1) - rate) * turn).normalized();
    const T better = separation(end);
    if (!(better > gap)) return;
    normal = end;
    gap = better;
  }

  const Placed<A>& a_;
  const Placed<B>& b_;
  const Vector offset_;
  const T size_;
};

}  // namespace detail

/// Signed distance of convex shapes by their support functions. For shapes with flat faces it is
/// exact to rounding. On curved surfaces the rounding errors of the support points limit the
/// accuracy.
template <class A, class B>
requires GeneralPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                               const Placed<B>& b) {
  typename SpaceOf<A>::Vector axis = SpaceOf<A>::Vector::Zero();
  return detail::ConvexPair<A, B>(a, b).distance(
      std::numeric_limits<typename SpaceOf<A>::Scalar>::infinity(), axis);
}

/// Collides convex shapes with one contact point, midway between the nearest or deepest points.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires GeneralPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>& cache) {
  MOREAU_ASSERT(margin >= 0);
  return detail::touch_at_one_point(detail::ConvexPair<A, B>(a, b).distance(margin, cache.axis),
                                    margin, FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0), out);
}

}  // namespace moreau
