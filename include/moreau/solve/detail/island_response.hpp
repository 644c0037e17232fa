// SPDX-License-Identifier: MIT
// The law of one contact of an island, as solve/detail/proximal_step.hpp needs it: Coulomb's law, or that with couples.
#pragma once

#include <Eigen/Core>

#include "moreau/solve/detail/couple_response.hpp"
#include "moreau/solve/detail/island_points.hpp"
#include "moreau/solve/detail/sliding_face.hpp"

namespace moreau::detail {

/// Lift and response of a contact of an island.
/// @tparam Couples whether a contact has D + A rows and a coefficient of rolling resistance
template <class SpaceT, bool Couples>
struct IslandResponse {
  using Points = IslandPoints<SpaceT, Couples>;
  using S = typename Points::S;
  using Point = typename Points::Point;
  using Vector = typename Points::Vector;
  using Response = ContactResponse<Points::rows_of_contact>;

  /// sigma of a contact with the velocity u [m/s].
  static double lift(const Point& point, const Vector& u) {
    if constexpr (Couples)
      return point.friction * slip_of<S>(u) + point.rolling * couple_of<S>(u);
    else
      return point.friction * slip_of<S>(u);
  }
  /// Whether at() has no impulse.
  static bool is_without(const Point& point, const Vector& b) {
    if constexpr (Couples)
      return is_open<S>(point.friction, point.rolling, b);
    else
      return is_open<S>(point.friction, b);
  }
  /// The response to b, with the lift, and the compliances s [1/kg].
  static Response at(const Point& point, const Vector& s, const Vector& b) {
    if constexpr (Couples)
      return couple_response<S>(point.friction, point.rolling, s, b);
    else
      return response<S>(point.friction, s, b);
  }
  /// The response whose friction and couple have given limits.
  /// @param limit,roll_limit of |r_t| and |m|; the second is not used without couples [N s]
  static Response within(double limit, [[maybe_unused]] double roll_limit, const Vector& s,
                         const Vector& b) {
    if constexpr (Couples)
      return couple_response_within<S>(limit, roll_limit, s, b);
    else
      return response_within<S>(limit, s, b);
  }
};

}  // namespace moreau::detail
