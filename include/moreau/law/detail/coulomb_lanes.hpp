// SPDX-License-Identifier: MIT
// The local solution of Signorini's and Coulomb's conditions for one contact per SIMD lane:
// SignoriniCoulomb::solve without branches. No impulse and sticking are exact. Slip in space is
// iterated until a Newton step is shorter than a few per cent. alpha is kept from sweep to sweep,
// so that each visit squares the error and the only fixed point is the exact solution.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "moreau/contact/lane_block.hpp"

namespace moreau::detail {

/// The local problems of the lanes.
template <class S>
class CoulombLanes {
 public:
  using T = typename S::Scalar;
  using Block = LaneBlock<S>;
  using W = typename Block::W;
  using Values = typename W::Values;
  using Indices = typename W::Indices;
  using Vector = typename Block::Vector;
  using Tangent = typename Block::Tangent;
  static constexpr std::size_t tangents = Block::tangents;

  /// @param alpha  in: alpha of u_t = -alpha r_t from the last visit, or 0; out: the new alpha
  /// @param polish projects slipping impulses onto the cone
  static Vector solve(const Block& block, const Vector& b, const Values& friction, Values& alpha,
                      bool polish) {
    const Values zero{};
    const Indices acts = b[0] < zero;
    const Values free = -b[0] * block.inverse_normal;
    Tangent c, tangent;
    Values normal = free;
    for (std::size_t t = 0; t < tangents; ++t) {
      c[t] = b[t + 1] - b[0] * block.coupling[t];
      tangent[t] = -c[t] * block.inverse_slip[t];
      normal -= block.coupling[t] * tangent[t];
    }
    const Values limit = friction * normal;
    const Indices sticks = (limit >= zero) & (squared(tangent) <= limit * limit);
    const Indices slips = acts & ~sticks;
    if (W::any(slips)) {
      const CoulombLanes problem(block, c, slips ? free : W::broadcast(1), friction);
      Tangent sliding = problem.slide(slips & (friction > zero), alpha);
      if (polish) sliding = problem.onto_cone(sliding);
      normal = slips ? free : normal;
      for (std::size_t t = 0; t < tangents; ++t) {
        tangent[t] = slips ? sliding[t] : tangent[t];
        normal = slips ? normal - block.coupling[t] * tangent[t] : normal;
      }
    }
    Vector r;
    r[0] = acts ? normal : zero;
    for (std::size_t t = 0; t < tangents; ++t) r[t + 1] = acts ? tangent[t] : zero;
    return r;
  }

 private:
  /// The iteration ends after a Newton step shorter than this, relative to slip + alpha, if
  /// | |r_t| - mu r_n | is as small relative to |r_t| + mu r_n.
  static constexpr T close = T(0.05);

  /// @param c    b_t - k b_n
  /// @param free impulse without friction
  CoulombLanes(const Block& block, const Tangent& c, const Values& free, const Values& friction)
      : coupling_(block.coupling), slip_(block.slip), friction_(friction), free_(free), c_(c) {}

  static Values squared(const Tangent& r) {
    Values sum{};
    for (std::size_t t = 0; t < tangents; ++t) sum += r[t] * r[t];
    return sum;
  }
  /// mu r_n.
  Values limit(const Tangent& r) const {
    Values sum = free_;
    for (std::size_t t = 0; t < tangents; ++t) sum -= coupling_[t] * r[t];
    return friction_ * sum;
  }

  /// Tangential impulse of the lanes that slip in the plane: r_t = s mu r_n with a constant sign s.
  Tangent slide(const Indices&, const Values&) const requires(tangents == 1) {
    const Values s = c_[0] > Values{} ? -friction_ : friction_;
    return {s * free_ / (T(1) + s * coupling_[0])};
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
    for (std::size_t t = 0; t < tangents; ++t) {
      const Values inverse = T(1) / (slip_[t] + alpha);
      p.r[t] = -unit * c_[t] * inverse;
      p.fall[t] = p.r[t] * inverse;
      p.along += p.r[t] * p.fall[t];
      p.limit_slope += coupling_[t] * p.fall[t];
    }
    p.limit_slope *= friction_;
    p.length2 = squared(p.r);
    Values normal = unit * free_;
    for (std::size_t t = 0; t < tangents; ++t) normal -= coupling_[t] * p.r[t];
    p.limit = friction_ * normal;
    return p;
  }

  Indices is_short(const Values& change, const Values& alpha) const {
    Values least = slip_[0];
    for (std::size_t t = 1; t < tangents; ++t) least = slip_[t] < least ? slip_[t] : least;
    return W::absolute(change) <= close * (least + alpha);
  }

  /// The same in space. In most visits one Newton step on |r_t|^2 - (mu r_n)^2, which needs no
  /// root, is enough, because alpha of the last visit is near.
  Tangent slide(const Indices& open, Values& alpha) const requires(tangents > 1) {
    const Values zero{};
    const Point p = at(alpha, W::broadcast(1));
    const Values limit2 = p.limit * p.limit, phi = p.length2 - limit2;
    const Values slope = T(2) * (p.along + p.limit * p.limit_slope);
    const Values change = phi / (slope > zero ? slope : W::broadcast(1));
    const Values next = alpha + change;
    const Indices near = (p.limit > zero) & (slope > zero) & is_short(change, alpha) &
                         (next >= zero) & (W::absolute(phi) <= T(2) * close * (p.length2 + limit2));
    if (W::any(open & ~near)) return search(open, alpha);
    alpha = open ? next : alpha;
    Tangent r;
    for (std::size_t t = 0; t < tangents; ++t) r[t] = open ? p.r[t] - change * p.fall[t] : zero;
    return r;
  }

  /// Newton's method in a bracket, from any alpha >= 0; phi and the iteration are those of
  /// solve_slip, in units of the impulse without friction.
  Tangent search(Indices open, Values& alpha) const requires(tangents > 1) {
    const Values zero{}, most = W::broadcast(std::numeric_limits<T>::max());
    const Values unit = T(1) / free_;
    Values lower{}, upper = most, trial = alpha;
    Tangent result{};
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Point p = at(trial, unit);
      const Values length = W::square_root(p.length2), phi = length - p.limit;
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
                           (W::absolute(phi) <= close * (length + p.limit));
      const Indices narrow = (upper < most) & (upper - lower <= close * close * upper);
      alpha = open ? (near ? next : trial) : alpha;
      for (std::size_t t = 0; t < tangents; ++t)
        result[t] = open ? free_ * (p.r[t] - (near ? change * p.fall[t] : zero)) : result[t];
      open = open & ~near & ~narrow;
      if (!W::any(open)) break;
      Values fallback = (lower + upper) / T(2);
      Values beyond = T(2) * lower;
      for (std::size_t t = 0; t < tangents; ++t) beyond += slip_[t];
      fallback = upper < most ? fallback : beyond;
      trial = ((next > lower) & (next < upper)) ? next : fallback;
    }
    // A load at the limit of the numbers, as in solve_slip.
    Indices finite = W::absolute(alpha) <= most;
    for (std::size_t t = 0; t < tangents; ++t) finite = finite & (W::absolute(result[t]) <= most);
    for (std::size_t t = 0; t < tangents; ++t) result[t] = finite ? result[t] : zero;
    alpha = finite ? alpha : zero;
    return result;
  }

  /// The projection onto the cone: Newton's method leaves a small distance. Impulses so small that their
  /// square underflows, whose root may be 0, stay as they are.
  Tangent onto_cone(const Tangent& r) const {
    const Values length2 = squared(r), least = W::broadcast(std::numeric_limits<T>::min());
    const Values scale = length2 >= least ? limit(r) / W::square_root(length2) : W::broadcast(1);
    Tangent on;
    for (std::size_t t = 0; t < tangents; ++t) on[t] = scale * r[t];
    return on;
  }

  Tangent coupling_, slip_;
  Values friction_, free_;
  Tangent c_;
};

}  // namespace moreau::detail
