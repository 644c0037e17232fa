// SPDX-License-Identifier: MIT
// The local solution of Signorini's and Coulomb's conditions, one contact per lane: what
// SignoriniCoulomb::solve does, without branches. Two of its three cases are exact; slip in space
// is iterated until one Newton step from the exact root at most a hundredth of the impulse is at
// stake, and takes that step. From sweep to sweep the guess is the last impulse, so the error is
// squared each time and the only fixed point is the exact solution.
#pragma once

#include <cstddef>
#include <limits>

#include "moreau/contact/lane_problem.hpp"

namespace moreau::detail {

/// One local problem per lane, in units of the impulse that it would take without friction.
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

  static Vector solve(const Block& block, const Vector& b, const Vector& guess,
                      const Values& friction) {
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
      const Tangent sliding = problem.slide(guess, slips & (friction > zero));
      normal = slips ? free : normal;
      for (std::size_t t = 0; t < tangents; ++t) {
        tangent[t] = slips ? free * sliding[t] : tangent[t];
        normal = slips ? normal - block.coupling[t] * tangent[t] : normal;
      }
    }
    Vector r;
    r[0] = acts ? normal : zero;
    for (std::size_t t = 0; t < tangents; ++t) r[t + 1] = acts ? tangent[t] : zero;
    return r;
  }

 private:
  /// |phi| relative to |r_t| + mu r_n within which one more Newton step is the last.
  static constexpr T close = T(0.01);

  /// @param c    b_t - q b_n
  /// @param free impulse without friction, the unit of all that follows
  CoulombLanes(const Block& block, const Tangent& c, const Values& free, const Values& friction)
      : coupling_(block.coupling), slip_(block.slip), friction_(friction), unit_(T(1) / free) {
    for (std::size_t t = 0; t < tangents; ++t) c_[t] = c[t] * unit_;
  }

  static Values squared(const Tangent& r) {
    Values sum{};
    for (std::size_t t = 0; t < tangents; ++t) sum += r[t] * r[t];
    return sum;
  }
  /// mu r_n.
  Values limit(const Tangent& r) const {
    Values sum = W::broadcast(1);
    for (std::size_t t = 0; t < tangents; ++t) sum -= coupling_[t] * r[t];
    return friction_ * sum;
  }

  /// alpha that the guess implies, u_t = -alpha r_t; 0 where it implies none.
  Values start(const Vector& guess) const {
    const Values zero{};
    Values above{}, below{};
    for (std::size_t t = 0; t < tangents; ++t) {
      const Values g = guess[t + 1] * unit_;
      above -= (c_[t] + slip_[t] * g) * g;
      below += g * g;
    }
    const Values alpha = above / (below > zero ? below : W::broadcast(1));
    const Values most = W::broadcast(std::numeric_limits<T>::max());
    return ((alpha > zero) & (alpha <= most)) ? alpha : zero;
  }

  /// Tangential impulse of the lanes that slip in the plane: r_t = s mu r_n with a constant sign s.
  Tangent slide(const Vector&, const Indices&) const requires(tangents == 1) {
    const Values s = c_[0] > Values{} ? -friction_ : friction_;
    return {s / (T(1) + s * coupling_[0])};
  }

  /// The same in space; phi and the iteration as in solve_slip.
  Tangent slide(const Vector& guess, Indices open) const requires(tangents > 1) {
    const Values zero{}, most = W::broadcast(std::numeric_limits<T>::max());
    Values lower{}, upper = most, alpha = start(guess);
    Tangent result{};
    for (int iteration = 0; iteration < 100; ++iteration) {
      Tangent r, fall;  // r_t and -dr_t/dalpha
      Values along{}, limit_slope{};
      for (std::size_t t = 0; t < tangents; ++t) {
        const Values inverse = T(1) / (slip_[t] + alpha);
        r[t] = -c_[t] * inverse;
        fall[t] = r[t] * inverse;
        along += r[t] * fall[t];
        limit_slope += coupling_[t] * fall[t];
      }
      limit_slope *= friction_;
      const Values length2 = squared(r), length = W::square_root(length2);
      const Values most_r = limit(r), phi = length - most_r;
      const Indices positive = most_r > zero;
      const Values change = (positive ? phi * length2 * most_r : phi * length) /
                            (positive ? limit_slope * length2 * length + along * most_r * most_r
                                      : along + limit_slope * length);
      lower = phi > zero ? alpha : lower;
      upper = phi > zero ? upper : alpha;
      const Indices near = W::absolute(phi) <= close * (length + W::absolute(most_r));
      const Indices narrow = (upper < most) & (upper - lower <= close * close * upper);
      for (std::size_t t = 0; t < tangents; ++t)
        result[t] = open ? r[t] - (near ? change * fall[t] : zero) : result[t];
      open = open & ~near & ~narrow;
      if (!W::any(open)) break;
      const Values next = alpha + change;
      Values fallback = (lower + upper) / T(2);
      Values beyond = T(2) * lower;
      for (std::size_t t = 0; t < tangents; ++t) beyond += slip_[t];
      fallback = upper < most ? fallback : beyond;
      alpha = ((next > lower) & (next < upper)) ? next : fallback;
    }
    return onto_cone(result);
  }

  /// On the cone to the last digit, whatever Newton left.
  Tangent onto_cone(const Tangent& r) const {
    const Values zero{}, length2 = squared(r);
    const Values scale = length2 > zero ? limit(r) / W::square_root(length2) : zero;
    Tangent on;
    for (std::size_t t = 0; t < tangents; ++t) on[t] = scale * r[t];
    return on;
  }

  Tangent coupling_, slip_;
  Values friction_, unit_;
  Tangent c_;
};

}  // namespace moreau::detail
