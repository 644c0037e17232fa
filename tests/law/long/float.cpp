// SPDX-License-Identifier: MIT
#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"

#include "conformance/law.hpp"
#include "conformance/regularized_law.hpp"

using namespace moreau;
using conformance::lane_law, conformance::regularized_law, conformance::set_valued_law;

TEST_CASE_TEMPLATE("set-valued laws, in single precision", S, Space<2, float>, Space<3, float>) {
  using T = typename S::Scalar;
  const SignoriniCoulomb<T> coulomb(T(0.4));
  set_valued_law<S>(coulomb);
  set_valued_law<S>(Frictionless<T>());
  set_valued_law<S>(Cohesive<SignoriniCoulomb<T>>(coulomb, T(1)));
  set_valued_law<S>(RollingResistance<T>(T(0.4), T(0.2)));
  lane_law<S>(coulomb);
  lane_law<S>(Frictionless<T>());
}

TEST_CASE_TEMPLATE("regularized laws, in single precision", S, Space<2, float>, Space<3, float>) {
  using T = typename S::Scalar;
  regularized_law<S>(LinearSpringDashpot<T>(T(1e5), T(8e4), T(0.4), T(0.5)), 1e-5);
  regularized_law<S>(HertzMindlin<T>::of_material(T(1e8), T(0.3), T(0.4), T(0.5)), 1e-5);
}
