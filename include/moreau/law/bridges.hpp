// SPDX-License-Identifier: MIT
// Attraction through a bridge that forms when two bodies touch and breaks when their gap exceeds a rupture
// distance: a law with a memory of one bit per pair of bodies. The attraction f(g) is an external force along the
// normal; the push against it obeys the law, as in cohesive.hpp:
//
//     0 <= u_n + offset  _|_  r_n + h f(g) >= 0,     |r_t| <= mu (r_n + h f(g)).
//
// A pair has one bridge, also if it has several contact points: n points have f(g) / n each, g being the gap of the
// point; the least gap of the pair decides on the rupture. Contacts of a pair with a bridge are kept up to the rupture
// distance, those of other pairs up to the margin.
//
// CapillaryBridge is a small bridge of liquid between two spheres of the radius R:
//
//     f(g) = 2 pi R gamma cos(theta) / (1 + 1.05 s + 2.5 s^2),    s = max(0, g) sqrt(R / V),
//     rupture at g = (1 + theta / 2) V^(1/3).
//
// The force is the closed form of C. D. Willett, M. J. Adams, S. A. Johnson and J. P. K. Seville, Langmuir 16 (2000)
// 9396, for volumes V up to some 1e-3 R^3. The rupture distance is that of G. Lian, C. Thornton and M. J. Adams,
// J. Colloid Interface Sci. 161 (1993) 138. Between unequal bodies R is the harmonic mean of their radii, twice the
// effective radius 1 / (1/R_a + 1/R_b) (Derjaguin's approximation); a wall is plane. Of grains that are not round the
// radius is the distance from the centre of mass to the contact point. Disks of the plane count as spheres: their
// densities must then give the masses of spheres.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {

/// A bridge of liquid between two spheres; the head of this file has its equations and their sources.
template <std::floating_point T = double>
class CapillaryBridge {
 public:
  using Scalar = T;

  /// @param volume          V > 0 of the bridge of a pair [m^3], also in the plane
  /// @param surface_tension gamma >= 0 of the liquid [N/m]
  /// @param contact_angle   theta in [0, pi/2] of the liquid on the grains [rad]
  /// @throws std::invalid_argument outside these ranges
  explicit CapillaryBridge(T volume, T surface_tension = T(0.0728), T contact_angle = T(0))
      : volume_(volume), tension_(surface_tension), angle_(contact_angle) {
    constexpr const char* self = "CapillaryBridge";
    require_positive(volume, self, "volume");
    require(std::isfinite(surface_tension) && surface_tension >= 0, self, "surface_tension",
            surface_tension, "must be finite and >= 0");
    require(contact_angle >= 0 && contact_angle <= std::numbers::pi_v<T> / 2, self, "contact_angle",
            contact_angle, "must lie in [0, pi/2]");
  }

  T volume() const { return volume_; }            ///< V [m^3]
  T surface_tension() const { return tension_; }  ///< gamma [N/m]
  T contact_angle() const { return angle_; }      ///< theta [rad]
  /// The gap at which the bridge breaks [m].
  T rupture_distance() const { return (1 + angle_ / 2) * std::cbrt(volume_); }
  /// The attraction f(gap) >= 0 [N].
  /// @param gap    [m], < 0 is penetration
  /// @param radius R of two equal spheres, > 0 [m]
  T force(T gap, T radius) const {
    const T s = std::max(T(0), gap) * std::sqrt(radius / volume_);
    return 2 * std::numbers::pi_v<T> * radius * tension_ * std::cos(angle_) /
           (1 + s * (T(1.05) + T(2.5) * s));
  }

 private:
  friend struct SerializationAccess;
  CapillaryBridge() = default;  // to be read from a snapshot
  auto serialized_members() { return std::tie(volume_, tension_, angle_); }

  T volume_ = 1, tension_ = 0, angle_ = 0;
};

/// An attraction that falls linearly with the gap: f(g) = gamma (1 - max(0, g) / range), rupture at g = range.
template <std::floating_point T = double>
class LinearCohesion {
 public:
  using Scalar = T;

  /// @param adhesion gamma >= 0, of a pair [N]
  /// @param range    > 0 [m]
  /// @throws std::invalid_argument outside these ranges
  LinearCohesion(T adhesion, T range) : adhesion_(adhesion), range_(range) {
    constexpr const char* self = "LinearCohesion";
    require(std::isfinite(adhesion) && adhesion >= 0, self, "adhesion", adhesion,
            "must be finite and >= 0");
    require_positive(range, self, "range");
  }

  T adhesion() const { return adhesion_; }       ///< gamma [N]
  T rupture_distance() const { return range_; }  ///< gap at which the attraction ends [m]
  /// The attraction f(gap) >= 0 [N]; it does not depend on the radius.
  T force(T gap, T) const { return adhesion_ * std::max(T(0), 1 - std::max(T(0), gap) / range_); }

 private:
  friend struct SerializationAccess;
  LinearCohesion() = default;  // to be read from a snapshot
  auto serialized_members() { return std::tie(adhesion_, range_); }

  T adhesion_ = 0, range_ = 1;
};

namespace detail {

/// Whether a class has what Bridged asks of a bridge. Not a concept: the compiler would give its reasons beside the sentence.
template <class B>
inline constexpr bool gives_bridge_force = requires(const B& bridge, typename B::Scalar x) {
  { bridge.rupture_distance() } -> std::convertible_to<typename B::Scalar>;
  { bridge.force(x, x) } -> std::convertible_to<typename B::Scalar>;
};
/// Scalar of a bridge; of anything else, which Bridged refuses, double.
template <class B>
struct ScalarOfBridge {
  using type = double;
};
template <class B>
requires requires {
  typename B::Scalar;
}
struct ScalarOfBridge<B> {
  using type = typename B::Scalar;
};

}  // namespace detail

/// A law whose bodies attract each other from their first touch to the rupture of a bridge; the head of this file has
/// its equations. Model of BridgingLaw; rolling, static friction and lanes of the law stay as they are.
/// @tparam Bridge CapillaryBridge or LinearCohesion, or a class with their functions rupture_distance() and force()
/// @tparam Law    set-valued law of the push
template <class Bridge, class Law = SignoriniCoulomb<typename detail::ScalarOfBridge<Bridge>::type>>
class Bridged : public Law {
  static_assert(detail::gives_bridge_force<Bridge>,
                "Bridged<Bridge, Law>: Bridge must be CapillaryBridge, LinearCohesion or a class "
                "with their functions rupture_distance() and force(gap, radius); the law of the "
                "push comes second");
  static_assert(
      !detail::Attracts<Law>,
      "Bridged<Bridge, Law>: Law has an attraction of its own, and a contact has one attraction");
  static_assert(!detail::HasSprings<Law>,
                "Bridged<Bridge, Law>: Law has springs; they go outside: Compliant<Bridged<..>>");
  static_assert(
      !detail::gives_bridge_force<Bridge> ||
          detail::GivesImpulses<Law, typename detail::ScalarOfBridge<Bridge>::type>,
      "Bridged<Bridge, Law>: Law gives no impulses (velocity_offset) in the scalar of Bridge");
  static constexpr std::size_t variants_of_law() {
    if constexpr (requires(const Law& law) {
                    { law.variant(0) } -> std::same_as<Law>;
                  })  // deleted where a law derives from one with variants
      return Law::variants;
    else
      return 1;
  }

 public:
  using Scalar = typename detail::ScalarOfBridge<Bridge>::type;

  /// @param bridge its force and its rupture
  /// @param law    the law without bridge
  explicit Bridged(const Bridge& bridge, const Law& law = Law{}) : Law(law), bridge_(bridge) {}

  const Bridge& bridge() const { return bridge_; }  ///< its force and its rupture
  /// See BridgingLaw: the largest gap with attraction [m].
  Scalar reach() const { return bridge_.rupture_distance(); }
  /// See BridgingLaw: the attraction of a pair with a bridge, >= 0 [N].
  /// @param gap    [m], < 0 is penetration
  /// @param radius twice the effective radius of the contact [m]
  Scalar bridge_force(Scalar gap, Scalar radius) const { return bridge_.force(gap, radius); }

  /// See StatefulLaw: those of the law without bridge, then those with a bridge.
  static constexpr std::size_t variants = 2 * variants_of_law();
  /// Whether variant k has a bridge.
  static constexpr bool is_bridged(std::size_t k) { return k >= variants_of_law(); }
  /// Variant k with or without a bridge.
  static constexpr std::size_t with_bridge(std::size_t k, bool bridged) {
    return k % variants_of_law() + (bridged ? variants_of_law() : 0);
  }
  /// See StatefulLaw: the push obeys that variant of the law, k < variants.
  Bridged variant(std::size_t k) const {
    if constexpr (variants_of_law() > 1)
      return Bridged(bridge_, Law::variant(k % variants_of_law()));
    else
      return *this;
  }
  /// See StatefulLaw; the bridge stays as it is.
  template <class Vector>
  std::size_t variant_after(std::size_t k, const Vector& push) const {
    if constexpr (variants_of_law() > 1)
      return with_bridge(Law::variant_after(k % variants_of_law(), push), is_bridged(k));
    else
      return k;
  }
  /// See StaticFrictionLaw; the bridge stays as it is.
  std::size_t variant_at_rest(std::size_t k) const
      requires(requires(const Law& law) { law.variant_at_rest(k); }) {
    if constexpr (variants_of_law() > 1)
      return with_bridge(Law::variant_at_rest(k % variants_of_law()), is_bridged(k));
    else
      return k;
  }

 protected:
  Bridged() : bridge_(SerializationAccess::blank<Bridge>()) {}  ///< to be read from a snapshot

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(static_cast<Law&>(*this), bridge_); }

  Bridge bridge_;
};

}  // namespace moreau
