// SPDX-License-Identifier: MIT
// Pairs with a shape of which only the support function is known, or for which there is no special
// function. The contact is one point.
//
// Shapes that are apart: GJK (gjk.hpp). Overlapping shapes: EPA (epa.hpp) finds the axis n roughly,
// then GJK finds it exactly. With b moved out of a along n, by a little more than the depth there,
// the direction of the nearest points is a better axis. If m is the normal of C = B - A at the
// point of its surface nearest to the origin, p the depth and R the radius of curvature, this takes
// an angle e between n and m to about e p / R; a flat face is found at once.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "moreau/detect/convex/epa.hpp"
#include "moreau/detect/convex/gjk.hpp"
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

  /// Signed distance of the pair. Not inlined, so that every caller gets the same bits.
  /// @param margin  a gap larger than this may be given as any larger gap [m]
  [[gnu::noinline]] SignedDistance<S> distance(
      T margin = std::numeric_limits<T>::infinity()) const {
    SignedDistance<S> found;
    const bool is_at_center = !(offset_.norm() > rounding());
    const Vector start = is_at_center ? Vector(Vector::UnitX()) : offset_;
    return is_apart(start, Vector::Zero(), margin, found) ? found : depth();
  }

 private:
  static T extent(const Aabb<S>& box) { return (box.upper - box.lower).norm(); }
  /// The nearest points of shapes that are apart. A simplex of points close together on a curved
  /// surface gets stuck: GJK is started again from the axis found, until the distance equals the
  /// separation along the axis.
  /// @param shift   displacement of b [m]
  /// @param margin  a gap larger than this may be given as any larger one [m]
  /// @returns whether the shapes are then apart
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
  /// GJK from one direction on.
  /// @param shift  displacement of b [m]
  /// @returns whether the shapes are then apart
  bool run_gjk(const Lifted& start, const Vector& shift, T margin, SignedDistance<S>& found) const {
    std::array<Vector, all_steps + 2> on_a;
    std::uint32_t count = 0;
    // A pair in the plane is taken for one in space without thickness.
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
    Simplex<T> simplex(support(axis));
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
  /// The accuracy of a distance on a curved surface, which rounding of its points limits [m].
  T precise() const { return size_ * T(512) * std::numeric_limits<T>::epsilon(); }
  T rounding() const { return size_ * DetectionTolerance<T>::rounding; }
  ExtremePoint<Vector> reach(const Vector& n) const {
    const Vector on_a = a_.support(-n);
    return {offset_ + (b_.support(n) - on_a), on_a};
  }
  /// The accuracy to which EPA finds the depth before GJK takes over [m].
  T rough() const { return std::max(size_ * T(2e-4), precise()); }
  /// The distance of a and b when b is moved out of a [m].
  T aside() const { return size_ * T(1e-2); }
  /// The depth from which on the climb is slow, so that EPA runs to the full accuracy [m].
  T deep() const { return size_ * T(2e-2); }
  /// The separation along a unit vector [m]: a lower bound of the gap.
  T separation(const Vector& n) const { return n.dot(reach(-n).point); }

  SignedDistance<S> depth() const {
    const auto reach_along = [this](const Vector& n) { return reach(n); };
    const auto polytope = epa(S{}, reach_along, rough());
    SignedDistance<S> best = climb_from(polytope.nearest());
    // Other faces may hide a smaller depth. From those with nearly the same normal, the climb leads
    // to the same axis.
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
  /// The best axis that is reached by climbing from a face of the polytope.
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
  /// Extrapolates the normal to the limit of its turns, if these shrink at a constant rate.
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

/// Signed distance of shapes known by their support functions: exact to rounding for flat faces; on
/// curved surfaces as accurate as rounding of the support points allows.
template <class A, class B>
requires GeneralPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                               const Placed<B>& b) {
  return detail::ConvexPair<A, B>(a, b).distance();
}

/// One contact point, midway between the nearest or deepest points.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires GeneralPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>&) {
  MOREAU_ASSERT(margin >= 0);
  return detail::touch_at_one_point(detail::ConvexPair<A, B>(a, b).distance(margin), margin,
                                    FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0), out);
}

}  // namespace moreau
