// SPDX-License-Identifier: MIT
// What a simulation says about its bodies: poses, velocities, shapes, grains and walls.
#include "moreau/world/body_access.hpp"

#include <doctest/doctest.h>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "io/temporary_folder.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<double>;

/// A wall, two grains of radius 0.1 and 0.2 m, a cylinder and a third grain, in this order.
template <class ShapeT>
struct Scene {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Simulation<ShapeT, Law> world{0.2, Materials<Law>(1, Law(0.3))};
  ShapeId small = world.add_shape(ShapeT(0.1)), large = world.add_shape(ShapeT(0.2));
  BodyId floor = world.add_wall(Vector::Unit(S::dim - 1), Vector::Zero());
  BodyId first = world.add_grain(small, {Vector::Constant(1), S::identity()}, 1000);
  BodyId second = world.add_grain(large, {Vector::Constant(2), S::identity()}, 1000);
  BodyId cylinder = world.add_cylinder(Vector::Zero(), S::Angular::Unit(S::angular_dim - 1), 9);
  BodyId third = world.add_grain(small, {Vector::Constant(3), S::identity()}, 1000);
};

}  // namespace

TEST_CASE_TEMPLATE("poses and velocities are those that were set", ShapeT, Ball<>, Disk<>) {
  using S = SpaceOf<ShapeT>;
  Scene<ShapeT> scene;
  auto& world = scene.world;
  CHECK(world.pose(scene.second).position == S::Vector::Constant(2));
  CHECK(world.velocity(scene.second).isZero(0));
  const typename S::Vector velocity = 3 * S::Vector::UnitX();
  const typename S::Angular spin = 4 * S::Angular::Unit(S::angular_dim - 1);
  world.set_velocity(scene.second, velocity);
  world.set_spin(scene.second, spin);
  CHECK(world.velocity(scene.second) == velocity);
  CHECK(world.spin(scene.second) == spin);
  CHECK(world.velocity(scene.first).isZero(0));
  CHECK(world.spin(scene.first).isZero(0));
  Pose<S> pose = world.pose(scene.floor);
  pose.position[0] = 5;
  world.set_pose(scene.floor, pose);
  CHECK(world.pose(scene.floor).position[0] == 5);
}

TEST_CASE_TEMPLATE("grains, walls and cylinders are listed in their order", ShapeT, Ball<>,
                   Disk<>) {
  Scene<ShapeT> scene;
  const auto& world = scene.world;
  std::vector<BodyId> grains;
  for (const BodyId grain : world.grains()) grains.push_back(grain);
  CHECK(grains == std::vector<BodyId>{scene.first, scene.second, scene.third});
  CHECK(world.grain_count() == 3);
  CHECK(world.grain(2) == scene.third);
  REQUIRE(world.walls().size() == 1);
  CHECK(world.walls()[0] == scene.floor);
  REQUIRE(world.cylinders().size() == 1);
  CHECK(world.cylinders()[0].body == scene.cylinder);
  CHECK(world.cylinders()[0].shape.radius() == 9);
  CHECK(world.shape(scene.second).radius() == 0.2);
  CHECK(world.shape(scene.third).radius() == 0.1);
  CHECK(&world.shape(scene.third) == &world.shape_of_grain(2));
}

TEST_CASE("the list of grains is the same after a snapshot was read") {
  const TemporaryFolder folder("body_access");
  Scene<Disk<>> scene;
  write_snapshot(folder / "world", scene.world);
  Simulation<Disk<>, Law> again(0.2, Materials<Law>(1, Law(0.3)));
  again.add_grain(again.add_shape(Disk<>(0.1)), {}, 1000);
  CHECK_THROWS_WITH_AS(read_snapshot(folder / "world", again),
                       doctest::Contains("read_snapshot: bodies = 1 must be 0"),
                       std::invalid_argument);
  REQUIRE(again.grains().size() == 1);
  reload_snapshot(folder / "world", again);
  REQUIRE(again.grains().size() == 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(again.grains()[k] == scene.world.grain(k));
  CHECK(again.shape(scene.second).radius() == 0.2);
}

TEST_CASE("an id that is not of the simulation is an error that names function and value") {
  Scene<Disk<>> scene;
  const auto& world = scene.world;
  const BodyId none(5);
  CHECK_THROWS_WITH_AS(world.pose(none), "Simulation::pose: body = 5 must be the id of a body",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.velocity(none),
                       "Simulation::velocity: body = 5 must be the id of a body",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.spin(none), "Simulation::spin: body = 5 must be the id of a body",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.shape(scene.floor),
                       "Simulation::shape: grain = 0 must be the id of a grain",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.shape(none), "Simulation::shape: grain = 5 must be the id of a grain",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.grain(3), std::invalid_argument);
  CHECK_THROWS_AS(world.shape_of_grain(3), std::invalid_argument);
}
