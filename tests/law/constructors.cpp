// SPDX-License-Identifier: MIT
// Every law of the library with its parameters, as examples/guide/laws.md shows them.
#include <cmath>
#include <doctest/doctest.h>

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

TEST_CASE("the constructors of the set-valued laws") {
  using Coulomb = moreau::SignoriniCoulomb<double>;
  const Coulomb rough(0.4);               // friction 0.4, no restitution
  const Coulomb bouncing(0.3, 0.5);       // friction 0.3, restitution 0.5
  const Coulomb sticking(0.3, 0.0, 0.4);  // friction 0.3 in slip and 0.4 at rest, no restitution
  const moreau::Frictionless<double> smooth(0.5);  // restitution 0.5
  // Friction 0.4; the bodies attract each other with 1e-3 N at each contact point, up to a gap of 1e-5 m.
  const moreau::Cohesive<Coulomb> wet(rough, 1e-3, 1e-5);
  // Friction 0.25, restitution 0.87, tangential restitution 0.43.
  const moreau::TangentialRestitution<double> acetate(0.25, 0.87, 0.43);
  // Friction 0.4; the couple is at most 0.1 x effective radius x normal force.
  const moreau::RollingResistance<double> rolling(0.4, 0.1);
  // A pair that has touched is held by 1e-9 m^3 of water with 0.0728 N/m, up to a gap of 1 mm.
  using Water = moreau::CapillaryBridge<double>;
  const moreau::Bridged<Water, Coulomb> moist(Water(1e-9), rough);
  // The same with 1e-3 N at contact, which falls linearly to 0 at a gap of 1e-4 m.
  using Linear = moreau::LinearCohesion<double>;
  const moreau::Bridged<Linear, Coulomb> linear(Linear(1e-3, 1e-4), rough);
  // Bonds with a strength of 100 N in tension and 80 N in shear, which bend and twist under a couple of 50 N x
  // effective radius, and take 0.01 J to break; without a bond friction 0.4.
  const moreau::Bonded<double> glued({100, 80, 50, 0.01}, 0.4);
  // Friction 0.4; springs with a normal stiffness of 1e8 N/m and a tangential stiffness of 7e7 N/m.
  const moreau::Compliant<Coulomb> elastic(rough, 1e8, 7e7);

  CHECK(rough.friction() == 0.4);
  CHECK(rough.static_friction() == 0.4);
  CHECK(rough.restitution() == 0);
  CHECK(bouncing.restitution() == 0.5);
  CHECK(sticking.friction() == 0.3);
  CHECK(sticking.static_friction() == 0.4);
  CHECK(smooth.restitution() == 0.5);
  CHECK(acetate.friction() == 0.25);
  CHECK(acetate.tangential_restitution() == 0.43);
  CHECK(wet.friction() == 0.4);
  CHECK(wet.attraction(1e-5) == 1e-3);
  CHECK(wet.attraction(2e-5) == 0);
  CHECK(rolling.friction() == 0.4);
  CHECK(rolling.rolling() == 0.1);
  CHECK(rolling.restitution() == 0);
  CHECK(std::abs(moist.reach() / 1e-3 - 1) < 1e-12);
  CHECK(std::abs(linear.bridge_force(5e-5, 1) / 5e-4 - 1) < 1e-12);
  CHECK(glued.friction() == 0.4);
  CHECK(glued.variant(1).friction() == doctest::Approx(0.8));
  CHECK(glued.variant(1).rolling() == doctest::Approx(0.5));
  CHECK(glued.strength().fracture_energy == 0.01);
  CHECK(elastic.friction() == 0.4);
  CHECK(elastic.normal_compliance() == 1e-8);
  CHECK(elastic.tangential_stiffness() == 7e7);
}

TEST_CASE("the constructors of the regularized laws") {
  // Stiffness 1e5 N/m along the normal and 7e4 N/m across it, friction 0.4, restitution 0.5.
  const moreau::LinearSpringDashpot<double> springs(1e5, 7e4, 0.4, 0.5);
  const double h = springs.duration(0.01) / 20;  // a good step for an effective mass of 0.01 kg [s]
  // Young's modulus 1e8 Pa and Poisson's ratio 0.3 of the material, friction 0.4, restitution 0.5.
  const auto spheres = moreau::HertzMindlin<double>::of_material(1e8, 0.3, 0.4, 0.5);

  CHECK(springs.stiffness() == 1e5);
  CHECK(springs.friction() == 0.4);
  CHECK(h > 4e-5);
  CHECK(h < 6e-5);
  CHECK(spheres.young() == doctest::Approx(1e8 / 1.82));
  CHECK(spheres.shear() == doctest::Approx(1e8 / 2.6 / 3.4));
  CHECK(spheres.friction() == 0.4);
}
