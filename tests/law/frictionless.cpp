// SPDX-License-Identifier: MIT
// Frictionless is Coulomb's law with a coefficient of 0: small structures are solved by the direct method.
#include "moreau/law/frictionless.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

static_assert(CoulombLaw<Frictionless<>, Space<2>> &&
              CoulombLaw<Frictionless<float>, Space<3, float>>);
static_assert(CoulombLaw<Cohesive<Frictionless<>>, Space<3>>);
static_assert(LaneLaw<Frictionless<>, Space<3>> && !MapsLanes<Frictionless<>, Space<3>>);

TEST_CASE_TEMPLATE("a stack without friction stands", ShapeT,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>, Polygon<float>, Polyhedron<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Law = Frictionless<T>;
  using Vector = typename S::Vector;
  constexpr int count = 20, up = S::dim - 1;
  const double edge = 0.02, h = 1e-3, g = 9.81;
  Simulation<ShapeT, Law> world(T(edge), Law{});
  world.add_wall(Vector::Unit(up), Vector::Zero());
  const ShapeId cube = world.add_shape(cuboid<ShapeT>(Vector::Constant(T(edge / 2))));
  std::vector<BodyId> grains;
  for (int k = 0; k < count; ++k)
    grains.push_back(
        world.add_grain(cube, Pose<S>(Vector(T(edge * (k + 0.5)) * Vector::Unit(up))), T(2000)));
  world.set_gravity(T(-g) * Vector::Unit(up));
  double fastest = 0;
  int islands = 0;
  for (int k = 0; k < 500; ++k) {
    const StepReport report = world.step(T(h));
    islands = std::max(islands, report.solve.islands);
    for (const BodyId grain : grains)
      fastest = std::max(fastest, double(world.velocity(grain).norm()));
  }
  double aside = 0;
  for (const BodyId grain : grains) {
    Vector x = world.pose(grain).position;
    x[up] = 0;
    aside = std::max(aside, double(x.norm()));
  }
  CAPTURE(aside);
  CHECK(islands == 1);
  CHECK(fastest < 0.02 * g * h);
  CHECK(aside < 1e-3 * edge);
}
