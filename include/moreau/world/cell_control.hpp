// SPDX-License-Identifier: MIT
// How a periodic cell deforms.
//
// H are the vectors of the cell, L = dH/dt H^-1 its velocity gradient. A body at x has the velocity
//
//     dx/dt = L (x - corner of the cell) + p.
//
// p is its velocity relative to the cell, the velocity that a Simulation stores: it is the same for all
// images of a body, and for all vectors of the same lattice. With the forces F the equation of motion is
//
//     m dp/dt = F - m L p,
//
// the SLLOD equation (D. J. Evans and G. P. Morriss, Statistical Mechanics of Nonequilibrium Liquids, 2nd
// ed., Cambridge 2008, chapter 6). It is Newton's law, d(dx/dt)/dt = F/m, where dL/dt + L^2 = 0, as in steady
// simple shear; otherwise Newton's law has the force -m (dL/dt + L^2) (x - corner) besides, which would move
// far images by other accelerations than those of the cell.
//
// A change of L therefore moves bodies with the cell, and changes no p: a loose assembly is deformed as a
// continuum, without contacts. The relative velocity of a contact between the bodies a and b is that of p
// and of the spins, and L d, d being the vector from the centre of a to that of the image of b.
//
// One step of h: a prescribed L is constant. Positions x and vectors H are multiplied by (1 - (1 - theta) h L)^-1 before
// the contacts are detected and by 1 + theta h L after the contact problem is solved. With theta = 1/2 a
// cell with the rates e and -e along two axes keeps its volume to rounding.
//
// The energy of the bodies, sum m p^2 / 2 with that of the spins, changes by the work of the contacts and
// by that of the cell,
//
//     -h V trace(sigma L),   V sigma = sum over contacts d f^T + sum over grains m p p'^T,
//
// with the force f on b, p before the step and p' the mean of p before and after it. sigma is the stress
// of the cell, compression positive. With this mean the balance of a step holds to rounding.
//
// A component of L either is prescribed or moves by the stress (after F. Radjai and C. Voivret, Periodic
// boundary conditions, in: Discrete-element Modeling of Granular Materials, ISTE-Wiley, 2011, who give the
// cell a mass; the equation here is this library's own):
//
//     m_ij V^(2/D) dL_ij/dt = V (sigma_ji - sigma0_ij) - c m_ij V^(2/D) L_ij.
//
// The equation is implicit: sigma has the contact forces of the step, and the velocities of the contacts are those with
// the rate L+ at the end of the step. The cell is a body with the velocity L that all contacts touch, so that jammed
// grains without compliance can bear a stress. detail/cell/cell_servo.hpp solves both together. Between L before the step and
// L+, the cell moves as a body does: with L up to the detection, with L+ from then on; the work of the contacts has the
// mean of both, that of the velocities (the sum over grains) has L.
#pragma once

#include <cmath>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// How a periodic cell deforms; the head of this file has the equations.
template <EuclideanSpace S>
struct CellControl {
  using Scalar = typename S::Scalar;
  using Matrix = typename S::Matrix;

  /// Velocity gradient L, world axes [1/s]: rate(0, 1) > 0 shears the cell along x with y. Components with a
  /// mass start with it.
  Matrix rate = Matrix::Zero();
  /// sigma0, compression positive, world axes [Pa], in the plane [N/m]. Only components with a mass use it.
  Matrix stress = Matrix::Zero();
  /// Mass of the cell for each component [kg], >= 0; 0: the rate of the component is prescribed. The order
  /// of the mass of all grains is a good value.
  Matrix mass = Matrix::Zero();
  Scalar damping = 0;  ///< c of the components with a mass [1/s], >= 0

  /// @throws std::invalid_argument for a number that is not finite, a mass or damping < 0, or a stress of a component
  ///         without a mass, which would be ignored
  void check(const char* function) const {
    require(all_finite(rate), function, "rate", rate, "must be finite");
    require(all_finite(stress), function, "stress", stress, "must be finite");
    require(all_finite(mass) && mass.minCoeff() >= 0, function, "mass", mass,
            "must be finite and >= 0");
    // A symmetric stress may have one of the two components of a shear held.
    for (int i = 0; i < S::dim; ++i)
      for (int j = 0; j < S::dim; ++j)
        require(
            stress(i, j) == 0 || mass(i, j) > 0 || (mass(j, i) > 0 && stress(j, i) == stress(i, j)),
            function, "mass", mass, "must be > 0 for components that follow a stress");
    require(std::isfinite(damping) && damping >= 0, function, "damping", damping,
            "must be finite and >= 0");
  }
  /// See core/serialize.hpp.
  auto serialized_members() { return std::tie(rate, stress, mass, damping); }
};

}  // namespace moreau
