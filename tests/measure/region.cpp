// SPDX-License-Identifier: MIT
#include "moreau/measure/region.hpp"

#include <doctest/doctest.h>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

namespace {

using namespace moreau;
using Law = SignoriniCoulomb<double>;
constexpr double radius = 0.1, pi = std::numbers::pi;

#define MOREAU_ROUND MOREAU_TYPES((Ball<double>), (Disk<double>))

}  // namespace

TEST_CASE_TEMPLATE(
    "region: the velocity is momentum over mass, whole grains give the solid fraction", Shape,
    MOREAU_ROUND) {
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  Simulation<Shape, Law> simulation(2 * radius, Law(0.5));
  simulation.set_periodic(0, 0, 4);
  const ShapeId shape = simulation.add_shape(Shape(radius));
  const double at[] = {0.5, 1.5, 2.5 - 4, 3.5}, density[] = {1, 3, 2, 5};
  for (int k = 0; k < 4; ++k) {
    const BodyId grain = simulation.add_grain(shape, {at[k] * Vector::UnitX()}, density[k]);
    simulation.set_velocity(grain, (k + 1.) * Vector::Unit(S::dim - 1));
  }
  simulation.step(1e-9);
  // The first three, one of them by its image; the last lies outside.
  const Aabb<S> box{-0.2 * Vector::Ones(), Vector::Constant(0.2) + 2.8 * Vector::UnitX()};
  const Region<S> region = measure_region(simulation, 1e-9, box);
  CHECK(region.grains == 3);
  CHECK(region.velocity[S::dim - 1] == doctest::Approx((1. + 6 + 6) / 6).epsilon(1e-12));
  CHECK(region.velocity[0] == 0);
  const double grain = S::dim == 3 ? 4 * pi / 3 * 1e-3 : pi * 1e-2;
  CHECK(region.solid_fraction == doctest::Approx(3 * grain / volume(box)).epsilon(1e-12));
  CHECK(region.pressure() == 0);
  const Aabb<S> empty{Vector::Constant(0.7), Vector::Constant(0.8)};
  CHECK(measure_region(simulation, 1e-9, empty).velocity.isZero(0));
  CHECK_THROWS_AS(measure_region(simulation, 0., box), std::invalid_argument);
}

TEST_CASE_TEMPLATE("region: in a column at rest the stress is that of the weight above", Shape,
                   MOREAU_ROUND) {
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double h = 1e-3, g = 10;
  Simulation<Shape, Law> simulation(2 * radius, Law(0.5));
  const ShapeId shape = simulation.add_shape(Shape(radius));
  for (int k = 0; k < 6; ++k)
    simulation.add_grain(shape, {(2 * k + 1) * radius * Vector::Unit(up)}, 1000);
  simulation.add_wall(Vector::Unit(up), Vector::Zero());
  simulation.set_gravity(-g * Vector::Unit(up));
  for (int k = 0; k < 5; ++k) simulation.step(h);
  // The contacts below grains 2 and 3, which carry 4 and 3 grains.
  Aabb<S> box{Vector::Constant(-radius), Vector::Constant(radius)};
  box.lower[up] = 3 * radius, box.upper[up] = 7 * radius;
  const Region<S> region = measure_region(simulation, h, box);
  const double weight = g * 1000 * (S::dim == 3 ? 4 * pi / 3 * 1e-3 : pi * 1e-2);
  CHECK(region.stress(up, up) ==
        doctest::Approx(2 * radius * 7 * weight / volume(box)).epsilon(1e-4));
  CHECK(region.pressure() == doctest::Approx(region.stress(up, up) / S::dim).epsilon(1e-9));
  CHECK(region.velocity.norm() < 1e-6);
}
