// SPDX-License-Identifier: MIT
// The kinetic energy that the impulses of a step give the bodies, from the velocities of the bodies alone: of a body
//
//     d . M (2 v_f + d) / 2
//
// with the velocities v_f without the impulses and v_f + d with them. M of a wall that forces move along some axes is its
// mass along these, if it is at rest along the others.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau::detail {

/// What bounds say about the bodies of a step.
enum class BodiesGain { none, perhaps_some, unknown };

/// Twice the change of the energy of the translation of a body [J].
/// @param change d
/// @param sum    2 v_f + d
template <class S>
double energy_along(const Bodies<S>& bodies, std::size_t i, const typename S::Twist& change,
                    const typename S::Twist& sum) {
  return double(bodies.grain_mass[i]) * double(linear<S>(change).dot(linear<S>(sum)));
}
/// Whether a body that forces move is a wall: it moves along axes of its own, and does not rotate.
template <class S>
bool is_moved_wall(const Bodies<S>& bodies, std::size_t i) {
  return !bodies.rotates(i) && !(bodies.grain_mass[i] > 0);
}
/// Twice the change of the energy of such a wall [J]; infinite if it moves along an axis that is prescribed.
template <class S>
double energy_of_wall(const Bodies<S>& bodies, std::size_t i, const typename S::Twist& change,
                      const typename S::Twist& free) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (!angular<S>(free).isZero(0)) return unknown;
  const typename S::Matrix axes = bodies.axes(i);
  double sum = 0;
  for (int k = 0; k < S::dim; ++k) {
    const double own = double(axes.col(k).dot(linear<S>(free))),
                 by = double(axes.col(k).dot(linear<S>(change)));
    if (bodies.inverse_mass[i][k] > 0)
      sum += by * (2 * own + by) / double(bodies.inverse_mass[i][k]);
    else if (own != 0)
      return unknown;
  }
  return sum;
}
/// 2 v_f + d
template <class S>
typename S::Twist sum_of_velocities(const typename S::Twist& free,
                                    const typename S::Twist& change) {
  typename S::Twist sum;
  for (int k = 0; k < S::dofs; ++k) sum[k] = 2 * free[k] + change[k];
  return sum;
}

/// Whether a body gains energy. It is known of grains that turn, of walls that forces move, and of prescribed bodies at
/// rest.
/// @param op   operator with the velocities of the impulses
/// @param free v_f of every body [m/s, rad/s]
template <class S>
MOREAU_INLINED inline BodiesGain gain_of_bodies(const Bodies<S>& bodies, const auto& op,
                                                std::span<const typename S::Twist> free) {
  bool any = false;  // may gain
  for (std::size_t i = 0; i < free.size(); ++i) {
    const typename S::Twist change = op.velocity_change(i);
    if (bodies.is_prescribed(i) ? free[i].isZero(0) : change.isZero(0)) continue;
    if (is_moved_wall(bodies, i)) {
      const double gain = energy_of_wall(bodies, i, change, free[i]);
      if (std::isinf(gain)) return BodiesGain::unknown;
      any = any || !(gain <= 0);
      continue;
    }
    if (!bodies.rotates(i) || !op.inverse_mass(i).is_isotropic() || !(bodies.grain_mass[i] > 0))
      return BodiesGain::unknown;
    const typename S::Twist sum = sum_of_velocities<S>(free[i], change);
    // The inertia is bounded by its norm.
    const double about = double(angular<S>(change).norm()) * double(angular<S>(sum).norm());
    any = any || !(energy_along(bodies, i, change, sum) +
                       bodies.inertia_body[i].template cast<double>().norm() * about <=
                   0);
  }
  return any ? BodiesGain::perhaps_some : BodiesGain::none;
}
/// Adds twice the energy of every body to a sum [J]. Not for BodiesGain::unknown.
/// @param sum_of function: body -> reference to the sum of its island
template <class S>
MOREAU_COLD void add_gains(const Bodies<S>& bodies, const auto& op,
                           std::span<const typename S::Twist> free, const auto& sum_of) {
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (bodies.is_prescribed(i)) continue;
    const typename S::Twist change = op.velocity_change(i);
    if (is_moved_wall(bodies, i)) {
      if (!change.isZero(0)) sum_of(i) += energy_of_wall(bodies, i, change, free[i]);
      continue;
    }
    const typename S::Twist sum = sum_of_velocities<S>(free[i], change);
    const typename S::Inertia axes = S::adjoint(bodies.pose[i].rotation);
    const typename S::Angular turn = transposed_product(axes, angular<S>(change));
    sum_of(i) +=
        energy_along(bodies, i, change, sum) +
        double(
            product(bodies.inertia_body[i], turn).dot(transposed_product(axes, angular<S>(sum))));
  }
}

}  // namespace moreau::detail
