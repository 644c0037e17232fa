// SPDX-License-Identifier: MIT
// Wrong settings that give results which look right are reported.
#include "moreau/measure/check.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<>;
using World = Simulation<Polyhedron<double>, Law>;

/// A cube with edges of 2 cm.
Polyhedron<double> cube_shape() {
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {-0.01, 0.01})
    for (const double y : {-0.01, 0.01})
      for (const double z : {-0.01, 0.01}) corners.emplace_back(x, y, z);
  return Polyhedron<double>(corners);
}

/// The cube above a floor.
World cube(double grain_size, double height) {
  World world(grain_size, Materials<Law>(1, Law(0.5)));
  Pose<Space<3>> pose;
  pose.position = {0, 0, height};
  world.add_grain(world.add_shape(cube_shape()), pose, 2000);
  world.add_wall({0, 0, 1}, {0, 0, 0});
  world.set_gravity({0, 0, -9.81});
  return world;
}

/// All sentences of a run.
std::vector<std::string> run(World& world, double step, int steps) {
  std::vector<std::string> all;
  for (int k = 0; k < steps; ++k)
    for (const std::string& sentence : check(world, world.step(step))) all.push_back(sentence);
  return all;
}

bool one_contains(const std::vector<std::string>& all, const char* text) {
  for (const std::string& sentence : all)
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("check: nothing is said about a cube that falls on a floor in short steps") {
  World world = cube(0.02, 0.02);
  CHECK(run(world, 5e-4, 400).empty());
}

TEST_CASE("check: gravity that was forgotten") {
  World world = cube(0.02, 0.02);
  world.set_gravity({0, 0, 0});
  CHECK(check(world, world.step(5e-4)).empty());
  CHECK(one_contains(run(world, 5e-4, 1), "nothing moves: gravity is zero"));
  world.set_velocity(world.grain(0), {0, 0, -1e-3});
  CHECK(run(world, 5e-4, 1).empty());
  world.set_velocity(world.grain(0), {0, 0, 0});
  world.set_force(world.grain(0), {0, 0, -1});
  CHECK(run(world, 5e-4, 1).empty());
}

TEST_CASE("check: a long step after a short one is not the first") {
  World world = cube(0.02, 0.5);
  world.set_gravity({0, 0, 0});
  CHECK(run(world, 1e-5, 1).empty());
  CHECK(one_contains(run(world, 1e-3, 1), "nothing moves"));
}

TEST_CASE("check: a step too long for the speeds") {
  World world = cube(0.02, 0.5);
  const auto all = run(world, 0.05, 10);
  CHECK(one_contains(all, "step too long"));
  CHECK(one_contains(all, "overlap of"));
}

TEST_CASE_TEMPLATE("check: a step in milliseconds, of one grain at rest", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const double size : {1e-3, 0.02, 0.5})
    for (const double typed : {1e-4, 1e-3, 5e-3, 0.5, 1.0, 2.0}) {
      CAPTURE(size);
      CAPTURE(typed);
      Simulation<ShapeT, Law> world(size, Materials<Law>(1, Law(0.5)));
      world.add_grain(world.add_shape(regular_shape<ShapeT>(size)), {}, 2700);
      world.add_wall(up, Vector(-size / 2 * up));
      world.set_gravity(-9.81 * up);
      std::vector<std::string> all;
      for (int k = 0; k < 3; ++k) all = check(world, world.step(typed));
      CHECK(one_contains(all, "If it is in ms, type ") == (9.81 * typed * typed > 0.2 * size));
      CHECK(all.size() == std::size_t(9.81 * typed * typed > 0.2 * size));
    }
}

TEST_CASE("check: a grain size in millimetres") {
  World world = cube(20, 0.02);
  CHECK(
      one_contains(run(world, 1e-3, 1), "grain size 20 m, but the ball around the smallest grain"));
}

TEST_CASE("check: nothing is said about a plate with a grain size between thickness and diameter") {
  for (const double size : {0.002, 0.01, 0.05, 0.1}) {
    World world(size, Materials<Law>(1, Law(0.5)));
    const ShapeId plate = world.add_shape(cuboid<Polyhedron<>>({0.05, 0.05, 0.001}));
    world.add_grain(plate, {}, 2700);
    world.add_wall({0, 0, 1}, {0, 0, -0.001});
    world.set_gravity({0, 0, -9.81});
    CHECK(run(world, 1e-4, 3).empty());
  }
  World world(0.0005, Materials<Law>(1, Law(0.5)));
  world.add_grain(world.add_shape(cuboid<Polyhedron<>>({0.05, 0.05, 0.001})), {}, 2700);
  CHECK(one_contains(run(world, 1e-4, 1), "ball around the smallest grain"));
}

TEST_CASE("check: a grain that driven walls squeeze has no solution") {
  World world(0.02, Materials<Law>(1, Law(0.3)));
  world.add_grain(world.add_shape(cuboid<Polyhedron<>>({0.01, 0.01, 0.01})), {}, 2700);
  const BodyId left = world.add_wall({1, 0, 0}, {-0.01, 0, 0}),
               right = world.add_wall({-1, 0, 0}, {0.01, 0, 0});
  world.set_velocity(left, {0.1, 0, 0});
  world.set_velocity(right, {-0.1, 0, 0});
  CHECK(one_contains(run(world, 1e-3, 3), "has no solution: change what drives it"));
}

TEST_CASE("check: a grain inside another") {
  World world = cube(0.02, 0.01);
  Pose<Space<3>> pose;
  pose.position = {0, 0, 0.025};
  world.add_grain(world.add_shape(cube_shape()), pose, 2000);
  world.allow_overlaps();
  CHECK(one_contains(run(world, 1e-3, 1), "overlap of 0.005 m of the bodies 0 and 2"));
}

TEST_CASE("check: an overlap of an impact asks for a shorter step, not for other grains") {
  World world(0.1, Materials<Law>(1, Law(0.3, 0.5)));
  world.add_wall({0, 0, 1}, {0, 0, 0});
  const ShapeId shape = world.add_shape(cuboid<Polyhedron<>>({0.05, 0.05, 0.05}));
  bool arose = false;
  for (int k = 0; k < 20; ++k) {  // from other heights: the floor lies at other parts of a step
    const BodyId grain =
        world.add_grain(shape, Pose<Space<3>>({0.3 * k, 0, 0.05 + 1e-4 * k}), 1000);
    world.set_velocity(grain, {0, 0, -1.9});
  }
  for (const std::string& sentence : run(world, 1e-3, 100)) {
    CAPTURE(sentence);
    CHECK(sentence.find("add") == std::string::npos);
    CHECK(sentence.find("Add") == std::string::npos);
    arose = arose || sentence.find("it arose in this step") != std::string::npos;
  }
  CHECK(arose);
}

TEST_CASE_TEMPLATE(
    "check: an overlap of the first step by a floor that moves was not there at the start", ShapeT,
    MOREAU_TYPES((Disk<>, Polyhedron<>), (Polygon<>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const T depth : {T(0), T(0.05)}) {  // of the grain size, at the start
    Simulation<ShapeT, Coulomb> world(T(0.02), Coulomb(T(0.5)));
    world.add_grain(world.add_shape(regular_shape<ShapeT>(T(0.02))),
                    Pose<S>(Vector((T(0.5) - depth) * T(0.02) * up)), T(2700));
    world.add_wall(up, Vector::Zero());
    world.set_gravity(T(-9.81) * up);
    if (depth == 0) world.set_velocity(BodyId(1), T(0.6) * up);
    const auto all = check(world, world.step(T(1e-3)));
    if (ShapeT(regular_shape<ShapeT>(T(0.02))).bounding_box({}).lower[S::dim - 1] < T(-0.0099)) {
      CHECK(one_contains(all, "it arose in this step") == (depth == 0));
      CHECK(one_contains(all, "at the start") == (depth > 0));
    }
  }
}

TEST_CASE("check: an overlap that is older than the step") {
  World world = cube(0.02, 0.0);
  const BodyId grain = world.grain(0);
  world.set_pose(grain, Pose<Space<3>>({0, 0, 0.5}));
  CHECK(run(world, 1e-4, 2).empty());
  world.set_pose(grain, Pose<Space<3>>({0, 0, 0.009}));
  world.set_velocity(grain, {0, 0, 0});
  CHECK(one_contains(run(world, 1e-4, 2), "it is older than this step"));
}

TEST_CASE_TEMPLATE("check: overlaps of springs are not those of a contact problem", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (Disk<float>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Springs = LinearSpringDashpot<T>;
  constexpr T radius = T(0.01), size = 2 * radius;
  const Vector up = Vector::Unit(S::dim - 1);
  /// A grain above a floor.
  const auto grain_at = [&](T height, T stiffness) {
    Simulation<ShapeT, Springs> world(
        size, Materials<Springs>(1, Springs(stiffness, stiffness / 2, T(0.4), T(0.5))));
    world.add_grain(world.add_shape(ShapeT(radius)), Pose<S>(Vector(height * up)), 1000);
    world.add_wall(up, Vector::Zero());
    return world;
  };
  const T mass = grain_at(0, 1).bodies().grain_mass[0], sunk = T(0.02) * size;
  auto soft = grain_at(radius - sunk, mass * T(9.81) / sunk);
  soft.set_gravity(T(-9.81) * up);
  soft.allow_overlaps();
  CHECK(one_contains(check(soft, soft.step(T(1e-5))), "at the start"));
  const std::vector<std::string> said = check(soft, soft.step(T(1e-5)));
  CHECK(said.size() == 1);
  CHECK(one_contains(said, "the springs of the law are as soft. Use stiffer springs"));

  auto fast = grain_at(radius + T(1.5e-3), mass * T(1e5));
  fast.set_velocity(fast.grain(0), Vector(T(-10) * up));
  fast.step(T(1e-4));
  const StepReport report = fast.step(T(1e-4));
  const double motion = 10 * 1e-4 / (fast.tolerances().margin * double(size));
  CHECK(report.approach == doctest::Approx(motion).epsilon(1e-5));
  CHECK(one_contains(check(fast, report), "it arose in this step"));
  CHECK(one_contains(check(fast, report), "step too long"));
}

TEST_CASE("check: an obstacle is not judged by its density or size") {
  World world = cube(0.02, 0.02);
  const ShapeId rail = world.add_shape(cuboid<Polyhedron<>>({0.002, 0.002, 0.002}));
  const BodyId obstacle = world.add_grain(rail, Pose<Space<3>>({0.1, 0, 0.1}), 1);
  world.prescribe_motion(obstacle);
  CHECK(run(world, 5e-4, 10).empty());
  world.release(obstacle);
  CHECK(one_contains(run(world, 5e-4, 1), "that of no grain"));
}

TEST_CASE("check: a plank among large grains allows its thickness as the grain size") {
  for (const double size : {0.02, 0.01}) {
    World world(size, Materials<Law>(1, Law(0.5)));
    const ShapeId large = world.add_shape(cuboid<Polyhedron<>>({0.075, 0.075, 0.075}));
    world.add_grain(large, Pose<Space<3>>({0.2, 0, 0.1}), 2700);
    world.add_grain(world.add_shape(cuboid<Polyhedron<>>({0.4, 0.05, 0.01})),
                    Pose<Space<3>>({-0.4, 0, 0.1}), 700);
    world.add_wall({0, 0, 1}, {0, 0, 0});
    world.set_gravity({0, 0, -9.81});
    CHECK(run(world, 1e-4, 3).empty() == (size == 0.02));
  }
}

TEST_CASE("check: each kind of sentence once") {
  World world = cube(20, 0.02);
  SentencesOnce once;
  const auto first = once(check(world, world.step(0.05)));
  CHECK(one_contains(first, "ball around the smallest grain"));
  std::size_t all = 0;
  for (int k = 0; k < 5; ++k) {
    const auto more = check(world, world.step(0.05));
    all += more.size();
    CHECK(once(more).empty());
  }
  CHECK(all >= 5);
  CHECK(once({"overlap of 1e-05 m of the bodies 1 and 2, 0.5 of the grain size."}).size() == 1);
  CHECK(once({"overlap of 0.25 m of the bodies 17 and 2, -2e+10 of the grain size."}).empty());
  CHECK(once({"overlap of 0.25 m", "overlap of 1 mm"}).size() == 2);
}

// Without the direct method, as under a law with a solve() of its own, a stack of 30 cubes creeps although every step converges.
TEST_CASE("check: structures that no direct method judges") {
  for (const bool islands : {true, false})
    for (const int blocks : {1, 2, 30}) {
      CAPTURE(islands);
      CAPTURE(blocks);
      World world = cube(0.02, 0.01);
      ColouredOptions options;
      options.islands = islands;
      world.set_solver(ColouredGaussSeidel(options));
      const ShapeId shape = world.add_shape(cube_shape());
      for (int k = 1; k < blocks; ++k)
        world.add_grain(shape, Pose<Space<3>>({0, 0, 0.01 + 0.02 * k}), 2000);
      const auto all = run(world, 1e-3, 50);
      CHECK(one_contains(all, "no direct method judges") == (!islands && blocks == 30));
      if (blocks == 30 && !islands) CHECK(one_contains(all, "30 contacts high"));
    }
}

// The impulses of the step in which a lid lands say nothing about a structure at rest.
TEST_CASE("check: a lid that lands is no structure at rest") {
  World world = cube(0.02, 0.01);
  ColouredOptions options;
  options.islands = false;
  world.set_solver(ColouredGaussSeidel(options));
  const ShapeId shape = world.add_shape(cube_shape());
  for (int k = 1; k < 8; ++k) world.add_grain(shape, Pose<Space<3>>({0, 0, 0.01 + 0.02 * k}), 2000);
  const BodyId lid = world.add_wall({0, 0, -1}, {0, 0, 0.19});
  world.set_wall_mass(lid, 20);
  world.set_force(lid, {0, 0, -20 * 9.81});
  std::vector<std::string> all;
  for (int k = 0; k < 200 && world.contact_impulse(lid).isZero(0); ++k)
    all = check(world, world.step(1e-3));
  CHECK(!world.contact_impulse(lid).isZero(0));
  CHECK(!one_contains(all, "no direct method judges"));
}

TEST_CASE("check: a tolerance that says little about the forces of stiff contacts") {
  using Soft = Compliant<Law>;
  ColouredOptions options;
  options.tolerance = 1e-2;
  options.islands = false;  // which are solved to less than the tolerance
  Simulation<Polygon<double>, Soft> world(0.02, Materials<Soft>(1, Soft(Law(0.5), 1e9)),
                                          ColouredGaussSeidel(options));
  const ShapeId shape = world.add_shape(cuboid<Polygon<double>>({0.01, 0.01}));
  for (int k = 0; k < 12; ++k)
    world.add_grain(shape, {Eigen::Vector2d(0.002 * (k % 3), 0.01 + 0.0201 * k)}, 2000);
  world.add_wall({0, 1}, {0, 0});
  world.set_gravity({0, -9.81});
  std::vector<std::string> all;
  for (int k = 0; k < 50; ++k)
    for (const std::string& sentence : check(world, world.step(1e-3))) all.push_back(sentence);
  CHECK(one_contains(all, "of the relative compliance"));
  CHECK(one_contains(all, "simulation.set_solver(moreau::ColouredGaussSeidel({.tolerance = "));
}

namespace {

/// What a user may type: SI units unless a test changes a member.
struct Typed {
  double size = 0.02, grain_size = 0.02, density = 2700, gravity = -9.81, friction = 0.5;
  bool floor = true;
};

/// The first sentences about two grains above a floor.
template <class ShapeT>
std::vector<std::string> sentences(const Typed& typed) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  Simulation<ShapeT, Law> world(typed.grain_size, Materials<Law>(1, Law(typed.friction)));
  const ShapeId shape = world.add_shape(regular_shape<ShapeT>(typed.size));
  for (const double side : {-2.0, 2.0})
    world.add_grain(shape, Pose<S>(Vector(typed.size * (side * Vector::UnitX() + 2 * up))),
                    typed.density);
  if (typed.floor) world.add_wall(up, Vector::Zero());
  world.set_gravity(typed.gravity * up);
  return check(world, world.step(1e-4));
}

}  // namespace

TEST_CASE_TEMPLATE("check: numbers in other units, and gravity of the wrong sign", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  CHECK(sentences<ShapeT>({}).empty());
  for (const double gravity : {0.0, -1.62, -9.81, -10.0, -50.0})
    for (const double density : {15.0, 100.0, 1000.0, 2700.0, 22600.0})
      for (const double size : {1e-5, 1e-3, 0.02, 2.0})
        CHECK(sentences<ShapeT>(
                  {.size = size, .grain_size = size, .density = density, .gravity = gravity})
                  .empty());
  for (const double friction : {0.0, 0.3, 2.0, 1e6})
    CHECK(sentences<ShapeT>({.friction = friction}).empty());
  CHECK(sentences<ShapeT>({.density = 1, .gravity = -1}).empty());  // numbers without units
  const auto says = [](const Typed& typed, const char* text) {
    const auto all = sentences<ShapeT>(typed);
    return all.size() == 1 && all[0].find(text) != std::string::npos;
  };
  for (const double density : {0.9, 1.0, 2.7, 7.85, 11.3})
    CHECK(says({.density = density}, "g/cm^3, type "));
  CHECK(says(
      {.density = 2.7},
      "a density of 2.7 kg/m^3 is that of no grain (in the plane 2.7 kg/m^2: of none 1 m thick)"));
  CHECK(says({.density = 2.7e6}, "in g/m^3, type 2700"));
  for (const double size : {5.0, 20.0, 200.0})
    CHECK(says({.size = size, .grain_size = size}, "If lengths are in mm"));
  CHECK(says({.grain_size = 20}, "grain size 20 m, but the ball around the smallest grain"));
  CHECK(says({.gravity = -981}, "If it is in 0.01 m/s^2, type 9.81"));
  CHECK(says({.gravity = -9810}, "If it is in 0.001 m/s^2, type 9.81"));
  CHECK(says({.gravity = 9.81}, "gravity points along the last axis (9.81 m/s^2)"));
  CHECK(says({.gravity = 9.81, .floor = false}, "gravity points along the last axis"));
  for (const double angle : {5.0, 20.0, 30.0, 45.0})
    CHECK(says({.friction = angle}, "looks like an angle in degrees"));
  CHECK(says({.friction = 30}, "its tangent is 0.57735"));
}

namespace {

/// Coulomb's law with an attraction A / (1 + gap / D), which ends nowhere.
template <class T>
struct Sticky : SignoriniCoulomb<T> {
  explicit Sticky(T adhesion) : SignoriniCoulomb<T>(T(0.5)), adhesion_(adhesion) {}
  T attraction(T gap) const { return adhesion_ / (1 + std::max(gap, T(0)) / T(0.001)); }
  Sticky variant(std::size_t) const { return *this; }

 private:
  T adhesion_;
};
template <class T>
struct StickyInRange : Sticky<T> {
  using Sticky<T>::Sticky;
  T range() const { return T(0.003); }
  StickyInRange variant(std::size_t) const { return *this; }
};
/// Two balls at rest without gravity, `apart` [m] from surface to surface.
/// @returns what check() says after the first step, and the relative velocity along the line of the centres [m/s]
template <class LawT, class S>
std::pair<std::vector<std::string>, double> two_balls(const LawT& law, double apart) {
  using T = typename S::Scalar;
  // The solver that takes least to compile.
  Simulation<BallIn<S>, LawT, MoreauJean, CellGrid<S>, NonlinearGaussSeidel> world(
      T(0.02), Materials<LawT>(1, law));
  const ShapeId ball = world.add_shape(BallIn<S>(T(0.01)));
  std::vector<BodyId> pair;
  for (const double side : {-0.5, 0.5}) {
    Pose<S> pose;
    pose.position = T(side * (0.02 + apart)) * S::Vector::UnitX();
    pair.push_back(world.add_grain(ball, pose, T(2000)));
  }
  const StepReport report = world.step(T(1e-4));
  return {check(world, report), double(world.velocity(pair[1])[0] - world.velocity(pair[0])[0])};
}

}  // namespace

TEST_CASE_TEMPLATE("check: an attraction that the margin cuts off, and its range()", S,
                   MOREAU_TYPES((Space<3>), (Space<2>, Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  const auto cut = two_balls<Sticky<T>, S>(Sticky<T>(T(0.1)), 0.001);
  CHECK(one_contains(cut.first, "a law attracts with "));
  CHECK(one_contains(cut.first, "Give the law a function range()"));
  CHECK(cut.second == 0);  // the margin is 0.0004 m
  const auto whole = two_balls<StickyInRange<T>, S>(StickyInRange<T>(T(0.1)), 0.001);
  CHECK(!one_contains(whole.first, "a law attracts with "));
  CHECK(whole.second < 0);
  CHECK(!one_contains(two_balls<Sticky<T>, S>(Sticky<T>(0), 0.001).first, "a law attracts with "));
}

TEST_CASE_TEMPLATE("check: gravity along the last axis is right where something lies there", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector down = Vector::Unit(S::dim - 1);
  for (const bool obstacle : {false, true})
    for (const double side : {-1.0, 1.0}) {
      Simulation<ShapeT, Law> world(0.02, Materials<Law>(1, Law(0.5)));
      const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
      world.add_grain(shape, {}, 2700);
      if (obstacle)
        world.prescribe_motion(world.add_grain(shape, Pose<S>(Vector(side * down)), 2700));
      else
        world.add_wall(-side * down, side * down);
      world.set_gravity(9.81 * down);
      CHECK(check(world, world.step(1e-4)).empty() == (side > 0));
    }
}

TEST_CASE_TEMPLATE("check: gravity along another axis, where nothing can hold the grains", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>, Polyhedron<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  for (int axis = 0; axis < S::dim - 1; ++axis)
    for (const T sign : {T(-1), T(1)})
      for (const bool periodic : {false, true})
        for (const bool wall : {false, true}) {
          if (periodic && wall) continue;
          Simulation<ShapeT, Coulomb> world(T(0.02), Materials<Coulomb>(1, Coulomb(T(0.5))));
          world.add_grain(world.add_shape(regular_shape<ShapeT>(T(0.02))),
                          Pose<S>(Vector(T(0.03) * up)), 2700);
          world.add_wall(up, Vector::Zero());
          const Vector along = sign * Vector::Unit(axis);
          if (wall) world.add_wall(-along, along);
          if (periodic) world.set_periodic(axis, -1, 1);
          world.set_gravity(T(9.81) * along);
          const auto all = check(world, world.step(T(1e-4)));
          CHECK(all.empty() == (wall || periodic));
          CHECK(all.size() <= 1);
          CHECK(one_contains(all, "and no wall and no obstacle lies there") == !all.empty());
          // A chute: the floor holds the grains.
          world.set_gravity(T(9.81) * (T(0.6) * along - T(0.8) * up));
          CHECK(check(world, world.step(T(1e-4))).empty());
        }
}

TEST_CASE_TEMPLATE(
    "check: forces in vain, bodies that all have a prescribed motion, grains too fast for the step",
    ShapeT, MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>, Polyhedron<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const T size : {T(1e-3), T(0.02), T(1)}) {
    CAPTURE(size);
    const auto world = [&] {
      Simulation<ShapeT, Coulomb> made(size, Materials<Coulomb>(1, Coulomb(T(0.5))));
      const ShapeId shape = made.add_shape(regular_shape<ShapeT>(size));
      for (const T height : {T(1), T(3)})
        made.add_grain(shape, Pose<S>(Vector(height * size * up)), 2700);
      made.add_wall(up, Vector::Zero());
      made.add_wall(-up, Vector(6 * size * up));
      made.set_gravity(T(-9.81) * up);
      return made;
    };
    const auto says = [](auto& simulation, const char* text) {
      const auto all = check(simulation, simulation.step(T(1e-4)));
      return all.size() == 1 && all[0].find(text) != std::string::npos;
    };
    auto a = world();
    CHECK(check(a, a.step(T(1e-4))).empty());
    a.set_force(BodyId(3), T(-1) * up);
    CHECK(says(a, "the force or torque of body 3 has no effect: its motion is prescribed"));
    CHECK(says(a, "or set_force() with zero if it shall be driven"));
    a.set_wall_mass(BodyId(3), T(1e3));
    CHECK(check(a, a.step(T(1e-4))).empty());
    const char* aside =
        "has no effect, or a part of it: a wall with a mass moves along the first axis of its "
        "frame";
    a.set_force(BodyId(3), T(-1) * up + T(1e-2) * Vector::UnitX());
    CHECK(says(a, aside));
    a.set_force(BodyId(3), T(-1) * up + T(1e-5) * Vector::UnitX());  // rounding
    CHECK(check(a, a.step(T(1e-4))).empty());
    a.set_torque(BodyId(3), S::Angular::Constant(T(1e-6)));
    CHECK(says(a, aside));
    a.set_torque(BodyId(3), S::Angular::Zero());
    a.set_force(BodyId(1), T(1e-3) * up);
    CHECK(check(a, a.step(T(1e-4))).empty());
    a.prescribe_motion(BodyId(1));
    CHECK(says(a, "the force or torque of body 1 has no effect"));
    a.set_force(BodyId(1), Vector::Zero());
    CHECK(check(a, a.step(T(1e-4))).empty());
    a.prescribe_motion(BodyId(0));
    CHECK(check(a, a.step(T(1e-4))).empty());  // the wall has a mass

    auto b = world();
    b.prescribe_motion(BodyId(0)), b.prescribe_motion(BodyId(1));
    CHECK(says(b, "the motion of all bodies is prescribed"));

    auto lid = world();
    lid.set_wall_mass(BodyId(3), T(1e3));
    lid.set_pose(BodyId(3), {Vector(T(0.1) * size * up), lid.pose(BodyId(3)).rotation});
    lid.remove_grains(std::vector<BodyId>{lid.grain(0), lid.grain(1)});
    CHECK(!one_contains(check(lid, lid.step(T(1e-4))), "has passed"));
    lid.set_velocity(BodyId(3), T(-0.2) * size / T(1e-4) * up);
    CHECK(one_contains(check(lid, lid.step(T(1e-4))), "wall 3 has passed wall 2, which it faces"));

    for (const T steps : {T(0.5), T(0.9), T(1.1), T(50)}) {
      auto c = world();
      c.set_velocity(BodyId(1), steps * size / T(1e-4) * Vector::UnitX());
      const auto all = check(c, c.step(T(1e-4)));
      CHECK(one_contains(all, "it can pass through others") == (steps > 1));
      CHECK(all.size() == std::size_t(steps > 1));
      // The same of a grain of prescribed motion, but not of a half-space that moves along itself.
      auto d = world();
      d.prescribe_motion(BodyId(1));
      d.set_velocity(BodyId(1), steps * size / T(1e-4) * Vector::UnitX());
      d.set_velocity(BodyId(2), T(60) * size / T(1e-4) * Vector::UnitX());
      const auto of_paddle = check(d, d.step(T(1e-4)));
      CHECK(one_contains(of_paddle, "body 1 moves by") == (steps > 1));
      CHECK(of_paddle.size() == std::size_t(steps > 1));
    }
  }
}

TEST_CASE_TEMPLATE("check: a lost grain is named, and one beyond what the scalar holds", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  for (const int count : {3, 8, 30})
    for (const double distance : {0.0, 10.0, 1e3, 1e7, 1e12}) {
      CAPTURE(count);
      CAPTURE(distance);
      Simulation<ShapeT, Law> world(0.02, Materials<Law>(1, Law(0.5)));
      const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
      for (int k = 0; k < count; ++k) {
        Vector x = Vector::Constant(0.03 * (k % 3));
        x[0] = 0.03 * (k / 3);
        if (k == 1) x[S::dim - 1] += distance;
        world.add_grain(shape, Pose<S>(x), 2700);
      }
      const auto all = check(world, world.step(1e-4));
      CHECK(one_contains(all, "grain 1 is lost: ") == (distance > (count < 10 ? 200 : 9)));
      CHECK(one_contains(all, "from the origin, where positions are known") == (distance > 1e11));
      CHECK(all.size() == std::size_t((distance > (count < 10 ? 200 : 9)) + (distance > 1e11)));
    }
}

TEST_CASE_TEMPLATE("check: a grain that has drifted through many periodic cells", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (Disk<float>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  constexpr T size = T(0.02), cell = T(0.25);
  for (const double share :
       {0.5, 4.0}) {  // of the distance at which a thousandth of the grain size is lost
    Simulation<ShapeT, Coulomb> world(size, Materials<Coulomb>(1, Coulomb(T(0.5))));
    const ShapeId shape = world.add_shape(ShapeT(size / 2));
    world.set_periodic(0, 0, cell);
    world.add_grain(shape, Pose<S>(Vector(Vector::Zero())), 2700);
    const double limit = 1e-3 * double(size) / double(std::numeric_limits<T>::epsilon());
    const T away = cell * T(std::round(share * limit / double(cell)));
    world.add_grain(shape, Pose<S>(Vector((cell / 2 + away) * Vector::UnitX())), 2700);
    const auto all = check(world, world.step(T(1e-4)));
    CHECK(all.size() == (share > 1 ? 1 : 0));
    if (share > 1) CHECK(one_contains(all, "move grains by whole periodic cells (set_pose)"));
    if (share > 1) CHECK(one_contains(all, "grain 1 is "));
  }
}

TEST_CASE_TEMPLATE(
    "check: a mesh wall whose facets are turned round, from behind which grains pass", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>, Disk<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  // A floor at height 0: two facets that join, and in space a third corner.
  FacetMesh<S> floor;
  for (const T x : {T(-1), T(0), T(1)})
    floor.vertices.push_back(x * Vector::UnitX() +
                             (S::dim == 3 && x != 0 ? T(-1) : T(0)) * Vector::Unit(1));
  for (std::uint32_t k = 0; k < 2; ++k) {
    floor.facets.emplace_back();
    floor.facets[k][0] = k + 1, floor.facets[k][1] = k;  // in the plane the outside is on the right
  }
  if (S::dim == 3) {
    floor.vertices[1] = -Vector::Unit(1);
    floor.vertices.push_back(Vector::Unit(1));
    for (auto& facet : floor.facets) facet[S::dim - 1] = 3;
    for (auto& facet : floor.facets) std::swap(facet[0], facet[1]);
  }
  for (const bool turned : {false, true})
    for (const WallSides sides : {WallSides::outside, WallSides::both})
      for (const bool added_below : {false, true}) {
        CAPTURE(turned);
        CAPTURE(added_below);
        Simulation<ShapeT, Coulomb> world(T(0.02), Materials<Coulomb>(1, Coulomb(T(0.5))));
        auto mesh = floor;
        if (turned)
          for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);
        const BodyId wall = world.add_mesh_wall(mesh, Pose<S>(Vector(T(0.3) * up)), sides);
        const ShapeT grain = regular_shape<ShapeT>(T(0.02));
        const ShapeId shape = world.add_shape(grain);
        const T below = T(-0.97) * circumradius(grain);  // a polytope is held up to its inradius
        for (int k = 0; k < 2; ++k)
          world.add_grain(shape,
                          Pose<S>(Vector((T(0.3) + (added_below ? below : T(0.012))) * up +
                                         T(0.2 * k - 0.1) * Vector::UnitX())),
                          2700);
        world.add_wall(up, Vector::Zero());  // below
        world.set_gravity(T(-9.81) * up);
        world.allow_overlaps();
        bool said = false, said_afterwards = false;
        for (int k = 0; k < 200; ++k)
          for (const std::string& sentence : check(world, world.step(T(5e-4)))) {
            const auto has = [&](const std::string& text) {
              return sentence.find(text) != std::string::npos;
            };
            const std::string number = std::to_string(wall.index());
            if (has("of mesh wall " + number + ", which holds grains on one side")) said = true;
            if (has("Mesh wall " + number + " holds grains on one side: one that comes from"))
              said_afterwards = true;
          }
        const bool is_one_sided = sides == WallSides::outside;
        // From below the grains are behind the wall that faces up, and above one that faces down until they have passed.
        CHECK(said == (is_one_sided && turned != added_below));
        // Once their centre has passed they overlap the wall deeply.
        if (!added_below) CHECK(said_afterwards == (is_one_sided && turned));
        CHECK((world.pose(world.grain(0)).position.dot(up) > T(0.3)) ==
              (!added_below && (!turned || !is_one_sided)));
      }
}

TEST_CASE("check: a thin plate on a thin wall, and a grain beside a rim, are in front of it") {
  World world(0.002, Materials<Law>(1, Law(0.5)));
  TriangleMesh<> box;  // 1 mm thick, the outside outside
  for (int k = 0; k < 8; ++k)
    box.vertices.push_back({k & 1 ? 0.1 : -0.1, k & 2 ? 0.1 : -0.1, k & 4 ? 0.0 : -0.001});
  const std::uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& side : sides) {
    box.facets.push_back({side[0], side[1], side[2]});
    box.facets.push_back({side[0], side[2], side[3]});
  }
  world.add_mesh_wall(box);
  const ShapeId plate = world.add_shape(cuboid<Polyhedron<>>({0.03, 0.03, 0.001}));
  world.add_grain(plate, Pose<Space<3>>({0, 0, 0.001}), 2700);
  world.add_grain(plate, Pose<Space<3>>({0.131, 0, -0.0005}), 2700);  // falls beside the wall
  world.set_gravity({0, 0, -9.81});
  CHECK(run(world, 2e-4, 100).empty());
}

TEST_CASE_TEMPLATE(
    "check: a lid without weight, walls in one place, a spin in revolutions per minute", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>, Disk<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  constexpr T size = T(0.02), h = T(1e-4);
  const auto box = [&] {
    Simulation<ShapeT, Coulomb> made(size, Materials<Coulomb>(1, Coulomb(T(0.5))));
    made.add_wall(up, Vector::Zero());
    made.add_wall(-up, Vector(3 * size * up));
    made.add_grain(made.add_shape(regular_shape<ShapeT>(size)), Pose<S>(Vector(size / 2 * up)),
                   2700);
    made.set_gravity(T(-9.81) * up);
    return made;
  };
  const auto says = [](auto& simulation, const char* text) {
    const auto all = check(simulation, simulation.step(h));
    return all.size() == 1 && all[0].find(text) != std::string::npos;
  };
  auto lid = box();
  CHECK(check(lid, lid.step(h)).empty());
  lid.set_wall_mass(BodyId(1), 5);
  CHECK(says(lid, "wall 1 has a mass of 5 kg, and no force acts on it: gravity does not act on"));
  CHECK(says(lid, "with its weight of 49.05 N"));
  lid.set_force(BodyId(1), T(-1e-3) * up);
  CHECK(check(lid, lid.step(h)).empty());
  lid.set_force(BodyId(1), T(1e-3) * up);  // with the wrong sign
  CHECK(check(lid, lid.step(h)).empty());  // it still moves down
  lid.set_force(BodyId(1), T(9.81) * up);
  CHECK(says(lid, "the force on wall 1, -9.81 N along its normal, pulls it away from the grains"));
  // A piston that has pressed is pulled back on purpose.
  auto piston = box();
  piston.set_wall_mass(BodyId(1), 5);
  piston.set_force(BodyId(1), T(-50) * up);
  for (int k = 0; k < 3000 && piston.contact_impulse(BodyId(1)).isZero(0); ++k) piston.step(h);
  for (int k = 0; k < 100; ++k) piston.step(h);
  CHECK(!piston.contact_impulse(BodyId(1)).isZero(0));
  piston.set_force(BodyId(1), T(50) * up);
  for (int k = 0; k < 50; ++k) CHECK(check(piston, piston.step(h)).empty());
  CHECK(piston.velocity(BodyId(1)).dot(up) > 0);
  // A lid that slides: set_velocity() in every step holds it back, in the air and where it touches grains a little.
  for (const bool is_held_back : {false, true}) {
    auto shear = box();
    shear.set_wall_mass(BodyId(1), 5);
    shear.set_force(BodyId(1), T(-50) * up);
    bool said = false;
    for (int k = 0; k < 100; ++k) {
      const T along = is_held_back || k == 0 ? T(0) : T(shear.velocity(BodyId(1)).dot(up));
      shear.set_velocity(BodyId(1), Vector(T(0.1) * Vector::UnitX() + along * up));
      const auto all = check(shear, shear.step(h));
      said = one_contains(all, "wall 1 slides, and began the step at rest along its normal");
      REQUIRE(said == (is_held_back && k > 0));
      REQUIRE(all.size() == std::size_t(said));
    }
  }
  // Neither of a wall that gravity pulls away from the grains, nor of one beside them.
  auto floor = box();
  floor.set_wall_mass(BodyId(0), 5);
  CHECK(check(floor, floor.step(h)).empty());
  auto side = box();
  side.set_wall_mass(side.add_wall(Vector::UnitX(), Vector(-size * Vector::UnitX())), 5);
  CHECK(check(side, side.step(h)).empty());

  for (const T apart : {T(0), T(5e-4) * size, T(0.01) * size}) {
    auto twice = box();
    twice.add_wall(up, Vector(7 * Vector::UnitX() - apart * up));
    const auto all = check(twice, twice.step(h));
    CHECK(one_contains(all, "walls 0 and 3 lie in the same place") == (apart < T(1e-3) * size));
    CHECK(all.size() == std::size_t(apart < T(1e-3) * size));
  }

  const auto radius = T(circumradius(regular_shape<ShapeT>(size)));
  for (const T share : {T(0.4), T(0.9), T(1.1), T(20)})  // of half the grain size
    for (const bool is_obstacle : {false, true}) {
      CAPTURE(share);
      CAPTURE(is_obstacle);
      auto turning = box();
      const BodyId grain(2);
      // Without friction between grains and walls, which would stop it; an obstacle turns beside a grain.
      turning.set_materials(Materials<Coulomb>(1, Coulomb(T(0))));
      turning.set_pose(grain, Pose<S>(Vector(T(1.5) * size * up)));
      const T spin = share * size / 2 / h / (is_obstacle ? size / 2 : radius);
      turning.set_spin(grain, typename S::Angular(spin * S::Angular::Unit(0)));
      if (is_obstacle) {
        turning.prescribe_motion(grain);
        turning.add_grain(ShapeId(0), Pose<S>(Vector(T(0.5) * size * up)), 2700);
      }
      const auto all = check(turning, turning.step(h));
      const bool is_ball = radius < T(0.51) * size;
      if (!is_obstacle || is_ball)
        CHECK(one_contains(all, "is in revolutions per minute, type ") == (share > 1));
      if (!is_obstacle) CHECK(all.size() == std::size_t(share > 1));
    }
}

TEST_CASE_TEMPLATE("check: a mesh in millimetres around grains in metres", ShapeT,
                   MOREAU_TYPES((Disk<>, Polyhedron<>), (Polygon<>, Ball<>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  constexpr T size = T(0.02);
  // A box with its corner in the origin, 0.4 m wide.
  const auto box = [&](T unit) {
    FacetMesh<S> mesh;
    for (unsigned corner = 0; corner < 1u << S::dim; ++corner) {
      Vector& x = mesh.vertices.emplace_back();
      for (int k = 0; k < S::dim; ++k) x[k] = T(corner >> k & 1u);
    }
    if constexpr (S::dim == 2)
      mesh.facets = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
    else
      mesh.facets = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    Simulation<ShapeT, Coulomb> made(size, Coulomb(T(0.5)));
    made.add_mesh_wall(scaled(mesh, T(0.4) * unit), {}, WallSides::both);
    const ShapeId shape = made.add_shape(regular_shape<ShapeT>(size));
    for (const T x : {T(0.05), T(0.35)})
      made.add_grain(shape, Pose<S>(Vector(Vector::Constant(x))), 2700);
    made.set_gravity(T(-9.81) * Vector::Unit(S::dim - 1));
    return made;
  };
  for (const T unit : {T(1), T(25), T(1000)}) {
    auto world = box(unit);
    const auto all = check(world, world.step(T(1e-4)));
    CHECK(one_contains(all, "add scaled(mesh, 0.001)") == (unit == 1000));
    CHECK(all.size() == std::size_t(unit == 1000));
  }
  // A grain elsewhere in a large mesh, and a large floor, are what they are.
  auto apart = box(1000);
  apart.add_grain(ShapeId(0), Pose<S>(Vector(Vector::Constant(T(30)))), 2700);
  CHECK(!one_contains(check(apart, apart.step(T(1e-4))), "add scaled(mesh, 0.001)"));
}

TEST_CASE_TEMPLATE("check: a drum that turns too fast", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (Disk<float>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const T spin : {T(10), T(3000)}) {
    Simulation<ShapeT, Coulomb> world(T(0.01), Materials<Coulomb>(1, Coulomb(T(0.5))));
    const typename S::Angular axis = S::Angular::Unit(S::angular_dim / 2);
    const BodyId drum = world.add_cylinder(Vector::Zero(), axis, T(0.1));
    world.add_grain(world.add_shape(ShapeT(T(0.005))), Pose<S>(Vector(T(-0.095) * up)), 2500);
    world.set_gravity(T(-9.81) * up);
    world.set_spin(drum, typename S::Angular(spin * axis));
    const auto all = check(world, world.step(T(1e-4)));
    CHECK(one_contains(all, "body 0 turns by 0.3 rad in the step: its surface moves by 0.03 m") ==
          (spin > 100));
    CHECK(one_contains(all, "type 314.159 rad/s") == (spin > 100));
    CHECK(all.empty() == (spin < 100));
  }
}

TEST_CASE_TEMPLATE("check: a cylinder twice, a mesh twice", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  constexpr T size = T(0.02);
  const typename S::Angular axis = S::Angular::Unit(0);
  const Vector aside = Vector::Unit(S::dim - 1);
  FacetMesh<S> far;  // one facet
  for (int k = 0; k < S::dim; ++k) far.vertices.push_back(Vector(Vector::Unit(k)));
  far.facets.emplace_back();
  for (std::uint32_t k = 0; k < S::dim; ++k) far.facets[0][k] = k;
  for (const T apart : {T(0), T(5e-4) * size, T(0.01) * size})
    for (const bool is_mesh : {false, true}) {
      CAPTURE(apart);
      CAPTURE(is_mesh);
      Simulation<ShapeT, Coulomb> world(size, Materials<Coulomb>(1, Coulomb(T(0.5))));
      // A point of a cylinder can be any of its axis.
      const Vector other = apart * aside + T(S::dim == 3 && !is_mesh ? 7 : 0) * Vector::UnitX();
      for (const Vector& at : {Vector(Vector::Zero()), other})
        if (is_mesh)
          world.add_mesh_wall(far, Pose<S>(at));
        else
          world.add_cylinder(at, axis, T(0.5));
      world.add_cylinder(Vector::Zero(), axis, T(0.6));
      world.add_grain(world.add_shape(regular_shape<ShapeT>(size)), Pose<S>(), 2700);
      world.set_gravity(T(-9.81) * aside);
      const auto all = check(world, world.step(T(1e-4)));
      CHECK(one_contains(all, "walls 0 and 1 lie in the same place") == (apart < T(1e-3) * size));
      CHECK(all.size() == std::size_t(apart < T(1e-3) * size));
    }
}

TEST_CASE_TEMPLATE("check: an overlap by a body that is driven", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector along = Vector::UnitX();
  for (const bool by_obstacle : {false, true}) {
    CAPTURE(by_obstacle);
    Simulation<ShapeT, Law> world(0.02, Materials<Law>(1, Law(0.3)));
    world.add_wall(along, Vector(-0.01 * along));
    const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
    world.add_grain(shape, {}, 2700);
    BodyId piston;
    if (by_obstacle) {
      piston = world.add_grain(shape, Pose<S>(Vector(0.02 * along)), 2700);
      world.prescribe_motion(piston);
    } else {
      piston = world.add_wall(-along, Vector(0.01 * along));
    }
    world.set_velocity(piston, Vector(-0.05 * along));
    std::vector<std::string> all;
    for (int k = 0; k < 30; ++k) all = check(world, world.step(1e-3));
    CHECK(one_contains(all, "If body 2, whose motion is prescribed, presses grains that cannot"));
    CHECK(!one_contains(all, "stiffer contacts"));
    world.set_velocity(piston, Vector(0.05 * along));
    all = check(world, world.step(1e-3));
    CHECK(!one_contains(all, "whose motion is prescribed, presses"));
    CHECK(one_contains(all, "stiffer contacts"));
    // It moves towards grains again, and touches none.
    world.set_pose(piston, Pose<S>(Vector(0.05 * along), world.pose(piston).rotation));
    world.set_velocity(piston, Vector(-0.05 * along));
    world.set_pose(world.grain(0), Pose<S>(Vector(-0.0005 * along)));
    world.step(1e-4);
    all = check(world, world.step(1e-4));
    CHECK(one_contains(all, "older than this step, in which no surfaces approach"));
  }
}

TEST_CASE_TEMPLATE("check: a step that does not resolve an impact", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (Disk<float>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Springs = LinearSpringDashpot<T>;
  const Springs springs(T(1e5), T(5e4), T(0.4), T(0.5));
  for (const T share : {T(0.05), T(0.19), T(0.21), T(0.5)}) {
    Simulation<ShapeT, Springs> world(T(0.02), Materials<Springs>(1, springs));
    const ShapeId shape = world.add_shape(ShapeT(T(0.01)));
    for (int k = 0; k < 2; ++k)
      world.add_grain(shape, Pose<S>(Vector(T(0.05 * k + 0.02) * Vector::Unit(S::dim - 1))), 2700);
    world.add_wall(Vector::Unit(S::dim - 1), Vector::Zero());
    const T h = share * springs.duration(world.bodies().grain_mass[0] / 2);
    const auto all = check(world, world.step(h));
    CHECK(one_contains(all, "does not resolve an impact of two of the lightest grains") ==
          (share > T(0.2)));
    CHECK(all.size() == std::size_t(share > T(0.2)));
  }
  // The duration of Hertz's impact depends on the speed: nothing is said before two grains approach.
  using Hertz = HertzMindlin<T>;
  const Hertz soft(T(1e7), T(1e6), T(0.4), T(0.5));
  for (const T share : {T(0.05), T(0.19), T(0.21), T(0.5)}) {
    Simulation<ShapeT, Hertz> world(T(0.02), soft);
    const ShapeId shape = world.add_shape(ShapeT(T(0.01)));
    const BodyId ball =
        world.add_grain(shape, Pose<S>(Vector(T(0.0102) * Vector::Unit(S::dim - 1))), T(2700));
    world.add_wall(Vector::Unit(S::dim - 1), Vector::Zero());
    const T h = share * soft.duration(world.bodies().grain_mass[0] / 2, T(0.005), T(1));
    CHECK(check(world, world.step(h)).size() == 0);
    world.set_velocity(ball, -Vector::Unit(S::dim - 1));
    const auto all = check(world, world.step(T(1.001) * h));
    CHECK(one_contains(all, "does not resolve an impact of two of the lightest grains") ==
          (share > T(0.2)));
  }
}
