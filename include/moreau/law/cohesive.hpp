// SPDX-License-Identifier: MIT
// Adhesion added to any set-valued law. Up to a range of the gap, the two bodies attract each other
// with a constant force gamma along the normal. The push against it, r + gamma h, obeys the law,
//
//     0 <= u_n + offset  _|_  r_n + gamma h >= 0,     |r_t| <= mu (r_n + gamma h),
//
// so that a contact holds up to a tension gamma and slides at mu gamma without load. The gap of a
// contact that holds is not exactly 0: rounding and the residual of the solver leave some 1e-9 to
// 1e-6 of the grain size. A range below these gaps holds nothing together (the law of
// LMGC90's cohesive Signorini-Coulomb contacts; F. Radjai and F. Dubois, eds., Discrete-element
// Modeling of Granular Materials, Wiley 2011, ch. 1).
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {

/// A law with a constant attraction up to a range of the gap; the head of this file has its
/// equations. Model of AttractiveLaw.
/// @tparam Law    set-valued law of the push; static friction, rolling and lanes stay as they are
/// @tparam Scalar scalar of the law
template <class Law = SignoriniCoulomb<>,
          std::floating_point Scalar = typename detail::ImpulseScalar<Law>::type>
class Cohesive : public Law {
  static_assert(
      !detail::Attracts<Law>,
      "Cohesive<Law>: Law has an attraction of its own, and a contact has one attraction");
  static_assert(!detail::HasSprings<Law>,
                "Cohesive<Law>: Law has springs; they go outside: Compliant<Cohesive<..>>");
  static_assert(detail::GivesImpulses<Law, Scalar>,
                "Cohesive<Law>: Law gives no impulses (velocity_offset) in the scalar of Cohesive");

 public:
  /// @param law      the law without adhesion
  /// @param adhesion gamma >= 0, per contact point [N]: an edge (in the plane) that lies on a face holds 2 gamma, the face
  ///                 of a cube 4 gamma, a ball one. LinearCohesion (bridges.hpp) is per pair of bodies
  /// @param range    largest gap with adhesion, > 0 [m]. Contacts are detected up to it, if it is above the margin
  ///                 (Tolerances::margin). The default is infinite: every contact attracts, up to the margin
  /// @throws std::invalid_argument outside these ranges
  explicit Cohesive(const Law& law = Law{}, Scalar adhesion = 0,
                    Scalar range = std::numeric_limits<Scalar>::infinity())
      : Law(law), adhesion_(adhesion), range_(range) {
    require(std::isfinite(adhesion) && adhesion >= 0, "Cohesive", "adhesion", adhesion,
            "must be finite and >= 0");
    require(range > 0, "Cohesive", "range", range,
            "must be > 0, above the gaps that rounding leaves");
  }

  Scalar adhesion() const { return adhesion_; }  ///< gamma [N]
  Scalar range() const { return range_; }        ///< largest gap with adhesion [m]
  /// Force with which the bodies attract each other along the normal at this gap [m], >= 0 [N].
  Scalar attraction(Scalar gap) const { return gap <= range_ ? adhesion_ : Scalar(0); }
  /// See StatefulLaw: the push obeys that variant of the law, k < variants.
  Cohesive variant(std::size_t k) const requires requires(const Law& law) {
    { law.variant(k) } -> std::same_as<Law>;
  }
  { return Cohesive(Law::variant(k), adhesion_, range_); }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(static_cast<Law&>(*this), adhesion_, range_); }

  Scalar adhesion_, range_;
};

}  // namespace moreau
