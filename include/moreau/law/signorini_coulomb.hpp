// SPDX-License-Identifier: MIT
// Unilateral contact with dry friction and Newton's restitution.
//
//   0 <= u_n + offset  _|_  r_n >= 0,     |r_t| <= mu r_n,  u_t = -alpha r_t with alpha >= 0,
//                                          alpha = 0 inside the cone.
//
// law/detail/coulomb_lanes.hpp derives the local solution.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"
#include "moreau/law/detail/coulomb_lanes.hpp"
#include "moreau/law/detail/newton_restitution.hpp"
#include "moreau/law/local_block.hpp"

namespace moreau {

/// Signorini's condition with Coulomb friction and Newton's restitution for one pair of materials.
/// Model of LaneLaw and StaticFrictionLaw.
template <std::floating_point T = double>
class SignoriniCoulomb {
 public:
  using ActsWhereGapsClose = SignoriniCoulomb;  ///< see the concept of this name
  static constexpr bool is_coulomb = true;      ///< see CoulombLaw
  /// @param friction    mu >= 0 [-]
  /// @param restitution e in [0, 1] [-]: u_n' = -e u_n at an impact
  /// @throws std::invalid_argument outside these ranges
  explicit SignoriniCoulomb(T friction = T(0), T restitution = T(0))
      : SignoriniCoulomb(friction, restitution, friction) {}
  /// A law with static friction. Friction acts at each contact point. A point has the friction in slip if it slid in
  /// the step before: its impulse lay on its cone, its tangential velocity at the end of the step exceeded what the
  /// solver's criterion leaves, and so did those of the other points of its face that pushed; in space one of
  /// them may rest, about which the face then turns. So a face that does not slide has the static friction at all its
  /// points, and its resultant has the threshold static_friction, however its points share the load
  /// (world/detail/sliding_points.hpp).
  /// @param friction        mu >= 0 of a contact that slid in the step before [-]
  /// @param restitution     e in [0, 1] [-]
  /// @param static_friction mu >= friction of a contact that is new, or that did not slide in the step before [-]
  /// @throws std::invalid_argument outside these ranges
  SignoriniCoulomb(T friction, T restitution, T static_friction)
      : friction_(friction), restitution_(restitution), static_(static_friction) {
    require(std::isfinite(friction) && friction >= T(0), "SignoriniCoulomb", "friction", friction,
            "must be finite and >= 0");
    require(restitution >= T(0) && restitution <= T(1), "SignoriniCoulomb", "restitution",
            restitution, "must lie in [0, 1]");
    require(std::isfinite(static_friction) && static_friction >= friction, "SignoriniCoulomb",
            "static_friction", static_friction, "must be finite and >= friction");
  }

  T friction() const { return friction_; }        ///< mu in slip [-]
  T static_friction() const { return static_; }   ///< mu at rest [-]
  T restitution() const { return restitution_; }  ///< e [-]

  /// Offset of u_n [m/s], see newton_restitution.hpp.
  /// @param gap    g [m], < 0 is penetration
  /// @param before u_n before the step [m/s], > 0 separates
  /// @param step   h [s], > 0
  /// @returns infinity if the contact cannot act in this step
  T velocity_offset(T gap, T before, T step) const {
    return detail::newton_offset(restitution_, gap, before, step);
  }

  /// The exact solution of the local problem: the impulse on b, in the frame of the contact, normal
  /// first [N s]. Its friction is friction(); static friction is that of a variant().
  /// @param block W of the contact [1/kg]
  /// @param b     D, relative velocity without impulse, with the offset [m/s]
  /// @param guess start of the iteration, zero allowed [N s]
  template <class S>
  typename S::Vector solve(const LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const {
    if (b[0] >= T(0)) return S::Vector::Zero();
    using Block = LaneBlock<S, detail::OneNumber<T>>;
    // In units of the velocity: squares of small impulses would underflow.
    const T unit = b.cwiseAbs().maxCoeff();
    const typename S::Vector velocity = b / unit;
    T squared = 0, opposed = 0;  // |r_t|^2 and -r_t . u_t of the guess, without its normal impulse
    for (int t = 0; t < S::dim - 1; ++t) {
      const T r = guess[t + 1] / unit;
      squared += r * r;
      opposed -= (velocity[t + 1] - velocity[0] * block.coupling[t] + block.slip[t] * r) * r;
    }
    T alpha = squared > T(0) && opposed > T(0) ? opposed / squared : T(0);
    if (!std::isfinite(alpha)) alpha = 0;
    Block divided;
    divided.set(0, block);
    return unit * detail::CoulombLanes<S, Block>::solve(divided, velocity, friction_, alpha, true);
  }

  /// See StatefulLaw: static friction, friction in slip.
  static constexpr std::size_t variants = 2;
  /// See StatefulLaw: 0 at rest, 1 in slip.
  SignoriniCoulomb variant(std::size_t k) const {
    return SignoriniCoulomb(k == 0 ? static_ : friction_, restitution_);
  }
  /// See StatefulLaw: 1 if the impulse [N s] lies on the cone of variant k, without which a contact does not slide. Always
  /// 0 if static and kinetic friction are equal.
  template <class Vector>
  std::size_t variant_after(std::size_t k, const Vector& impulse) const {
    if (static_ == friction_ || !(impulse[0] > T(0))) return 0;
    // Relative to the normal impulse: squares of small and of large impulses cannot be represented.
    const T share = (impulse.template tail<Vector::RowsAtCompileTime - 1>() / impulse[0]).norm();
    const T limit = k == 0 ? static_ : friction_;
    return share >= limit * (T(1) - std::sqrt(std::numeric_limits<T>::epsilon())) ? 1 : 0;
  }

  /// See StaticFrictionLaw.
  bool has_static_friction() const { return static_ != friction_; }
  /// See StaticFrictionLaw.
  std::size_t variant_at_rest(std::size_t) const { return 0; }

  /// See LaneLaw: the friction [-].
  std::array<T, 1> lane_parameters() const { return {friction_}; }
  /// See LaneLaw: CoulombLanes, whose memory is alpha.
  template <class S>
  static typename LaneBlock<S>::Vector solve_lanes(
      const LaneBlock<S>& block, const typename LaneBlock<S>::Vector& b,
      const typename LaneBlock<S>::Vector&,
      const std::array<typename LaneBlock<S>::Values, 1>& parameters,
      typename LaneBlock<S>::Values& memory, bool polish) {
    return detail::CoulombLanes<S>::solve(block, b, parameters[0], memory, polish);
  }
  /// See MapsLanes.
  template <class S>
  static typename LaneBlock<S>::Vector natural_map_lanes(
      const typename LaneBlock<S>::Vector& u, const typename LaneBlock<S>::Vector& r,
      const std::array<typename LaneBlock<S>::Values, 1>& parameters) {
    return detail::CoulombLanes<S>::natural_map(u, r, parameters[0]);
  }

  /// r - P_K(r - (u + mu |u_t| n)), K the Coulomb cone. Zero iff (u, r) satisfies the law
  /// (G. De Saxce and Z.-Q. Feng, Math. Comput. Modelling 28 (1998) 225).
  /// @param u,r D entries, normal first, in one unit, which is that of the result
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    Vector x = r - u;
    x[0] -= friction_ * u.template tail<tangents>().norm();
    return r - project(x);
  }

  /// The projection of x onto the cone |x_t| <= mu x_n; D entries, normal first, in the unit of x.
  template <class Vector>
  Vector project(const Vector& x) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    const T length = x.template tail<tangents>().norm();
    if (friction_ * length <= -x[0]) return Vector::Zero();  // first: 0 <= -0 would hold below
    if (length <= friction_ * x[0]) return x;
    const T normal = (x[0] + friction_ * length) / (T(1) + friction_ * friction_);
    Vector p;
    p[0] = normal;
    for (int k = 1; k <= tangents; ++k) p[k] = x[k] * (friction_ * normal / length);
    return p;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(friction_, restitution_, static_); }

  T friction_, restitution_, static_;
};

}  // namespace moreau
