// SPDX-License-Identifier: MIT
// The separating axis of two smooth convex shapes that are given by their support functions, by
// Newton's method from a first guess, with a proof.
//
// Let C = B - A be the set of all differences b - a. For a unit vector n let w(n) be the point of C
// with the smallest n . w, and s(n) = n . w(n) the separation of the shapes along n. The signed gap
// is the largest separation. On the unit sphere, with E an orthonormal basis of the tangents at n,
//
//     gradient of s   g = E^T w(n),
//     Hessian of s    -(R + s I),       R: matrix of the radii of curvature of C at w(n) [m],
//
// so that a Newton step is n + E (R + s I)^-1 g, normalized. D support points, for directions that
// are n tilted by the angle theta, give both: g is the mean of E^T w, and R the change of E^T w over
// the tilt.
//
// Proof. The D tilted points w_k and the point w(m) at the new axis m are points of C. So is their
// convex hull, and
//   - if s(m) > 0, the gap is at least s(m), and at most the distance of the hull from the origin;
//   - if s(m) < 0, the depth is at most -s(m). Let f be the point of C with the largest m . f. The
//     two simplices over the facet (w_k), with the tips w(m) and f, are a part of C. If the origin
//     lies inside of them, the depth is at least its distance from the nearest of their faces.
// The result is certified if the bounds agree: those of a gap within the tolerance, those of a depth within the larger of
// the tolerance and 1/200 of the depth. An axis with a smaller depth, if there is one, then makes an angle
// of the order of theta with m, where Newton's method has found the maximum of s. The hull of so few
// points is enough because w(m) is the point of C nearest to the origin to second order. A pair
// without a certified result (flat faces, edges, a large depth) is left to GJK and EPA.
#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

#include "moreau/core/space.hpp"
#include "moreau/detect/convex/epa.hpp"

namespace moreau::detail {

/// A separating axis and the separation along it.
template <class S>
struct SmoothAxis {
  typename S::Vector normal;  ///< unit, from a to b, world axes
  typename S::Scalar gap;     ///< separation along it [m]; < 0 is minus the depth
  typename S::Vector on_a;    ///< point of A, relative to the centre of a, world axes [m]
};

/// Newton's method for the largest separation; the head of this file has the equations.
template <class S, class Reach>
class SmoothAxisSearch {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Point = ExtremePoint<Vector>;
  using Result = std::optional<SmoothAxis<S>>;

  /// @param reach      reach(n) -> the ExtremePoint of C with the largest n . point
  /// @param margin     if the gap exceeds this, the result may be any axis with a separation that
  ///                   exceeds it [m]
  /// @param precise    accuracy of the gap of the axis found [m]
  /// @param tolerance  largest difference of the bounds of the gap [m]
  SmoothAxisSearch(const Reach& reach, T margin, T precise, T tolerance)
      : reach_(reach), margin_(margin), precise_(precise), tolerance_(tolerance) {}

  /// @param start  first guess of the axis, unit
  /// @returns the axis; nothing if it is not certified
  Result run(const Vector& start) {
    frame_ = S::contact_frame(start);
    for (int round = 0; round < rounds && theta_ <= widest; ++round) {
      if (const Result beyond = tilt()) return beyond;
      if (!newton_step()) return {};
      // Near the maximum it is known how deep the shapes overlap, and which tilt proves the depth.
      const bool overlaps = separation_ < 0 && step_.norm() < theta_;
      if (overlaps && theta_ < tilt_for(-separation_) / 2) {
        theta_ = tilt_for(-separation_);
        continue;
      }
      for (int k = 0; k < steps; ++k) {
        const bool is_near = step_.norm() < theta_;
        move(gradient_);
        if (tip_separation_ > margin_) return result();
        gradient_ = gradient_at_tip();
        step_ = solve(gradient_);
        if (!is_near) break;  // R is that of the axis before
        // The gain of another Newton step.
        if (!(step_.dot(gradient_) / 2 <= precise_)) continue;
        if (is_certified()) return result();
        if (!widen()) return {};
        break;
      }
    }
    return {};
  }

 private:
  static constexpr int rounds = 8, steps = 12;
  static constexpr std::size_t tilts = S::dim;
  static constexpr int tangents = S::dim - 1;
  /// Tilts [rad]: the first, and the largest one.
  static constexpr T first = T(1e-3), widest = T(0.2);
  static constexpr T longest = T(0.5);  ///< largest Newton step [rad]
  /// Largest difference of the bounds of a depth, relative to the depth, if this is more than the
  /// tolerance [-].
  static constexpr T share_of_depth = T(5e-3);
  using Tangent = Eigen::Matrix<T, tangents, 1>;
  using Block = Eigen::Matrix<T, tangents, tangents>;

  Vector normal() const { return frame_.col(0); }
  /// w(n): support point of C against n.
  Point nearest(const Vector& n) const { return reach_(Vector(-n)); }
  /// The direction of tilt k in the tangent plane: D directions whose sum is zero.
  static Tangent direction(std::size_t k) {
    constexpr T step = T(2) * std::numbers::pi_v<T> / T(tilts);
    Tangent e = Tangent::Zero();
    e[0] = tangents == 1 ? (k == 0 ? T(1) : T(-1)) : std::cos(step * T(k));
    for (int t = 1; t < tangents; ++t) e[t] = std::sin(step * T(k));
    return e;
  }
  Vector in_world(const Tangent& tangent) const {
    return frame_.template rightCols<tangents>() * tangent;
  }

  /// Computes the tilted support points, the mean separation and gradient, and R.
  /// @returns an axis beyond the margin, if there is one
  Result tilt() {
    gradient_.setZero();
    radii_.setZero();
    T mean = 0;
    for (std::size_t k = 0; k < tilts; ++k) {
      const Tangent e = direction(k);
      const Vector n = (normal() + theta_ * in_world(e)).normalized();
      base_[k] = nearest(n).point;
      const T s = n.dot(base_[k]);
      if (s > margin_) return SmoothAxis<S>{n, s, Vector::Zero()};
      const Tangent g = frame_.template rightCols<tangents>().transpose() * base_[k];
      gradient_ += g / T(tilts);
      radii_ -= T(tangents) / (T(tilts) * theta_) * g * e.transpose();
      mean += normal().dot(base_[k]) / T(tilts);
    }
    radii_ = (radii_ + radii_.transpose().eval()) / 2;
    separation_ = mean - theta_ * theta_ * radii_.trace() / (2 * T(tangents));
    return {};
  }
  /// @returns false if the separation has no maximum near the axis
  bool newton_step() {
    hessian_ = radii_;
    hessian_.diagonal().array() += separation_;
    // Positive definite: Sylvester's criterion for one and two rows.
    if (!(hessian_(0, 0) > 0 && hessian_.determinant() > 0)) return false;
    step_ = solve(gradient_);
    return std::isfinite(step_.norm());
  }
  Tangent solve(const Tangent& gradient) const { return hessian_.inverse() * gradient; }
  /// Turns the axis by the Newton step. If the gradient along the step has changed its sign, the
  /// step was too long: it ends where the gradient would vanish if it were linear. (Without this,
  /// steps across a point of zero curvature would go back and forth for ever.)
  /// @param gradient  at the axis
  void move(const Tangent& gradient) {
    const T length = step_.norm();
    if (length > longest) step_ *= longest / length;
    const Vector from = normal(), turn = in_world(step_);
    turn_to(from + turn);
    const T before = gradient.dot(step_),
            after = tip_.point.dot(turn) - tip_separation_ * normal().dot(turn);
    if (after < -before / 4) turn_to(from + before / (before - after) * turn);
  }
  void turn_to(const Vector& axis) {
    frame_ = S::contact_frame(axis.normalized());
    tip_ = nearest(normal());
    tip_separation_ = normal().dot(tip_.point);
  }
  Tangent gradient_at_tip() const {
    return frame_.template rightCols<tangents>().transpose() * tip_.point;
  }
  Result result() const { return SmoothAxis<S>{normal(), tip_separation_, tip_.on_a}; }

  bool is_certified() { return tip_separation_ > 0 ? is_apart() : is_deep(); }
  /// Whether the hull is no farther from the origin than the separation: its tip, one of the edges
  /// at the tip, or one of the faces.
  bool is_apart() const {
    const T reach = tip_separation_ + tolerance_;
    const Vector& tip = tip_.point;
    if (tip.norm() <= reach) return true;
    for (std::size_t k = 0; k < tilts; ++k) {
      const Vector edge = base_[k] - tip;
      const T share = std::clamp(-edge.dot(tip) / edge.squaredNorm(), T(0), T(1));
      if ((tip + share * edge).norm() <= reach || face_distance(k) <= reach) return true;
    }
    return false;
  }
  /// Distance from the origin of the face between the tip and all tilted points but k; infinite if
  /// the nearest point of its plane lies outside of the face.
  T face_distance(std::size_t k) const {
    const Vector& tip = tip_.point;
    Eigen::Matrix<T, S::dim, tangents> edges;
    for (int t = 0; t < tangents; ++t) edges.col(t) = base_[(k + std::size_t(t) + 1) % tilts] - tip;
    const Block gram = edges.transpose() * edges;
    const Tangent share = gram.inverse() * Tangent(-edges.transpose() * tip);
    if (!(share.minCoeff() >= 0 && share.sum() <= 1)) return std::numeric_limits<T>::infinity();
    return (tip + edges * share).norm();
  }
  /// Whether the origin lies inside the two simplices, deep enough.
  bool is_deep() {
    const T depth = -tip_separation_;
    const T least = depth - std::max(tolerance_, share_of_depth * depth);
    is_too_wide_ = !(depth_below(tip_.point) >= least);
    return !is_too_wide_ && depth_below(reach_(normal()).point) >= least;
  }
  /// Makes the tilt larger, if the tilted points were too close together for the depth.
  bool widen() {
    if (tip_separation_ > 0 || is_too_wide_) return false;
    theta_ = std::max(2 * theta_, tilt_for(-tip_separation_));
    return true;
  }
  /// A tilt [rad] for which the side faces of the simplices lie deeper than a depth [m].
  T tilt_for(T depth) const { return 3 * depth / radii_.diagonal().minCoeff(); }
  /// Smallest depth of the origin below the faces between a tip and the facet of the tilted points;
  /// < 0 if it lies outside of one.
  T depth_below(const Vector& tip) const {
    T least = std::numeric_limits<T>::infinity();
    for (std::size_t k = 0; k < tilts; ++k) {
      const Vector& inner = base_[k];
      const Vector& corner = base_[(k + 1) % tilts];
      const Vector out = normal_of(S{}, corner - tip, base_[(k + 2) % tilts] - tip);
      const T side = out.dot(inner - tip), length = out.norm();
      if (!(length > 0) || side == 0) return -std::numeric_limits<T>::infinity();
      least = std::min(least, (side < 0 ? out.dot(tip) : -out.dot(tip)) / length);
    }
    return least;
  }
  /// A normal of the face with the edges p and q from the tip; in the plane, of the edge p.
  static Vector normal_of(Space<2, T>, const Vector& p, const Vector&) { return {p[1], -p[0]}; }
  static Vector normal_of(Space<3, T>, const Vector& p, const Vector& q) { return p.cross(q); }

  const Reach& reach_;
  const T margin_, precise_, tolerance_;
  T theta_ = first;
  typename S::Matrix frame_;  // of the axis
  std::array<Vector, tilts> base_;
  Tangent gradient_, step_;
  Block radii_, hessian_;
  T separation_ = 0;
  Point tip_{Vector::Zero(), Vector::Zero()};
  T tip_separation_ = 0;
  bool is_too_wide_ = false;
};

}  // namespace moreau::detail
