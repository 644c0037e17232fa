// SPDX-License-Identifier: MIT
// Declares the usual simulations as compiled elsewhere, so that a unit that includes this header compiles in
// seconds. The library that has them is the CMake target moreau::instances, which also includes this header
// in the units that link it; without CMake it is built by the Makefile beside its sources
// (examples/guide/taking-in.md).
//
//   scalar   double
//   shapes   balls, polyhedra, capsules, compounds of polyhedra; in the plane the same
//   laws     SignoriniCoulomb, RollingResistance, Compliant<SignoriniCoulomb>
//   policies the default integrator, broad phase and solver
//   files    snapshots of these simulations, and their files for ParaView
//   measures EnergyBalance
//
// Other shapes under the same laws share the solver with them.
#pragma once

#include "moreau/instances/detail/instance.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {
/// @cond instances
namespace detail {
/// Vectors of Eigen are aligned by the flags of the compiler. A program that is compiled with other flags than the
/// library misses this number when it is linked, before it reads vectors at wrong places.
template <int AlignBytes>
struct InstancesCompiledWithTheSameFlags {
  static const char yes;
};
extern template struct InstancesCompiledWithTheSameFlags<EIGEN_MAX_STATIC_ALIGN_BYTES>;
[[gnu::used]] inline const char* const instances_flags =
    &InstancesCompiledWithTheSameFlags<EIGEN_MAX_STATIC_ALIGN_BYTES>::yes;
}  // namespace detail
MOREAU_BALL_AND_POLYTOPE_INSTANCES(extern template, Disk<double>, Polygon<double>)
MOREAU_BALL_AND_POLYTOPE_INSTANCES(extern template, Ball<double>, Polyhedron<double>)
MOREAU_CAPSULE_AND_COMPOUND_INSTANCES(extern template, Stadium<double>, Polygon<double>)
MOREAU_CAPSULE_AND_COMPOUND_INSTANCES(extern template, Capsule<double>, Polyhedron<double>)
MOREAU_MEASURE_INSTANCES(extern template, Space<2>)
MOREAU_MEASURE_INSTANCES(extern template, Space<3>)
MOREAU_PLANE_INSTANCES(extern template, SignoriniCoulomb<double>)
MOREAU_PLANE_INSTANCES(extern template, RollingResistance<double>)
MOREAU_PLANE_INSTANCES(extern template, Compliant<SignoriniCoulomb<double>>)
MOREAU_SPACE_INSTANCES(extern template, SignoriniCoulomb<double>)
MOREAU_SPACE_INSTANCES(extern template, RollingResistance<double>)
MOREAU_SPACE_INSTANCES(extern template, Compliant<SignoriniCoulomb<double>>)
/// @endcond
}  // namespace moreau
