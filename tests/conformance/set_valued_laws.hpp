// SPDX-License-Identifier: MIT
// All set-valued laws, for suites that run for every law.
#pragma once

#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/law/tangential_restitution.hpp"

namespace conformance {

/// Calls check(law) for every law that has couples.
/// @param stiffness of the springs of compliant laws [N/m]
template <class T>
void each_rolling_law(T stiffness, const auto& check) {
  using namespace moreau;
  const auto with_springs = [&]<class Law>(const Law& law) {
    check(law);
    check(Compliant<Law>(law, stiffness));
  };
  const RollingResistance<T> rolling(T(0.4), T(0.2));
  with_springs(rolling);
  with_springs(Cohesive<RollingResistance<T>>(rolling, T(1)));
  with_springs(
      Bridged<LinearCohesion<T>, RollingResistance<T>>(LinearCohesion<T>(T(1), T(1e-4)), rolling));
  const Bonded<T> bonded({T(10), T(8), T(2)}, T(0.4), T(0.1));
  with_springs(bonded);
  with_springs(bonded.variant(1));
}

/// Calls check(law) for every set-valued law.
template <class T>
void each_set_valued_law(T stiffness, const auto& check) {
  using namespace moreau;
  const auto with_springs = [&]<class Law>(const Law& law) {
    check(law);
    check(Compliant<Law>(law, stiffness));
  };
  const SignoriniCoulomb<T> coulomb(T(0.4));
  const Frictionless<T> smooth;
  with_springs(coulomb);
  with_springs(smooth);
  with_springs(Cohesive<SignoriniCoulomb<T>>(coulomb, T(1)));
  with_springs(Cohesive<Frictionless<T>>(smooth, T(1)));
  with_springs(
      Bridged<CapillaryBridge<T>, SignoriniCoulomb<T>>(CapillaryBridge<T>(T(1e-12)), coulomb));
  check(TangentialRestitution<T>(T(0.4), T(0.5), T(0.4)));
  each_rolling_law(stiffness, check);
}

}  // namespace conformance
