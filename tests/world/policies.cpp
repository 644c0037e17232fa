// SPDX-License-Identifier: MIT
// A selection of the combinations of policies. All combinations are tested in long/matrix_*.cpp.
// Rolling resistance and adhesion are tested by the quick cases of the validation.
#include "moreau/detect/broad/all_pairs.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

#include "conformance/matrix.hpp"
#include "conformance/world.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

TEST_CASE("polygons under Coulomb's law") {
  conformance::world(scenes::cuboid<Polygon<>>({0.003, 0.0025}), SignoriniCoulomb<>(0.4), 0.009);
}
TEST_CASE(
    "disks of float with an integrator, a broad phase and a solver that are not the default") {
  using S = Space<2, float>;
  using Choice = conformance::With<conformance::Implicit, AllPairs<S>, NonlinearGaussSeidel>;
  conformance::world<Choice>(BallIn<S>(0.005f), SignoriniCoulomb<float>(0.4f), 0.01f);
}

TEST_CASE("the integrator can be replaced during a run") {
  Simulation<Disk<double>, SignoriniCoulomb<double>> simulation(
      0.01, Materials<SignoriniCoulomb<double>>(1));
  const BodyId grain =
      simulation.add_grain(simulation.add_shape(Disk<double>(0.005)), Pose<Space<2>>(), 2700);
  simulation.set_gravity({0, -10});
  simulation.step(1e-3);  // theta = 1/2: g h^2/2
  CHECK(simulation.pose(grain).position.y() == doctest::Approx(-0.5e-5));
  simulation.set_integrator(MoreauJean(1));  // theta = 1
  simulation.step(1e-3);                     // 2 g h^2
  CHECK(simulation.pose(grain).position.y() == doctest::Approx(-2.5e-5));
}

TEST_CASE("frictionless disks") {
  conformance::world(Disk<double>(0.005), Frictionless<>(), 0.01);
}
TEST_CASE("sticky disks that resist rolling") {
  const RollingResistance<> rolling(0.4, 0.1);
  conformance::world(Disk<double>(0.005), Cohesive<RollingResistance<>>(rolling, 1e-3), 0.01);
}
TEST_CASE("disks on springs") {
  conformance::world(Disk<double>(0.005), conformance::stiff_springs(0.08), 0.01);
}
TEST_CASE("Hertzian spheres of float") {
  conformance::world(moreau::Ball<float>(0.005f), conformance::stiff_spheres(5e-4f), 0.01f);
}
