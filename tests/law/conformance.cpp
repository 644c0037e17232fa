// SPDX-License-Identifier: MIT
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/law/tangential_restitution.hpp"

#include "conformance/law.hpp"
#include "conformance/regularized_law.hpp"
#include "own_law/greased.hpp"
#include "own_law/rubber.hpp"

using namespace moreau;
using namespace conformance;

TEST_CASE_TEMPLATE("set-valued laws", S, Space<2>, Space<3>) {
  using T = typename S::Scalar;
  const SignoriniCoulomb<T> coulomb(T(0.4));
  set_valued_law<S>(coulomb);
  set_valued_law<S>(TangentialRestitution<T>(T(0.4), T(0.5), T(0.4)));
  lane_law<S>(TangentialRestitution<T>(T(0.4), T(0.5), T(0.4)));
  set_valued_law<S>(Frictionless<T>());
  set_valued_law<S>(Cohesive<SignoriniCoulomb<T>>(coulomb, T(1)));
  const RollingResistance<T> rolling(T(0.4), T(0.2));
  set_valued_law<S>(rolling);
  lane_law<S>(rolling, 400);
  lane_law<S>(Cohesive<RollingResistance<T>>(rolling, T(1)), 400);
  lane_law<S>(Compliant<RollingResistance<T>>(rolling, T(1e8)), 400);
  set_valued_law<S>(Cohesive<Frictionless<T>>(Frictionless<T>(), T(1)));
  set_valued_law<S>(Cohesive<RollingResistance<T>>(rolling, T(1)));
  lane_law<S>(coulomb);
  set_valued_law<S>(Greased{0.3});
  lane_law<S>(Frictionless<T>());
  lane_law<S>(Cohesive<SignoriniCoulomb<T>>(coulomb, T(1)));
  set_valued_law<S>(Compliant<SignoriniCoulomb<T>>(coulomb, T(1e8)));
  lane_law<S>(Compliant<SignoriniCoulomb<T>>(coulomb, T(1e8)));
  set_valued_law<S>(Compliant<RollingResistance<T>>(rolling, T(1e8)));
  const Cohesive<SignoriniCoulomb<T>> sticky(coulomb, T(1), T(1e-4));
  attractive_law<S>(Compliant<Cohesive<SignoriniCoulomb<T>>>(sticky, T(1e8)), T(1e-4));
  const SignoriniCoulomb<T> two_frictions(T(0.3), T(0.5), T(0.4));
  stateful_law<S>(Compliant<SignoriniCoulomb<T>>(two_frictions, T(1e8)));
  stateful_law<S>(SignoriniCoulomb<T>(T(0.3), T(0.5), T(0.4)));
  attractive_law<S>(Cohesive<SignoriniCoulomb<T>>(coulomb, T(1), T(1e-4)), T(1e-4));
  using Wet = Bridged<CapillaryBridge<T>, SignoriniCoulomb<T>>;
  const Wet wet(CapillaryBridge<T>(T(1e-12)), two_frictions);
  bridging_law<S>(wet, T(1e-3));
  bridging_law<S>(Compliant<Wet>(wet, T(1e8)), T(1e-3));
  bridging_law<S>(Bridged<LinearCohesion<T>, RollingResistance<T>>(
                      LinearCohesion<T>(T(1), T(1e-4)), RollingResistance<T>(T(0.4), T(0.2))),
                  T(1e-3));
  const Bonded<T> bonded({T(10), T(8), T(2)}, T(0.4), T(0.1));
  stateful_law<S>(bonded);
  lane_law<S>(bonded.variant(1), 400);
  stateful_law<S>(Compliant<Bonded<T>>(bonded, T(1e8)));
}

TEST_CASE_TEMPLATE("regularized laws", S, Space<2>, Space<3>) {
  using T = typename S::Scalar;
  regularized_law<S>(LinearSpringDashpot<T>(T(1e5), T(8e4), T(0.4), T(0.5)), 1e-5);
  regularized_law<S>(Rubber(), 1e-5);
  regularized_law<S>(HertzMindlin<T>::of_material(T(1e8), T(0.3), T(0.4), T(0.5)), 1e-5);
}

TEST_CASE("the restitution of springs is what was asked for") {
  using S = Space<3>;
  for (const double e : {0.3, 0.6, 0.9}) {
    // For a linear spring and dashpot the restitution is exact, except at the end of the impact,
    // where the dashpot would attract and the force is set to zero.
    const LinearSpringDashpot<> linear(1e6, 0, 0, e);
    CHECK(conformance::rebound<S>(linear, 0.1, 1e-7) == doctest::Approx(e).epsilon(0.12));
    CHECK(conformance::rebound<S>(linear, 0.1, 1e-7) >= e);
    const HertzMindlin<> hertz(1e8, 0, 0, e);
    CHECK(conformance::rebound<S>(hertz, 0.1, 1e-7) == doctest::Approx(e).epsilon(0.12));
  }
  CHECK(conformance::rebound<S>(LinearSpringDashpot<>(1e6), 0.1, 1e-7) ==
        doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("a spring's impact lasts pi sqrt(m / k)") {
  const LinearSpringDashpot<> law(1e6);
  CHECK(law.duration(0.25) == doctest::Approx(3.14159265 * 5e-4));
}

TEST_CASE_TEMPLATE("Newton's restitution is one for all set-valued laws", Law, SignoriniCoulomb<>,
                   Frictionless<>, Cohesive<>, RollingResistance<>) {
  const auto law = [] {
    if constexpr (std::same_as<Law, Frictionless<>>)
      return Law(0.25);
    else if constexpr (std::same_as<Law, Cohesive<>>)
      return Law(SignoriniCoulomb<>(0.4, 0.25), 1);
    else if constexpr (std::same_as<Law, RollingResistance<>>)
      return Law(0.4, 0.1, 0.25);
    else
      return Law(0.4, 0.25);
  }();
  CHECK(law.restitution() == 0.25);
  CHECK(law.velocity_offset(-1e-6, -2, 1e-3) == -0.5);
  CHECK(law.velocity_offset(0, 2, 1e-3) == 0);
  CHECK(std::isinf(law.velocity_offset(1e-6, -2, 1e-3)));
}

TEST_CASE("static friction holds after rest, dynamic friction after slip") {
  const SignoriniCoulomb<> law(0.2, 0, 0.5);
  CHECK(law.variant(0).friction() == 0.5);
  CHECK(law.variant(1).friction() == 0.2);
  using Vector = Eigen::Vector3d;
  for (const std::size_t k : {0u, 1u}) CHECK(law.variant_after(k, Vector(0, 0, 0)) == 0);
  CHECK(law.variant_after(0, Vector(1, 0.3, 0)) == 0);
  CHECK(law.variant_after(0, Vector(1, 0.5, 0)) == 1);
  CHECK(law.variant_after(1, Vector(1, 0, -0.2)) == 1);
  CHECK(law.variant_after(1, Vector(1, 0, -0.1)) == 0);
  // Without friction in slip a contact slides until it opens.
  const SignoriniCoulomb<> smooth(0, 0, 0.5);
  CHECK(smooth.variant_after(0, Vector(1, 0.3, 0)) == 0);
  CHECK(smooth.variant_after(0, Vector(1, 0.5, 0)) == 1);
  CHECK(smooth.variant_after(1, Vector(1, 0, 0)) == 1);
  CHECK(smooth.variant_after(1, Vector(0, 0, 0)) == 0);
  CHECK(SignoriniCoulomb<>(0.2).variant_after(0, Eigen::Vector2d(1, 0.2)) == 0);
}

TEST_CASE("rolling resistance without any is Coulomb's law") {
  using S = Space<3>;
  std::mt19937_64 random(1);
  const RollingResistance<> law(0.4, 0);
  for (int i = 0; i < 200; ++i) {
    const conformance::LocalProblem<S, RollingResistance<>> p(random);
    const auto r = law.solve(p.block, p.velocity, p.guess);
    const Eigen::Vector3d coulomb = SignoriniCoulomb<>(0.4).solve(
        p.block.point, Eigen::Vector3d(p.velocity.head<3>()), Eigen::Vector3d(p.guess.head<3>()));
    CHECK((r.head<3>() - coulomb).norm() <= 1e-10 * (1 + coulomb.norm()));
    CHECK(r.tail<3>().isZero(0));
  }
}

TEST_CASE("what is out of range is named") {
  using doctest::Contains;
  CHECK_THROWS_WITH_AS(Frictionless<>(1.5), "Frictionless: restitution = 1.5 must lie in [0, 1]",
                       std::invalid_argument);
  CHECK_THROWS_WITH(SignoriniCoulomb<>(0.4, 0, 0.3), Contains("static_friction = 0.3"));
  CHECK_THROWS_WITH(Cohesive<>(SignoriniCoulomb<>(), -1), Contains("Cohesive: adhesion = -1"));
  CHECK_THROWS_WITH(Cohesive<>(SignoriniCoulomb<>(), 1, 0), Contains("Cohesive: range = 0"));
  CHECK_THROWS_WITH(RollingResistance<>(0.1, -1), Contains("RollingResistance: rolling = -1"));
  CHECK_THROWS_WITH(LinearSpringDashpot<>(0), Contains("LinearSpringDashpot: stiffness = 0"));
  CHECK_THROWS_WITH(LinearSpringDashpot<>(1, -1), Contains("tangential_stiffness = -1"));
  CHECK_THROWS_WITH(LinearSpringDashpot<>(1, 1, -1), Contains("friction = -1"));
  CHECK_THROWS_WITH(LinearSpringDashpot<>(1, 1, 1, 2), Contains("restitution = 2"));
  CHECK_THROWS_WITH(LinearSpringDashpot<>(1, 0, 0.4), Contains("tangential_stiffness = 0"));
  CHECK_THROWS_WITH(HertzMindlin<>(1, 0, 0.4), Contains("shear = 0"));
  CHECK_THROWS_WITH(HertzMindlin<>::of_material(-1, 0.3, 0, 1),
                    Contains("HertzMindlin::of_material: young = -1"));
  CHECK_THROWS_WITH(HertzMindlin<>(-1), Contains("HertzMindlin: young = -1"));
  CHECK_THROWS_WITH(HertzMindlin<>(1, -1), Contains("shear = -1"));
  CHECK_THROWS_WITH(HertzMindlin<>::of_material(1, 0.7, 0, 0), Contains("poisson = 0.7"));
}
