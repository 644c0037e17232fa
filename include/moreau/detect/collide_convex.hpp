// SPDX-License-Identifier: MIT
// Shapes of which the support function is all that is known, against each other or any other: the
// distance algorithm where they are apart, an expanding polytope where they overlap. The contact is
// one point.
#pragma once

#include <array>
#include <limits>

#include "moreau/detect/expand.hpp"
#include "moreau/detect/gjk.hpp"
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

  SignedDistance<S> distance() const {
    Lifted axis = Lifted::UnitX();
    if (offset_.norm() > rounding()) axis.template head<S::dim>() = offset_;
    // Points close together on a curved surface make a simplex that cannot go on: start again from
    // the axis found, until the distance is what its axis separates by.
    SignedDistance<S> found;
    for (int attempt = 0; attempt < 16; ++attempt) {
      if (!approach_from(axis, found)) return depth();
      const Vector across = found.normal;
      if (found.gap - across.dot(reach(-across).point) <= precise()) break;
      axis.setZero();
      axis.template head<S::dim>() = across;
    }
    return found;
  }

 private:
  static T extent(const Aabb<S>& box) { return (box.upper - box.lower).norm(); }
  /// The distance algorithm from one point on.
  /// @returns whether the shapes are apart
  bool approach_from(const Lifted& start, SignedDistance<S>& found) const {
    std::array<Vector, all_steps + 2> on_a;
    std::uint32_t count = 0;
    // In the plane too the nearest points are those of a set in space, without thickness.
    const auto support = [&](const Lifted& n) -> DifferencePoint<Lifted> {
      Vector direction = n.template head<S::dim>();
      if (direction.isZero(0)) direction = Vector::UnitX();
      const auto extreme = reach(-direction);
      on_a[count] = extreme.on_a;
      Lifted point = Lifted::Zero();
      point.template head<S::dim>() = extreme.point;
      ++count;
      return {point, count - 1, count - 1};
    };
    Lifted axis = start;
    Simplex<T> simplex(support(axis));
    if (approach<T>(support, simplex, axis, std::numeric_limits<T>::infinity(), size_, all_steps) ==
        Proximity::touching)
      return false;
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
  /// What is left to gain on a curved surface when the digits of its points end.
  T precise() const { return size_ * T(512) * std::numeric_limits<T>::epsilon(); }
  T rounding() const { return size_ * DetectionTolerance<T>::rounding; }
  ExtremePoint<Vector> reach(const Vector& n) const {
    const Vector on_a = a_.support(-n);
    return {offset_ + (b_.support(n) - on_a), on_a};
  }
  SignedDistance<S> depth() const {
    const auto face = expand(
        S{}, [this](const Vector& n) { return reach(n); }, precise());
    const Vector normal = -face.outward, witness = a_.center() + face.on_a;
    return {-face.offset, normal, witness, witness - face.offset * normal};
  }

  const Placed<A>& a_;
  const Placed<B>& b_;
  const Vector offset_;
  const T size_;
};

}  // namespace detail

/// Exact to rounding for flat faces; for curved ones to what the digits of the support allow.
template <class A, class B>
requires GeneralPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                               const Placed<B>& b) {
  return detail::ConvexPair<A, B>(a, b).distance();
}

/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires GeneralPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>&) {
  MOREAU_ASSERT(margin >= 0);
  const auto found = distance(a, b);
  if (!(found.gap <= margin)) return false;
  out.clear();
  out.normal = found.normal;
  out.gap = found.gap;
  out.contact_class = ContactClass::vertex_vertex;
  out.points.push_back({(found.witness_a + found.witness_b) / 2, found.gap,
                        FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0)});
  return true;
}

}  // namespace moreau
