// SPDX-License-Identifier: MIT
// Unilateral contact without friction: 0 <= u_n + offset, perpendicular to r_n >= 0; r_t = 0.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/detail/newton_restitution.hpp"
#include "moreau/law/lane_block.hpp"
#include "moreau/law/local_block.hpp"

namespace moreau {

/// Signorini's condition with Newton's restitution for one pair of materials. Model of CoulombLaw, with a coefficient of
/// friction of 0, and of LaneLaw.
template <std::floating_point T = double>
class Frictionless {
 public:
  using ActsWhereGapsClose = Frictionless;  ///< see the concept of this name
  static constexpr bool is_coulomb = true;  ///< see CoulombLaw
  /// @param restitution e in [0, 1] [-]: u_n' = -e u_n at an impact
  /// @throws std::invalid_argument for a restitution outside [0, 1]
  explicit Frictionless(T restitution = T(0)) : restitution_(restitution) {
    require(restitution >= T(0) && restitution <= T(1), "Frictionless", "restitution", restitution,
            "must lie in [0, 1]");
  }

  T restitution() const { return restitution_; }  ///< e [-]
  T friction() const { return T(0); }             ///< mu [-]

  /// Offset of u_n [m/s], see newton_restitution.hpp.
  /// @param gap    g [m], < 0 is penetration
  /// @param before u_n before the step [m/s], > 0 separates
  /// @param step   h [s], > 0
  T velocity_offset(T gap, T before, T step) const {
    return detail::newton_offset(restitution_, gap, before, step);
  }

  /// Solves the problem of one contact exactly. Returns the impulse that acts on the second body,
  /// in the contact frame, normal first [N s].
  /// @param block W of the contact [1/kg]
  /// @param b     D, relative velocity at zero impulse, with the offset [m/s]
  template <class S>
  typename S::Vector solve(const LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector&) const {
    typename S::Vector r = S::Vector::Zero();
    r[0] = std::max(T(0), -b[0] / block.normal);
    return r;
  }

  /// Empty: all laws of this type have the same local solution.
  std::array<T, 0> lane_parameters() const { return {}; }
  /// See LaneLaw: solve() itself in every lane.
  template <class S>
  static typename LaneBlock<S>::Vector solve_lanes(
      const LaneBlock<S>& block, const typename LaneBlock<S>::Vector& b,
      const typename LaneBlock<S>::Vector&, const std::array<typename LaneBlock<S>::Values, 0>&,
      typename LaneBlock<S>::Values&, bool) {
    using Values = typename LaneBlock<S>::Values;
    typename LaneBlock<S>::Vector r{};
    const Values zero{}, push = -b[0] * block.inverse_normal;
    r[0] = push > zero ? push : zero;
    return r;
  }

  /// r - P_K(r - u) with K the half-line r_n >= 0, r_t = 0; u and r in one unit, which is that of
  /// the result.
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    return r - project(Vector(r - u));
  }
  /// The projection of x onto the half-line r_n >= 0, r_t = 0, in the unit of x.
  template <class Vector>
  Vector project(const Vector& x) const {
    return Vector::Unit(0) * std::max(T(0), x[0]);
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(restitution_); }

  T restitution_;
};

}  // namespace moreau
