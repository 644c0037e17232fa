// SPDX-License-Identifier: MIT
// Fabric tensor: the distribution of the orientations of contact normals in an assembly.
#pragma once

#include <cstddef>
#include <span>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/value.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/detail/of_simulation.hpp"
#include "moreau/measure/pair_forces.hpp"

namespace moreau {

/// Distribution of the orientations of contact normals.
template <class S>
struct Fabric {
  /// Mean of n n^T over the pairs, where n is the contact normal of a pair: D x D, world axes,
  /// symmetric, trace 1 [-]. For isotropic normals it is identity / D. Zero if there are no pairs.
  Value<typename S::Matrix> tensor = S::Matrix::Zero();
  std::size_t pairs = 0;  ///< number of pairs counted

  /// The anisotropy tensor a: D x D, world axes, symmetric, trace 0 [-]. E(n) = (1 + n . a n) /
  /// (area of the unit sphere) is the probability density of normals with the same mean of n n^T.
  /// It follows a = D (D + 2)/2 (tensor - identity / D). In the plane its eigenvalues are +-a of
  /// the usual form E = (1 + a cos 2(theta - theta_c)) / 2 pi, with theta the angle of the normal.
  /// Source: K. Kanatani, Int. J. Eng. Sci. 22 (1984) 149, fabric tensors of the third kind.
  Value<typename S::Matrix> anisotropy() const {
    using Scalar = typename S::Scalar;
    if (pairs == 0) return S::Matrix::Zero();
    constexpr Scalar dim = S::dim;
    return dim * (dim + 2) / 2 * (tensor - S::Matrix::Identity() / dim);
  }
};

/// The fabric tensor of the pairs of grains that carry force and have their centre of pressure in
/// the control volume. Each pair has the same weight, whatever its force and its number of points.
/// Contacts with walls are not counted, because the walls prescribe their normals.
/// @param pairs          result of pair_forces()
/// @param control_volume world axes [m]
/// @param position_of    function: index of a body -> its centre of mass in world axes [m]
/// @param is_grain       function: index of a body (BodyId::index()) -> false for a wall or an obstacle
/// @param cell           periodic cell of the simulation. A pair is counted if one of its images
///                       lies in the control volume, which must not be longer than the cell
/// @throws std::invalid_argument if the control volume is empty, inverted, not finite, or longer than
///         the periodic cell
/// Source: M. Satake, IUTAM Conf. on Deformation and Failure of Granular Materials (1982) 63.
template <class S>
Fabric<S> fabric(std::span<const PairForce<S>> pairs, const Aabb<S>& control_volume,
                 const auto& position_of, const auto& is_grain, const PeriodicCell<S>& cell = {}) {
  require_control_volume(control_volume, "fabric");
  require_within(cell, control_volume, "fabric");
  Fabric<S> result;
  detail::DoubleSum<typename S::Matrix> sum;
  for (const PairForce<S>& pair : pairs) {
    if (!is_grain(pair.a) || !is_grain(pair.b)) continue;
    const typename S::Vector point =
        cell.image_in(control_volume, typename S::Vector(position_of(pair.a) + pair.lever_a));
    if (!control_volume.contains(point)) continue;
    sum += pair.normal * pair.normal.transpose();
    ++result.pairs;
  }
  if (result.pairs > 0) result.tensor = sum.over(double(result.pairs));
  return result;
}

/// The same for the grains of a simulation and its last step, also in a periodic cell. An obstacle, a grain of prescribed
/// motion, counts as a wall.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
template <class Simulation>
Fabric<typename Simulation::S> fabric(const Simulation& simulation,
                                      typename Simulation::Scalar step,
                                      const Aabb<typename Simulation::S>& control_volume) {
  using S = typename Simulation::S;
  const auto pairs = pair_forces(simulation, step);
  return fabric<S>(std::span<const PairForce<S>>(pairs), control_volume,
                   detail::position_in(simulation), detail::free_grain_in(simulation),
                   simulation.cell());
}

}  // namespace moreau
