// SPDX-License-Identifier: MIT
// Mesh walls in a simulation: they hold grains as half-spaces do where they are plane, they move, and
// they are part of a snapshot.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/moreau.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/shape/compound.hpp"

#include "conformance/random_direction.hpp"
#include "detect/mesh_surfaces.hpp"
#include "io/temporary_folder.hpp"
#include "world/mesh_floor.hpp"
#include "world/tiles.hpp"

namespace {

using namespace moreau;
using mesh_floor::floor_of;
using Plane = Space<2, double>;
using Volume = Space<3, double>;
using Law = SignoriniCoulomb<double>;
template <class ShapeT>
using World = Simulation<ShapeT, Law>;

const auto flat = [](const auto&) { return 0.0; };

template <class ShapeT>
World<ShapeT> world(double size, double friction = 0.3) {
  using S = SpaceOf<ShapeT>;
  World<ShapeT> simulation(size, Materials<Law>(1, Law(friction)));
  simulation.set_gravity(-9.81 * S::Vector::Unit(S::dim - 1));
  return simulation;
}

template <class ShapeT>
ShapeT grain();
template <>
Polyhedron<> grain() {
  return cuboid<Polyhedron<>>({0.02, 0.015, 0.01});
}
template <>
Polygon<> grain() {
  return cuboid<Polygon<>>({0.02, 0.01});
}
template <>
Ball<> grain() {
  return Ball<>(0.01);
}
template <>
Disk<> grain() {
  return Disk<>(0.01);
}
template <>
Capsule<> grain() {
  return Capsule<>(0.03, 0.01);
}
template <>
Rounded<Polyhedron<>> grain() {
  return Rounded<Polyhedron<>>(cuboid<Polyhedron<>>({0.016, 0.011, 0.006}), 0.004);
}

template <>
Compound<Polyhedron<>> grain() {
  return Compound<Polyhedron<>>({{grain<Polyhedron<>>(), {{-0.02, 0, 0}}},
                                 {grain<Polyhedron<>>(), {{0.02, 0, 0}}},
                                 {grain<Polyhedron<>>(), {{0, 0.03, 0}}}});
}
template <>
Compound<Polygon<>> grain() {
  return Compound<Polygon<>>(
      {{grain<Polygon<>>(), {{-0.02, 0}}}, {grain<Polygon<>>(), {{0.02, 0}}}});
}

}  // namespace

TEST_CASE_TEMPLATE("a grain that slides over a tessellated floor moves as over a half-space",
                   ShapeT, Polyhedron<>, Polygon<>, Ball<>, Disk<>, Capsule<>,
                   Rounded<Polyhedron<>>, Compound<Polyhedron<>>, Compound<Polygon<>>) {
  using S = SpaceOf<ShapeT>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  auto on_plane = world<ShapeT>(0.02), on_mesh = world<ShapeT>(0.02);
  on_plane.add_wall(up, S::Vector::Zero());
  on_mesh.add_mesh_wall(floor_of(S{}, 1, 51, flat));
  double worst = 0, path = 0;
  for (auto* simulation : {&on_plane, &on_mesh}) {
    const BodyId body = simulation->add_grain(simulation->add_shape(grain<ShapeT>()),
                                              {0.0100001 * up, S::identity()}, 2700);
    typename S::Vector velocity = S::Vector::UnitX() * 1.0;
    if (S::dim == 3) velocity[1] = 0.3;
    simulation->set_velocity(body, velocity);
  }
  for (int step = 0; step < 600; ++step) {
    on_plane.step(5e-4);
    on_mesh.step(5e-4);
    const auto a = on_plane.pose(on_plane.grain(0)), b = on_mesh.pose(on_mesh.grain(0));
    worst = std::max(worst, (a.position - b.position).norm());
    path = a.position.norm();
  }
  CHECK(path > 0.1);
  MESSAGE("path " << path << " m, largest difference " << worst << " m");
  CHECK(worst < 1e-9);
}

TEST_CASE_TEMPLATE("polytopes slide over floors of tiles that are obstacles and meshes", P,
                   Polyhedron<>, Polygon<>) {
  const int directions = SpaceOf<P>::dim == 2 ? 42 : 84;
  tiles::check_directions<World<P>, P, tiles::SlideOnMeshes>(tiles::polytopes<P, P>(), directions,
                                                             1e-6);
}

TEST_CASE_TEMPLATE("a block on the edge of a table stays or tips as its centre says", ShapeT,
                   Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  for (const double beyond : {-0.001, 0.001}) {  // of the centre, beyond the edge at x = 0.2 [m]
    auto simulation = world<ShapeT>(0.02);
    simulation.add_mesh_wall(floor_of(S{}, 0.2, 7, flat));
    const BodyId block = simulation.add_grain(
        simulation.add_shape(grain<ShapeT>()),
        {0.01 * up + (0.2 + beyond) * S::Vector::UnitX(), S::identity()}, 2700);
    for (int step = 0; step < 400; ++step) simulation.step(1e-3);
    const double drop = 0.01 - simulation.pose(block).position.dot(up);
    CAPTURE(beyond);
    if (beyond < 0)
      CHECK(std::abs(drop) < 1e-4);
    else
      CHECK(drop > 0.05);
  }
}

TEST_CASE_TEMPLATE("nothing passes a wall at the speed of one margin per step", ShapeT,
                   Polyhedron<>, Polygon<>, Ball<>, Disk<>, Capsule<>, Rounded<Polyhedron<>>) {
  using S = SpaceOf<ShapeT>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  const double h = 5e-4, size = 0.02;
  // Waves of 3 cm with a height of 4 mm: facets of a third of a grain.
  const auto wave = [](const auto& x) {
    return 0.002 * std::sin(2 * std::numbers::pi * x[0] / 0.03);
  };
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  double deepest = 0;
  for (int trial = 0; trial < 20; ++trial) {
    auto simulation = world<ShapeT>(size);
    simulation.add_mesh_wall(floor_of(S{}, 0.2, 61, wave));
    typename S::Angular turn;
    for (auto& x : turn) x = normal(random);
    const BodyId body = simulation.add_grain(simulation.add_shape(grain<ShapeT>()),
                                             {0.05 * up, S::exp(turn)}, 2700);
    // The margin is 0.02 grain sizes: 0.8 m/s.
    simulation.set_velocity(body, -0.02 * size / h * up);
    for (int step = 0; step < 500; ++step) simulation.step(h);
    const double height = simulation.pose(body).position.dot(up);
    deepest = std::min(deepest, height);
    CHECK(height > 0.002);
  }
}

TEST_CASE_TEMPLATE("one side or both", ShapeT, Polyhedron<>, Polygon<>, Ball<>, Disk<>) {
  using S = SpaceOf<ShapeT>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    auto simulation = world<ShapeT>(0.02);
    simulation.set_gravity(9.81 * up);  // from below, upwards
    simulation.add_mesh_wall(floor_of(S{}, 0.2, 9, flat), {}, sides);
    const BodyId body = simulation.add_grain(simulation.add_shape(grain<ShapeT>()),
                                             {-0.02 * up, S::identity()}, 2700);
    for (int step = 0; step < 300; ++step) simulation.step(5e-4);
    const double height = simulation.pose(body).position.dot(up);
    if (sides == WallSides::both)
      CHECK(height == doctest::Approx(-0.01).epsilon(0.01));
    else
      CHECK(height > 0.02);
  }
}

TEST_CASE_TEMPLATE("a grain stays in a bowl, which turns", ShapeT, Polyhedron<>, Polygon<>, Ball<>,
                   Disk<>, Capsule<>) {
  using S = SpaceOf<ShapeT>;
  auto simulation = world<ShapeT>(0.02);
  FacetMesh<S> bowl = star_mesh<S>([](const auto&) { return 0.1; }, 3);
  for (auto& facet : bowl.facets) std::swap(facet[0], facet[1]);  // the outside is within
  const BodyId wall = simulation.add_mesh_wall(bowl);
  simulation.set_spin(wall, S::Angular::Constant(3));
  std::vector<BodyId> grains;
  const ShapeId shape = simulation.add_shape(grain<ShapeT>());
  for (int k = 0; k < 3; ++k)  // capsules lie along the first axis
    grains.push_back(
        simulation.add_grain(shape, {0.062 * (k - 1) * S::Vector::UnitY(), S::identity()}, 2700));
  for (int step = 0; step < 1000; ++step) simulation.step(5e-4);
  for (const BodyId body : grains) CHECK(simulation.pose(body).position.norm() < 0.095);
}

TEST_CASE_TEMPLATE("a wall that moves lifts a grain, a wall with a mass is carried by it", ShapeT,
                   Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  auto simulation = world<ShapeT>(0.02);
  const BodyId floor = simulation.add_mesh_wall(floor_of(S{}, 0.2, 9, flat));
  const BodyId block =
      simulation.add_grain(simulation.add_shape(grain<ShapeT>()), {0.01 * up, S::identity()}, 2700);
  // A plate above: its first axis points down.
  FacetMesh<S> plate = floor_of(S{}, 0.2, 9, flat);
  for (auto& x : plate.vertices) {  // its normal becomes the first axis
    const double height = x[S::dim - 1];
    for (int k = S::dim - 1; k > 0; --k) x[k] = x[k - 1];
    x[0] = height;
  }
  const Pose<S> above(0.0201 * up, S::normalized(typename S::Rotation(S::contact_frame(-up))));
  FacetMesh<S> turned = plate;
  MeshWall<S> wall(plate);
  if (wall.side(0).normal[0] < 0)
    for (auto& facet : turned.facets) std::swap(facet[0], facet[1]);
  const BodyId lid = simulation.add_mesh_wall(turned, above);
  simulation.set_wall_mass(lid, 0.5);
  simulation.set_force(lid, -5 * up);
  simulation.set_velocity(floor, 0.1 * up);
  for (int step = 0; step < 400; ++step) simulation.step(5e-4);
  CHECK(simulation.pose(block).position.dot(up) == doctest::Approx(0.03).epsilon(0.001));
  CHECK(simulation.pose(lid).position.dot(up) == doctest::Approx(0.04).epsilon(0.001));
  // Force on the lid: 5 N; on the floor also the weight of the block.
  const double weight = 9.81 * simulation.bodies().grain_mass[block.index()];
  CHECK(simulation.contact_impulse(lid).dot(up) / 5e-4 == doctest::Approx(5).epsilon(1e-4));
  CHECK(simulation.contact_impulse(floor).dot(up) / 5e-4 ==
        doctest::Approx(-5 - weight).epsilon(1e-4));
}

TEST_CASE_TEMPLATE("a restart continues with the same bits", ShapeT, Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  const TemporaryFolder folder("mesh_wall");
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  const auto wave = [](const auto& x) { return 0.004 * std::sin(200 * x[0]); };
  auto simulation = world<ShapeT>(0.02);
  simulation.add_mesh_wall(floor_of(S{}, 0.2, 31, wave), {}, WallSides::both);
  const ShapeId shape = simulation.add_shape(grain<ShapeT>());
  for (int k = 0; k < 4; ++k)
    simulation.add_grain(shape, {(0.02 + 0.035 * k) * up, S::exp(S::Angular::Constant(0.3 * k))},
                         2700);
  for (int step = 0; step < 100; ++step) simulation.step(5e-4);
  write_snapshot(folder / "run.snapshot", simulation);
  auto again = world<ShapeT>(0.02);
  read_snapshot(folder / "run.snapshot", again);
  REQUIRE(again.mesh_walls().size() == 1);
  auto copy = simulation;
  for (int step = 0; step < 100; ++step) {
    simulation.step(5e-4);
    again.step(5e-4);
    copy.step(5e-4);
  }
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    CHECK(simulation.bodies().pose[i].position == again.bodies().pose[i].position);
    CHECK(simulation.bodies().velocity[i] == again.bodies().velocity[i]);
    CHECK(simulation.bodies().velocity[i] == copy.bodies().velocity[i]);
  }
}

TEST_CASE("bad mesh walls are refused, the simulation is unchanged") {
  auto simulation = world<Polyhedron<>>(0.02);
  FacetMesh<Volume> mesh = floor_of(Volume{}, 1, 2, flat);
  mesh.facets[3][1] = 100;
  CHECK_THROWS_WITH_AS(
      simulation.add_mesh_wall(mesh),
      "Simulation::add_mesh_wall: triangle 3 = (1, 100, 4) must have corners below 9, "
      "the number of vertices",
      std::invalid_argument);
  mesh = floor_of(Volume{}, 1, 2, flat);
  CHECK_THROWS_AS(simulation.add_mesh_wall(mesh, {}, WallSides::both, MaterialId(3)),
                  std::invalid_argument);
  CHECK(simulation.bodies().size() == 0);
  simulation.set_periodic(0, 0, 1);
  CHECK_THROWS_AS(simulation.add_mesh_wall(mesh), std::invalid_argument);
  auto other = world<Polyhedron<>>(0.02);
  other.add_mesh_wall(mesh);
  CHECK_THROWS_AS(other.set_periodic(0, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(other.set_wall_mass(other.mesh_walls()[0].body, -1), std::invalid_argument);
}

namespace {

using mesh_surfaces::profiles;
using mesh_surfaces::surface;
using mesh_surfaces::union_gap;

/// What grains do that are shot at a wall.
struct Shots {
  int count = 0, thrown = 0, driven = 0, through = 0;
};

/// Shoots a grain at a wall without gravity, at the speed of one margin per step.
template <class ShapeT>
void shoot(const MeshWall<SpaceOf<ShapeT>>& wall, const ShapeT& shape,
           const Pose<SpaceOf<ShapeT>>& pose, const typename SpaceOf<ShapeT>::Vector& velocity,
           const typename SpaceOf<ShapeT>::Angular& spin, double friction, Shots& shots) {
  const double h = 1e-3;
  if (union_gap(wall, Placed<ShapeT>(shape, pose), 0.02) < 1e-3) return;  // it starts in the wall
  auto simulation = World<ShapeT>(0.02, Materials<Law>(1, Law(friction)));
  simulation.add_mesh_wall(wall.mesh(), {}, wall.sides());
  const BodyId grain = simulation.add_grain(simulation.add_shape(shape), pose, 2700);
  simulation.set_velocity(grain, velocity);
  simulation.set_spin(grain, spin);
  const double start = kinetic_energy(simulation).total();
  double energy = start, farthest = 0, gain = 0, gap = 1;
  for (int step = 0; step < 150; ++step) {
    const auto before = simulation.pose(grain).position;
    simulation.step(h);
    farthest = std::max(farthest, (simulation.pose(grain).position - before).norm());
    const double now = kinetic_energy(simulation).total();
    gain = std::max(gain, now - energy);
    energy = now;
    if (step % 8 == 0)
      gap = std::min(gap, union_gap(wall, Placed<ShapeT>(shape, simulation.pose(grain)), 1e-3));
  }
  ++shots.count;
  shots.driven += gain > 1e-6 * start;
  shots.thrown +=
      farthest > h * std::sqrt(2 * start / simulation.bodies().grain_mass[grain.index()]) + 2e-4;
  shots.through += gap < -4e-4;
}

}  // namespace

TEST_CASE_TEMPLATE("grains shot at steps, ridges, valleys and rims are not thrown and pass nothing",
                   ShapeT, Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const auto shapes = mesh_surfaces::grains<ShapeT>();
  std::mt19937_64 random(17);
  for (const auto& named : profiles()) {
    // From behind, grains pass a wall with one side.
    const MeshWall<S> wall(surface(S{}, named.profile), WallSides::both);
    Shots shots;
    for (int t = 0; t < 30; ++t) {
      const auto [point, up] = mesh_surfaces::above_facet(wall, t, random);
      const auto turn = t % 2 != 0 ? random_rotation<S>(random) : S::identity();
      const Vector at = point + 0.04 * up;
      shoot(wall, shapes[std::size_t(t) % shapes.size()],
            Pose<S>(at + 0.01 * conformance::random_direction<S>(random), turn), Vector(-0.4 * up),
            typename S::Angular(S::Angular::Constant(t % 3 == 0 ? 5 : 0)), t % 5 == 0 ? 0.3 : 0.0,
            shots);
    }
    CAPTURE(named.name);
    CHECK(shots.count > 0);
    CHECK(shots.thrown == 0);
    CHECK(shots.driven == 0);
    CHECK(shots.through == 0);
  }
}

// The step overlaps a turned cube by less than a micrometre: no contact is as deep as the step is high.
// A step that reaches above the centre of the cube holds it as a half-space does; one below the centre makes it tip by
// some um. A prescribed block of the same shape finds its contact points in another way.
TEST_CASE("a cube that hits a step moves as against a block of its shape") {
  using S = Volume;
  for (const double height : {8.0, 19.0})
    for (const double turn : {0.0, 0.05, 0.1, 0.2, 0.3, 1.0}) {
      std::array<S::Vector, 2> end;
      std::array<double, 2> highest{};
      for (const std::size_t k : {0u, 1u}) {
        auto simulation = world<Polyhedron<>>(0.02, 0);
        if (k == 0) {
          simulation.add_mesh_wall(surface(S{}, {{60, 0}, {0, 0}, {0, height}, {-60, height}}));
        } else {
          simulation.add_wall(S::Vector::UnitZ(), S::Vector::Zero());
          const auto block = cuboid<Polyhedron<>>({0.03, 0.06, height / 2000});
          simulation.prescribe_motion(simulation.add_grain(
              simulation.add_shape(block), {{-0.03, 0, height / 2000}, S::identity()}, 1000));
        }
        simulation.set_gravity({-3, 0, -9.81});
        const BodyId cube =
            simulation.add_grain(simulation.add_shape(cuboid<Polyhedron<>>({0.01, 0.01, 0.01})),
                                 {{0.016, 0.003, 0.01}, S::exp({0, 0, turn})}, 2700);
        for (int step = 0; step < 1600; ++step) {
          simulation.step(2e-4);
          highest[k] = std::max(highest[k], simulation.pose(cube).position[2]);
        }
        end[k] = simulation.pose(cube).position;
      }
      CAPTURE(height);
      CAPTURE(turn);
      CHECK(std::abs(highest[0] - highest[1]) < 3e-6);
      if (height > 10) CHECK(highest[0] < 0.010001);
      CHECK((end[0] - end[1]).norm() < 1e-4);
    }
}

TEST_CASE("hulls that rain into a basin with a wavy floor stay in it") {
  using S = Volume;
  auto simulation = world<Polyhedron<>>(0.02);
  simulation.add_mesh_wall(floor_of(S{}, 0.3, 60, [](const auto& x) {
    const double k = 2 * std::numbers::pi / 0.05;
    return 0.006 * std::sin(k * x[0]) * std::cos(k * x[1]) + 0.4 * (x[0] * x[0] + x[1] * x[1]);
  }));
  std::vector<ShapeId> shapes;
  for (const auto& shape : mesh_surfaces::grains<Polyhedron<>>())
    shapes.push_back(simulation.add_shape(shape));
  std::mt19937_64 random(3);
  for (int k = 0; k < 4; ++k)
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j)
        simulation.add_grain(shapes[random() % shapes.size()],
                             {{0.04 * i, 0.04 * j, 0.06 + 0.04 * k}, random_rotation<S>(random)},
                             2700);
  for (int step = 0; step < 600; ++step) simulation.step(1e-3);
  int lost = 0;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const S::Vector at = simulation.pose(simulation.grain(k)).position;
    lost += !(at[2] > -0.006 && at.head<2>().norm() < 0.25 && at[2] < 0.3);
  }
  CHECK(lost == 0);
}
