// SPDX-License-Identifier: MIT
#include "moreau/measure/rest_test.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/heap.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

constexpr double h = 1e-3, d = 0.02;

/// A ball without friction on a floor or an obstacle, so that its speed is what the test sets.
template <class ShapeT>
struct Slider {
  using S = SpaceOf<ShapeT>;
  using Law = SignoriniCoulomb<double>;
  Simulation<ShapeT, Law> simulation{d, Law(0)};
  BodyId ball;

  explicit Slider(double height, bool on_obstacle = false) {
    const typename S::Vector up = S::Vector::Unit(S::dim - 1);
    const ShapeId shape = simulation.add_shape(ShapeT(d / 2));
    ball = simulation.add_grain(shape, {(d / 2 + height) * up}, 2700);
    if (on_obstacle)
      simulation.prescribe_motion(simulation.add_grain(shape, {-d / 2 * up}, 2700));
    else
      simulation.add_wall(up, S::Vector::Zero());
    simulation.set_gravity(-9.81 * up);
  }
  bool step(RestTest& rest, double speed) {
    simulation.set_velocity(ball, speed * S::Vector::UnitX());
    return rest.add(simulation, simulation.step(h), h);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("a grain that nothing carries is not at rest, however slow", ShapeT, Disk<>,
                   Ball<>) {
  Slider<ShapeT> slider(d);
  RestTest rest({.time = 0});
  slider.simulation.set_velocity(
      slider.ball, h * 9.81 * SpaceOf<ShapeT>::Vector::Unit(SpaceOf<ShapeT>::dim - 1));
  CHECK(!rest.add(slider.simulation, slider.simulation.step(h), h));  // the top of its path
  CHECK(rest.speed() < 5e-3);
  CHECK(rest.missing_load() == doctest::Approx(1));
  CHECK(rest.reason() == "walls and obstacles do not carry 1 of the weight, the limit is 0.01");
}

TEST_CASE_TEMPLATE("rest needs its time, and has a hysteresis", ShapeT, Disk<>, Ball<>) {
  for (const bool on_obstacle : {false, true}) {
    CAPTURE(on_obstacle);
    Slider<ShapeT> slider(0, on_obstacle);
    RestTest rest({.speed = 1e-5, .time = 3 * h});
    CHECK(!slider.step(rest, 3e-5));  // beyond the limit: no time is counted
    CHECK(rest.time() == 0);
    CHECK(rest.reason().starts_with("the grains move with 3e-05 m/s"));
    CHECK(!slider.step(rest, 0.9e-5));
    CHECK(!slider.step(rest, 3e-5));  // within four times the limit: the time goes on
    CHECK(rest.time() == doctest::Approx(2 * h));
    CHECK(rest.reason() == "at rest for 0.002 s of 0.003 s");
    CHECK(slider.step(rest, 3e-5));
    CHECK(rest.reason().empty());
    CHECK(!slider.step(rest, 5e-5));  // the time begins anew
    CHECK(!slider.step(rest, 3e-5));
    CHECK(rest.time() == 0);
    for (int k = 0; k < 2; ++k) CHECK(!slider.step(rest, 0));
    CHECK(slider.step(rest, 0));
    CHECK(rest.missing_load() < 1e-3);
  }
}

TEST_CASE_TEMPLATE("a lid in the air, which a force moves, is not at rest, and on grains it is",
                   ShapeT, MOREAU_TYPES((Disk<>, Ball<>), (Polygon<>, Polyhedron<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const double acceleration : {0.02, 0.1, 10.0})
    for (const bool is_mesh : {false, true}) {
      CAPTURE(acceleration);
      CAPTURE(is_mesh);
      Simulation<ShapeT, SignoriniCoulomb<>> world(d, SignoriniCoulomb<>(0.3));
      const ShapeId shape = world.add_shape(regular_shape<ShapeT>(d));
      for (int k = 0; k < 3; ++k)
        world.add_grain(shape, Pose<S>(Vector(d / 2 * up + 2 * d * k * Vector::UnitX())), 2700);
      world.add_wall(up, Vector::Zero());
      world.set_gravity(-9.81 * up);
      // The first axis of the frame of a mesh wall is the one along which it moves.
      const typename S::Rotation down(S::contact_frame(-up));
      FacetMesh<S> plate;
      plate.vertices = {-Vector::Unit(1), Vector(3 * Vector::Unit(1))};
      if (S::dim == 3) {
        plate.vertices[1] -= 4 * Vector::Unit(S::dim - 1);
        plate.vertices.push_back(3 * Vector::Unit(1) + 4 * Vector::Unit(S::dim - 1));
      }
      plate.facets.emplace_back();
      for (std::uint32_t k = 0; k < S::dim; ++k) plate.facets[0][k] = k;
      const Vector place = 1.5 * d * up;
      const BodyId lid = is_mesh ? world.add_mesh_wall(plate, Pose<S>(place, down), WallSides::both)
                                 : world.add_wall(-up, place);
      world.set_wall_mass(lid, 1);
      world.set_force(lid, -acceleration * up);
      RestTest rest;
      const double fall = std::sqrt(d / acceleration);
      for (bool is_at_rest = false; !is_at_rest && world.time() < fall + 2;)
        is_at_rest = rest.add(world, world.step(h), h);
      CHECK(rest.is_at_rest());
      CHECK(world.time() > fall);
      CHECK(world.pose(lid).position.dot(up) == doctest::Approx(d).epsilon(0.01));
    }
}

TEST_CASE("why a lid is not at rest") {
  Slider<Disk<>> slider(0);
  auto& world = slider.simulation;
  const BodyId lid = world.add_wall({0, -1}, {0, 1});
  world.set_wall_mass(lid, 1);
  RestTest rest({.time = h});
  CHECK(slider.step(rest, 0));  // neither force nor velocity
  world.set_force(lid, {0, -0.01});
  CHECK(!slider.step(rest, 0));
  CHECK(rest.reason().starts_with(
      "the grains do not carry the force on a wall with a mass, 1 of the load"));
  world.set_force(lid, {0, 0});
  world.set_velocity(lid, {0, -0.1});
  CHECK(!slider.step(rest, 0));
  CHECK(rest.reason().starts_with("a wall with a mass moves with 0.1 m/s, the limit is "));
}

TEST_CASE_TEMPLATE("forces that cancel to rounding are no load, others are", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>),
                                (BallIn<Space<2, float>>, BallIn<Space<3, float>>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<T>;
  for (const double third : {-0.3, -0.2}) {
    CAPTURE(third);
    Simulation<ShapeT, Law> row(T(d), Law(T(0)));
    const ShapeId shape = row.add_shape(ShapeT(T(d / 2)));
    const double forces[] = {0.1, 0.2, third};
    for (int k = 0; k < 3; ++k)
      row.set_force(row.add_grain(shape, Pose<S>(Vector(T(d * k) * Vector::UnitX())), T(2700)),
                    Vector(T(forces[k]) * Vector::UnitX()));
    RestTest rest({.speed = 1e3, .time = 3 * h});  // the load alone decides
    bool is_at_rest = false;
    for (int k = 0; k < 10; ++k) is_at_rest = rest.add(row, row.step(T(h)), h);
    CHECK(is_at_rest == (third == -0.3));
    CHECK(rest.missing_load() == doctest::Approx(third == -0.3 ? 0 : 1));  // no wall carries 0.1 N
  }
}

TEST_CASE("options of a rest test") {
  CHECK(RestTest().reason() == "no step was added");
  CHECK_THROWS_WITH(RestTest({.hysteresis = 0.5}),
                    "RestTest: options.hysteresis = 0.5 must be finite and >= 1");
  CHECK_THROWS_AS(RestTest({.time = -1}), std::invalid_argument);
  CHECK_THROWS_AS(RestTest({.load = std::numeric_limits<double>::infinity()}),
                  std::invalid_argument);
  Slider<Disk<>> slider(0);
  slider.simulation.set_gravity({0, 0});
  RestTest rest;
  CHECK_THROWS_WITH(rest.add(slider.simulation, slider.simulation.step(h), h),
                    "RestTest::add: options.speed = 0 must be > 0 without gravity");
  slider.simulation.set_gravity({0, -9.81});
  const StepReport report = slider.simulation.step(h);
  CHECK_THROWS_WITH(rest.add(slider.simulation, report, 0),
                    "RestTest::add: step = 0 must be finite and > 0");
  CHECK_THROWS_AS(rest.add(slider.simulation, report, std::nan("")), std::invalid_argument);
  CHECK_THROWS_WITH(rest.add(slider.simulation, report, 2 * h),
                    "RestTest::add: step = 0.002 must be the step of the report");
}

TEST_CASE_TEMPLATE("the free surface of a heap that a grain has left", ShapeT, Disk<>, Ball<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Simulation<ShapeT, SignoriniCoulomb<>> world(0.02, SignoriniCoulomb<>(0.5));
  const ShapeId shape = world.add_shape(ShapeT(0.01));
  for (const double x : {-1e30, 0.0, 0.001, 3e25})
    world.add_grain(shape, Pose<S>(Vector(x * Vector::UnitX())), 1000);
  const std::vector<Vector> surface = free_surface(world, 0.05);
  REQUIRE(surface.size() == 3);
  CHECK(surface[0][0] == doctest::Approx(-1e30));
  CHECK(surface[1][0] == doctest::Approx(0.025));
  CHECK(surface[2][0] == doctest::Approx(3e25));
}

TEST_CASE_TEMPLATE("the slope of a heap", ShapeT, Disk<>, Ball<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  Simulation<ShapeT, SignoriniCoulomb<double>> heap(d, SignoriniCoulomb<double>(0.5));
  const ShapeId shape = heap.add_shape(ShapeT(d / 2));
  // A lattice of columns of one grain width. The heap's axis is away from the origin.
  const Vector axis = Vector::Constant(0.31) - 0.31 * Vector::Unit(up);
  const double slope = 0.5;
  std::size_t expected = 0;
  const int side = 20;
  for (int i = -side; i <= side; ++i)
    for (int j = up > 1 ? -side : 0; j <= (up > 1 ? side : 0); ++j) {
      Vector x = axis;
      x[0] = (std::floor(axis[0] / d) + i + 0.5) * d;
      if (up > 1) x[up - 1] = (std::floor(axis[up - 1] / d) + j + 0.5) * d;
      const double distance = (x - axis).head(up).norm();
      const double height = 0.18 - slope * distance;
      if (height < d) continue;
      for (const double at : {height - d / 2, 0.0}) {  // the top, and one below
        x[up] = at;
        heap.add_grain(shape, {x}, 2700);
      }
      expected += distance >= 0.05 && distance <= 0.25;
    }
  // An obstacle above all does not count.
  heap.prescribe_motion(heap.add_grain(shape, {axis + Vector::Unit(up)}, 2700));

  const std::vector<Vector> surface = free_surface(heap, d);
  const HeapSlope found = heap_slope(surface, axis, 0.05, 0.25);
  CHECK(found.points == expected);
  CHECK(found.angle == doctest::Approx(std::atan(slope)).epsilon(1e-9));
  CHECK(found.apex == doctest::Approx(0.18).epsilon(1e-9));
  CHECK(found.error < 1e-12);
  CHECK_THROWS_WITH(heap_slope(surface, axis, 1, 2),
                    doctest::Contains("heap_slope: points = 0 must be at least 2"));
  CHECK_THROWS_WITH(heap_slope(surface, axis, std::nan(""), 2),
                    doctest::Contains("heap_slope: from = nan m must be a number"));
  CHECK_THROWS_WITH(heap_slope(surface, axis, 0.05, std::nan("")), doctest::Contains("to = nan"));
  CHECK_THROWS_AS(free_surface(heap, 0), std::invalid_argument);
}
