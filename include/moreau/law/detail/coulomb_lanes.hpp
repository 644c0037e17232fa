// SPDX-License-Identifier: MIT
// The local solution of Signorini's and Coulomb's conditions, for one contact or for one contact per SIMD
// lane, without branches that depend on the lane.
//
// No impulse and sticking are explicit. If the sticking impulse is outside of the cone, the contact slips,
// u_t = -alpha r_t, and alpha > 0 is the root of phi(alpha) = |r_t| - mu r_n, positive at 0 and
// negative at infinity (O. Bonnefon and G. Daviet, "Quartic formulation of Coulomb 3D frictional
// contact", INRIA RT-0400, 2011). Squaring phi would add roots with r_n < 0. Newton runs on 1/|r_t|
// - 1/(mu r_n) instead, which is nearly linear in alpha (as in the secular equation of J. J. More
// and D. C. Sorensen, SIAM J. Sci. Stat. Comput. 4 (1983) 553), inside a bracket for phi. In the
// plane the sign of r_t does not depend on alpha: the solution is explicit.
//
// The iteration ends with a Newton step that is shorter than `close`. A single contact takes `close` so
// small that the error of the step, its square, is rounding: the solution is exact. Lanes take a few per
// cent: alpha is kept from sweep to sweep, so that each visit squares the error and the only fixed point
// is the exact solution.
#pragma once

#include <concepts>
#include <limits>

#include "moreau/law/lane_block.hpp"

namespace moreau::detail {

/// The local problems of the lanes, or of one contact.
/// @tparam Block LaneBlock
template <class S, class Block = LaneBlock<S>>
class CoulombLanes {
 public:
  using T = typename S::Scalar;
  using Lanes = typename Block::Number;
  using Index = typename Block::Index;
  using Values = typename Lanes::Values;
  using Indices = typename Lanes::Indices;
  using Vector = typename Block::Vector;
  using Tangent = typename Block::Tangent;
  static constexpr Index tangents = Block::tangents;

  /// @param alpha  in: alpha of u_t = -alpha r_t from the last visit, or 0; out: the new alpha
  /// @param polish projects slipping impulses onto the cone
  static Vector solve(const Block& block, const Vector& b, const Values& friction, Values& alpha,
                      bool polish) {
    const Values zero{};
    const Indices acts = b[0] < zero;
    const Values frictionless = -b[0] * block.inverse_normal;
    Tangent c, tangent;
    Values normal = frictionless;
    for (Index t = 0; t < tangents; ++t) {
      c[t] = b[t + 1] - b[0] * block.coupling[t];
      tangent[t] = -c[t] * block.inverse_slip[t];
      normal -= block.coupling[t] * tangent[t];
    }
    const Values limit = friction * normal, unit = unit_of(block);
    const Indices sticks =
        (limit >= zero) & (squared(tangent, unit) <= (unit * limit) * (unit * limit));
    const Indices slips = acts & ~sticks;
    if (Lanes::any(slips)) {
      const CoulombLanes problem(block, c, slips ? frictionless : Lanes::broadcast(1), friction);
      Tangent sliding = problem.slide(slips & (friction > zero), alpha);
      if (polish) sliding = problem.onto_disk(sliding);
      normal = slips ? frictionless : normal;
      for (Index t = 0; t < tangents; ++t) {
        tangent[t] = slips ? sliding[t] : tangent[t];
        normal = slips ? normal - block.coupling[t] * tangent[t] : normal;
      }
    }
    Vector r;
    r[0] = acts ? normal : zero;
    for (Index t = 0; t < tangents; ++t) r[t + 1] = acts ? tangent[t] : zero;
    return r;
  }

  /// SignoriniCoulomb::natural_map() in every lane.
  static Vector natural_map(const Vector& u, const Vector& r, const Values& friction) {
    const Values zero{};
    Vector x;
    x[0] = r[0] - u[0];
    Values slip2{}, length2{};
    for (Index t = 1; t <= tangents; ++t) {
      x[t] = r[t] - u[t];
      slip2 += u[t] * u[t];
      length2 += x[t] * x[t];
    }
    x[0] -= friction * Lanes::square_root(slip2);
    const Values length = Lanes::square_root(length2);
    const Values normal = (x[0] + friction * length) / (T(1) + friction * friction);
    const Indices inside = length <= friction * x[0], none = friction * length <= -x[0];
    const Values share = inside ? Lanes::broadcast(1) : friction * normal / length;
    x[0] = r[0] - (none ? zero : inside ? x[0] : normal);
    for (Index t = 1; t <= tangents; ++t) x[t] = r[t] - (none ? zero : share * x[t]);
    return x;
  }

 private:
  static constexpr bool exact = std::same_as<Lanes, OneNumber<T>>;
  static constexpr bool fine = std::numeric_limits<T>::epsilon() < T(1e-10);
  /// The iteration ends after a Newton step shorter than this, relative to slip + alpha, if
  /// | |r_t| - mu r_n | is as small relative to |r_t| + mu r_n.
  static constexpr T close = !exact ? T(0.05) : fine ? T(2e-8) : T(2e-4);
  /// If the sticking impulse is longer than this, in units of the impulse without friction and of 1 + mu,
  /// the slip of the block is below the rounding of slip + alpha. Powers of it must not overflow.
  static constexpr T far_outside = fine ? T(1e30) : T(1e9);

  /// @param c    b_t - k b_n
  /// @param frictionless normal impulse without friction
  CoulombLanes(const Block& block, const Tangent& c, const Values& frictionless,
               const Values& friction)
      : coupling_(block.coupling),
        slip_(block.slip),
        friction_(friction),
        frictionless_(frictionless),
        c_(c),
        unit_(unit_of(block)),
        inverse_unit_(inverse_unit_of(block)) {}

  /// What impulses are multiplied by before they are squared: 1, and w_nn in single precision, where squares of the impulses
  /// of grains of 1e-6 m or 1e4 m cannot be represented.
  static Values unit_of(const Block& block) {
    if constexpr (fine)
      return Lanes::broadcast(1);
    else
      return block.normal;
  }
  static Values inverse_unit_of(const Block& block) {
    if constexpr (fine)
      return Lanes::broadcast(1);
    else
      return block.inverse_normal;
  }
  /// |unit r|^2.
  static Values squared(const Tangent& r, const Values& unit) {
    Values sum{};
    for (Index t = 0; t < tangents; ++t) sum += (unit * r[t]) * (unit * r[t]);
    return sum;
  }
  /// mu r_n.
  Values limit(const Tangent& r) const {
    Values sum = frictionless_;
    for (Index t = 0; t < tangents; ++t) sum -= coupling_[t] * r[t];
    return friction_ * sum;
  }

  /// Tangential impulse of the lanes that slip in the plane: r_t = s mu r_n with a constant sign s.
  Tangent slide(const Indices&, const Values&) const requires(tangents == 1) {
    const Values s = c_[0] > Values{} ? -friction_ : friction_;
    Tangent r;
    r[0] = s * frictionless_ / (T(1) + s * coupling_[0]);
    return r;
  }

  /// r_t at an alpha, and its derivatives.
  struct Point {
    Tangent r, fall;            ///< r_t and -dr_t/dalpha
    Values along, limit_slope;  ///< -|r_t| d|r_t|/dalpha and d(mu r_n)/dalpha
    Values length2, limit;      ///< |r_t|^2 and mu r_n
  };
  /// @param unit by which impulses are multiplied
  Point at(const Values& alpha, const Values& unit) const {
    Point p{};
    for (Index t = 0; t < tangents; ++t) {
      const Values inverse = T(1) / (slip_[t] + alpha);
      p.r[t] = -unit * c_[t] * inverse;
      p.fall[t] = p.r[t] * inverse;
      p.along += p.r[t] * p.fall[t];
      p.limit_slope += coupling_[t] * p.fall[t];
    }
    p.limit_slope *= friction_;
    p.length2 = squared(p.r, Lanes::broadcast(1));
    Values normal = unit * frictionless_;
    for (Index t = 0; t < tangents; ++t) normal -= coupling_[t] * p.r[t];
    p.limit = friction_ * normal;
    return p;
  }

  Indices is_short(const Values& change, const Values& alpha) const {
    Values least = slip_[0];
    for (Index t = 1; t < tangents; ++t) least = slip_[t] < least ? slip_[t] : least;
    return Lanes::absolute(change) <= close * (least + alpha);
  }

  /// slide() in space of the lanes that are not solved yet. In most visits one Newton step on |r_t|^2 - (mu r_n)^2, which needs no
  /// root, is enough, because alpha of the last visit is near.
  Tangent slide(const Indices& unsolved, Values& alpha) const requires(tangents > 1) {
    const Values zero{};
    const Point p = at(alpha, unit_);
    const Values limit2 = p.limit * p.limit, phi = p.length2 - limit2;
    const Values slope = T(2) * (p.along + p.limit * p.limit_slope);
    const Values change = phi / (slope > zero ? slope : Lanes::broadcast(1));
    const Values next = alpha + change;
    const Indices near = (p.limit > zero) & (slope > zero) & is_short(change, alpha) &
                         (next >= zero) &
                         (Lanes::absolute(phi) <= T(2) * close * (p.length2 + limit2));
    if (Lanes::any(unsolved & ~near)) return search(unsolved, alpha);
    alpha = unsolved ? next : alpha;
    Tangent r;
    for (Index t = 0; t < tangents; ++t)
      r[t] = unsolved ? inverse_unit_ * (p.r[t] - change * p.fall[t]) : zero;
    return r;
  }

  /// Where alpha is so large that the slip of the block does not matter: r_t has the direction of -c.
  Tangent far_tangent() const {
    Values size{};
    for (Index t = 0; t < tangents; ++t) {
      const Values one = Lanes::absolute(c_[t]);
      size = one > size ? one : size;
    }
    Tangent r;
    Values length2{}, along{};
    for (Index t = 0; t < tangents; ++t) {
      r[t] = -c_[t] / size;
      length2 += r[t] * r[t];
      along += coupling_[t] * r[t];
    }
    const Values length = Lanes::square_root(length2), share = length + friction_ * along;
    // If the share is negative there is no such impulse; if size is 0, it is not a number.
    const Values normal = share > Values{} ? frictionless_ / share : Values{};
    for (Index t = 0; t < tangents; ++t)
      r[t] = normal > Values{} ? friction_ * normal * r[t] : Values{};
    return r;
  }
  Indices is_far() const {
    Values size{}, slip{};
    for (Index t = 0; t < tangents; ++t) {
      const Values one = Lanes::absolute(c_[t]);
      size = one > size ? one : size;
      slip += slip_[t];
    }
    return size > far_outside * (T(1) + friction_) * slip * frictionless_;
  }

  /// Newton's method in a bracket, from any alpha >= 0, in units of the impulse without friction.
  Tangent search(Indices unsolved, Values& alpha) const requires(tangents > 1) {
    const Values zero{}, most = Lanes::broadcast(std::numeric_limits<T>::max());
    const Values unit = T(1) / frictionless_;
    const Indices all = unsolved;
    Indices direct = unsolved & is_far();
    unsolved = unsolved & ~direct;
    Values lower{}, upper = most, trial = alpha;
    Tangent result;
    for (Index t = 0; t < tangents; ++t) result[t] = zero;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Point p = at(trial, unit);
      const Values length = Lanes::square_root(p.length2), phi = length - p.limit;
      const Indices positive = p.limit > zero;
      const Values change =
          (positive ? phi * p.length2 * p.limit : phi * length) /
          (positive ? p.limit_slope * p.length2 * length + p.along * p.limit * p.limit
                    : p.along + p.limit_slope * length);
      lower = phi > zero ? trial : lower;
      upper = phi > zero ? upper : trial;
      // At a fold of phi the step may point away from the root.
      const Values next = trial + change;
      const Indices near = positive & is_short(change, trial) & (next >= lower) & (next <= upper) &
                           (Lanes::absolute(phi) <= close * (length + p.limit));
      const Indices narrow = (upper < most) & (upper - lower <= close * close * upper);
      alpha = unsolved ? (near ? next : trial) : alpha;
      for (Index t = 0; t < tangents; ++t)
        result[t] =
            unsolved ? frictionless_ * (p.r[t] - (near ? change * p.fall[t] : zero)) : result[t];
      unsolved = unsolved & ~near & ~narrow;
      if (!Lanes::any(unsolved)) break;
      Values fallback = (lower + upper) / T(2);
      Values beyond = T(2) * lower;
      for (Index t = 0; t < tangents; ++t) beyond += slip_[t];
      fallback = upper < most ? fallback : beyond;
      trial = ((next > lower) & (next < upper)) ? next : fallback;
    }
    // A load at the limit of the numbers.
    Indices finite = Lanes::absolute(alpha) <= most;
    for (Index t = 0; t < tangents; ++t) finite = finite & (Lanes::absolute(result[t]) <= most);
    alpha = finite ? alpha : zero;
    direct = direct | (all & ~finite);
    if (!Lanes::any(direct)) return result;
    const Tangent far = far_tangent();
    for (Index t = 0; t < tangents; ++t) result[t] = direct ? far[t] : result[t];
    return result;
  }

  /// The tangential impulse moved onto the rim of the disk of radius mu r_n: Newton's method leaves a small distance. Impulses so small that their
  /// square underflows, whose root may be 0, stay as they are.
  Tangent onto_disk(const Tangent& r) const {
    const Values length2 = squared(r, unit_),
                 least = Lanes::broadcast(std::numeric_limits<T>::min());
    const Values scale =
        length2 >= least ? unit_ * limit(r) / Lanes::square_root(length2) : Lanes::broadcast(1);
    Tangent on;
    for (Index t = 0; t < tangents; ++t) on[t] = scale * r[t];
    return on;
  }

  Tangent coupling_, slip_;
  Values friction_, frictionless_;
  Tangent c_;
  Values unit_, inverse_unit_;
};

}  // namespace moreau::detail
