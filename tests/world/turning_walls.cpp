// SPDX-License-Identifier: MIT
// Turning walls carry a grain on its circle; a grain that slides along a cylinder keeps its speed.
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <vector>

#include "moreau/measure/energy_balance.hpp"

#include "rotation_between.hpp"
#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::World;

namespace {

using Plane = Space<2>;
using Volume = Space<3>;
constexpr double turn = 2 * std::numbers::pi;
template <class ShapeT>
Materials<scenes::LawOf<ShapeT>> friction(double mu, double restitution = 0) {
  using Law = scenes::LawOf<ShapeT>;
  return Materials<Law>(1, Law(mu, restitution));
}

/// A square floor of two triangles in the plane z = 0, outside above.
FacetMesh<Volume> square_floor(double half) {
  FacetMesh<Volume> mesh;
  mesh.vertices = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.facets = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

enum class Table { half_space, mesh, block };

/// How far a grain at rest on a table that turns about its normal moves on the table in some turns, and
/// the work of friction on it relative to its kinetic energy.
struct Drift {
  double along = 0, across = 0, height = 0, friction = 0, imbalance = 0;
};
template <class ShapeT>
Drift drift_on(Table kind, const Volume::Vector& normal, double spin, double h, double turns,
               double theta = 0.5) {
  World<ShapeT> world(0.02, friction<ShapeT>(1.0));
  world.set_integrator(MoreauJean(theta));
  const Pose<Volume> frame{{0.01, 0.02, 0.03}, rotation_between(Eigen::Vector3d::UnitZ(), normal)};
  const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
  BodyId table;
  if (kind == Table::half_space) table = world.add_wall(normal, frame.position);
  if constexpr (MeshCollidable<ShapeT>)
    if (kind == Table::mesh) table = world.add_mesh_wall(square_floor(0.4), frame);
  if constexpr (Polytope<ShapeT>)
    if (kind == Table::block) {
      const ShapeId block = world.add_shape(cuboid<ShapeT>({0.4, 0.4, 0.05}));
      const Pose<Volume> below{frame(Eigen::Vector3d(0, 0, -0.05)), frame.rotation};
      table = world.add_grain(block, below, 1000);
      world.prescribe_motion(table);
    }
  const Volume::Vector arm{0.3, 0, 0.01};
  const BodyId grain = world.add_grain(shape, {frame(arm), frame.rotation}, 1000);
  world.set_gravity(-9.81 * normal);
  world.set_spin(table, spin * normal);
  world.set_spin(grain, spin * normal);
  world.set_velocity(grain, Volume::spin(spin * normal, frame.rotation * arm));
  EnergyBalance<Volume> energy(world);
  const double start = energy.kinetic();
  const int steps = int(turns * turn / std::abs(spin) / h);
  int unsolved = 0;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = world.step(h);
    unsolved += !report.solve.converged;
    energy.add(world, report, h);
  }
  CHECK(unsolved <= 2);  // the first steps, from the tangent to the chord
  const Volume::Vector local = frame.to_body(world.pose(grain).position);
  const Volume::Vector there =
      Volume::exp(Volume::Vector(0, 0, spin * h * steps)) * Volume::Vector(arm);
  return {local.head<2>().norm() - 0.3, (local - there).norm(), local[2] - 0.01,
          energy.terms().friction / start, energy.imbalance() / start};
}

/// The kinetic energy after some turns inside of a cylinder without friction and gravity, relative to
/// that at the start.
template <class ShapeT>
double kept_energy(
    const ShapeT& shape, double radius, double h, double v, double restitution, double spin,
    double turns, const typename SpaceOf<ShapeT>::Vector& drift = SpaceOf<ShapeT>::Vector::Zero()) {
  using S = SpaceOf<ShapeT>;
  World<ShapeT> world(0.02, friction<ShapeT>(0, restitution));
  typename S::Angular axis = S::Angular::Zero();
  axis[S::angular_dim - 1] = 1;
  const BodyId wall = world.add_cylinder(S::Vector::Zero(), axis, radius);
  world.set_spin(wall, spin * axis);
  world.set_velocity(wall, drift);
  // The radius of the path of the centre.
  const double path = Polytope<ShapeT> ? std::sqrt(radius * radius - 1e-4) - 0.01 : radius - 0.01;
  const BodyId grain =
      world.add_grain(world.add_shape(shape), {path * S::Vector::UnitX(), S::identity()}, 1000);
  world.set_velocity(grain, v * S::Vector::UnitY() + drift);
  if constexpr (Polytope<ShapeT>) world.set_spin(grain, v / path * axis);
  const auto kinetic = [&] {
    const auto i = grain.index();
    const typename S::Vector u = world.velocity(grain) - drift;
    const typename S::Angular w = world.spin(grain);
    return (world.bodies().grain_mass[i] * u.squaredNorm() +
            w.dot(world.bodies().inertia(i, world.pose(grain).rotation) * w)) /
           2;
  };
  const double start = kinetic();
  double most = 0, deepest = 0;
  for (int k = 0; k < int(turns * turn * path / std::abs(v) / h); ++k) {
    deepest = std::max(deepest, world.step(h).max_overlap);
    most = std::max(most, kinetic());
  }
  const double angle = h * std::abs(v) / path;
  CHECK(most < start * (1 + 2 * angle * angle));
  CHECK(deepest < 5e-6 + angle * angle * path);
  return kinetic() / start;
}

}  // namespace

TEST_CASE("a turning table carries a grain on its circle") {
  using ShapeT = Polyhedron<>;
  const Volume::Vector z = Volume::Vector::UnitZ();
  const Volume::Vector tilted = Volume::Vector(0.3, -0.5, 0.7).normalized();
  for (const Table kind : {Table::half_space, Table::mesh, Table::block})
    for (const double spin : {5.0, -3.0})
      for (const Volume::Vector& normal : {z, tilted, Volume::Vector(-z)}) {
        const double h = 1e-3, turns = rounds(8) / 4.0;
        CAPTURE(int(kind));
        CAPTURE(spin);
        CAPTURE(normal.transpose());
        const Drift drift = drift_on<ShapeT>(kind, normal, spin, h, turns);
        // Without chords it were 0.3 pi |spin| h turns: 9.4e-3 m.
        // A shift of this size in the first steps stays; it does not grow.
        CHECK(std::abs(drift.along) < 4e-6);
        CHECK(drift.across < 2e-5);
        CHECK(std::abs(drift.height) < 1e-5);
        CHECK(std::abs(drift.friction) < 4e-6);
        CHECK(std::abs(drift.imbalance) < 1e-9);
      }
}

TEST_CASE("the circle holds for many turns, for short and long steps, for every theta") {
  const Volume::Vector z = Volume::Vector::UnitZ();
  struct Case {
    double h, turns, theta, bound;
  };
  for (const Case& at : {Case{1e-3, rounds(20) * 1.0, 0.5, 4e-6}, Case{1e-4, 1, 0.5, 4e-6},
                         Case{1.0 / 60, rounds(20) * 1.0, 0.5, 5e-3}, Case{1e-3, 2, 1, 4e-6},
                         Case{1e-3, 2, 0.7, 4e-6}}) {
    CAPTURE(at.h);
    CAPTURE(at.theta);
    CHECK(
        std::abs(drift_on<Polyhedron<>>(Table::half_space, z, 5, at.h, at.turns, at.theta).along) <
        at.bound);
  }
}

TEST_CASE_TEMPLATE("a tilting table carries a grain", ShapeT, Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  constexpr int up = S::dim - 1;
  for (const double spin : {2.0, -2.0}) {
    World<ShapeT> world(0.02, friction<ShapeT>(1.0));
    const BodyId table = world.add_wall(S::Vector::Unit(up), S::Vector::Zero());
    typename S::Vector arm = 0.2 * S::Vector::UnitX();
    arm[up] = 0.01;
    const BodyId grain =
        world.add_grain(world.add_shape(regular_shape<ShapeT>(0.02)), {arm, S::identity()}, 1000);
    typename S::Angular axis = S::Angular::Zero();
    axis[S::angular_dim / 2] = spin;
    world.set_spin(table, axis);
    world.set_spin(grain, axis);
    world.set_velocity(grain, S::spin(axis, arm));
    const double h = 1e-3;
    for (int k = 0; k < 200; ++k) {
      // Gravity turns with the table: 0.4 rad in all.
      const typename S::Rotation turned = S::exp(axis * (h * k));
      world.set_gravity(-9.81 * (turned * S::Vector::Unit(up)));
      world.step(h);
    }
    const typename S::Vector local = S::exp(axis * (-200 * h)) * world.pose(grain).position;
    CAPTURE(S::dim);
    CAPTURE(spin);
    CAPTURE(local.transpose());
    CHECK((local - arm).norm() < 1e-5);  // without chords 200 (h spin)^2 / 2 x 0.2 m = 8e-5 m
  }
}

TEST_CASE("grains at rest in a turning drum stay there") {
  // Gravity is off, the centrifugal force presses.
  for (const double spin : {6.0, -6.0})
    for (const double h : {1e-3, 2e-4}) {
      World<Polygon<>> world(0.02, friction<Polygon<>>(0.8));
      const BodyId drum = world.add_cylinder({0, 0}, {1}, 0.1);
      const ShapeId shape = world.add_shape(regular_shape<Polygon<>>(0.02));
      const double path = std::sqrt(0.01 - 1e-4) - 0.01;
      const BodyId grain = world.add_grain(shape, {{path, 0}, Plane::identity()}, 1000);
      world.set_spin(drum, {spin});
      world.set_spin(grain, {spin});
      world.set_velocity(grain, {0, spin * path});
      EnergyBalance<Plane> energy(world);
      const int steps = int(2 * turn / std::abs(spin) / h);
      for (int k = 0; k < steps; ++k) energy.add(world, world.step(h), h);
      const Plane::Vector there =
          Plane::exp(Plane::Angular::Constant(spin * h * steps)) * Plane::Vector(path, 0);
      CHECK((world.pose(grain).position - there).norm() < 1e-4);
      CHECK(std::abs(world.pose(grain).position.norm() - path) < 1e-5);
      CHECK(energy.kinetic() == doctest::Approx(energy.kinetic_at_start()).epsilon(1e-4));
      CHECK(std::abs(energy.imbalance()) < 1e-10 * energy.kinetic());
    }
}

TEST_CASE("a round grain that slides along a cylinder keeps its speed") {
  for (const double h : {1e-3, 2e-4})
    for (const double v : {1.0, -1.0, 0.3})
      for (const double restitution : {0.0, 0.5, 1.0}) {
        CAPTURE(h);
        CAPTURE(v);
        CAPTURE(restitution);
        CHECK(std::abs(kept_energy(Disk<>(0.01), 0.1, h, v, restitution, 0, 2) - 1) < 1e-9);
        if (restitution != 0.5)
          CHECK(std::abs(kept_energy(Ball<>(0.01), 0.1, h, v, restitution, 7, 1) - 1) < 1e-9);
      }
  // In a cylinder that moves.
  CHECK(std::abs(kept_energy(Disk<>(0.01), 0.1, 1e-3, 1, 0, -3, 5, {0.4, 0.2}) - 1) < 1e-9);
  CHECK(std::abs(kept_energy(Disk<>(0.01), 0.012, 1e-4, 1, 0, 0, 5) - 1) < 1e-9);
}

TEST_CASE("a polytope that slides along a cylinder loses speed with the square of the step") {
  for (const double spin : {0.0, 5.0})
    for (const double v : {1.0, -1.0}) {
      CAPTURE(spin);
      CAPTURE(v);
      // Without chords it were some 0.3 per turn at the longer step.
      const auto square = regular_shape<Polygon<>>(0.02);
      CHECK(std::abs(kept_energy(square, 0.1, 1e-3, v, 0, spin, 2) - 1) < 4e-4);
      CHECK(std::abs(kept_energy(square, 0.1, 2e-4, v, 0, spin, 2) - 1) < 2e-5);
      const auto cube = regular_shape<Polyhedron<>>(0.02);
      CHECK(std::abs(kept_energy(cube, 0.1, 1e-3, v, 0, spin, 1) - 1) < 2e-4);
    }
}

TEST_CASE_TEMPLATE("balls that turn on the spot carry a ball and let nothing sink", ShapeT, Disk<>,
                   Ball<>) {
  using S = SpaceOf<ShapeT>;
  constexpr int count = S::dim;  // supports under the ball
  for (const double h : {5e-3, 1e-3})
    for (const double spin : {10.0, -50.0}) {
      CAPTURE(h);
      CAPTURE(spin);
      World<ShapeT> world(0.2, friction<ShapeT>(0));
      world.set_gravity(-9.81 * S::Vector::Unit(S::dim - 1));
      const ShapeId shape = world.add_shape(ShapeT(0.1));
      for (int k = 0; k < count; ++k) {
        typename S::Vector center = S::Vector::Zero();
        const double angle = turn * k / count;
        for (int axis = 0; axis + 1 < S::dim; ++axis)
          center[axis] = 0.12 * (axis == 0 ? std::cos(angle) : std::sin(angle));
        const BodyId support = world.add_grain(shape, {center, S::identity()}, 1000);
        world.prescribe_motion(support);
        typename S::Angular axis = S::Angular::Ones();
        for (int i = 0; i < S::angular_dim; ++i) axis[i] = spin * (i == k ? 0.5 : 1.0);
        world.set_spin(support, axis);
      }
      const double height = std::sqrt(0.04 - 0.0144);
      const BodyId ball =
          world.add_grain(shape, {height * S::Vector::Unit(S::dim - 1), S::identity()}, 1000);
      for (int k = 0; k < int(0.2 / h); ++k) CHECK(world.step(h).solve.converged);
      const typename S::Vector moved =
          world.pose(ball).position - height * S::Vector::Unit(S::dim - 1);
      CHECK(moved.norm() < 1e-9);
    }
}

// A ball that rolls on a turntable runs on a circle, with 2/7 of the turntable's rate (J. A. Burns, Am. J. Phys. 49
// (1981) 56); one that rolls round in a vertical tube goes down and up like a spring, with sqrt(2/7) of its rate
// around the tube (M. Gualtieri et al., Am. J. Phys. 74 (2006) 497).
TEST_CASE("a ball that rolls on a turntable runs on its circle, to second order") {
  const double rate = 5, radius = 0.05, around = 2 * rate / 7;
  const Volume::Vector up = Volume::Vector::UnitZ(), start(0.4, 0.1, radius), velocity(0.1, 0.3, 0);
  for (const double h : {4e-3, 1e-3}) {
    CAPTURE(h);
    World<Ball<>> world(0.1, friction<Ball<>>(0.8));
    const BodyId table = world.add_wall(up, Volume::Vector::Zero());
    world.set_spin(table, rate * up);
    world.set_gravity(-9.81 * up);
    const BodyId ball =
        world.add_grain(world.add_shape(Ball<>(radius)), {start, Volume::identity()}, 1000);
    world.set_velocity(ball, velocity);
    world.set_spin(ball, up.cross(velocity - rate * up.cross(start)) / radius);
    const Volume::Vector center = start + up.cross(velocity) / around, arm = start - center;
    double off = 0;
    for (int k = 1; k <= int(turn / around / h); ++k) {
      world.step(h);
      const double angle = around * h * k;
      const Volume::Vector place = center + std::cos(angle) * arm + std::sin(angle) * up.cross(arm);
      off = std::max(off, (world.pose(ball).position - place).norm());
    }
    CHECK(off < 1.5 * std::pow(rate * h, 2) * arm.norm());
  }
}

// A ball that spins about the common normal at the rate s rolls round the top of a fixed ball at a constant lean a, with
// the rate p at which 7/5 d p^2 cos a - 2/5 r s p + g = 0; d is the distance of the centres.
TEST_CASE("a spinning ball that rolls round on a ball at rest keeps its lean, to second order") {
  const double obstacle = 0.1, radius = 0.02, lean = 0.3, spin = 400, gravity = 9.81;
  const double apart = obstacle + radius, a = 1.4 * apart * std::cos(lean), b = 0.4 * radius * spin;
  const double rate = (b - std::sqrt(b * b - 4 * a * gravity)) / (2 * a);
  const Volume::Vector up = Volume::Vector::UnitZ();
  const Volume::Vector normal(0, std::sin(lean), std::cos(lean)), start = apart * normal;
  for (const double h : {2e-3, 5e-4}) {
    CAPTURE(h);
    World<Ball<>> world(0.04, friction<Ball<>>(1));
    world.prescribe_motion(
        world.add_grain(world.add_shape(Ball<>(obstacle)), Pose<Volume>(), 1000));
    const BodyId ball =
        world.add_grain(world.add_shape(Ball<>(radius)), {start, Volume::identity()}, 1000);
    world.set_gravity(-gravity * up);
    const Volume::Vector velocity = rate * up.cross(start);
    world.set_velocity(ball, velocity);
    world.set_spin(ball, spin * normal + normal.cross(velocity) / radius);
    double off = 0;
    for (int k = 1; k <= int(turn / rate / h); ++k) {
      world.step(h);
      const Volume::Vector x = world.pose(ball).position;
      off = std::max(off, std::abs(std::acos(x[2] / x.norm()) - lean));
    }
    const double gyration = 0.4 * radius * spin / (1.4 * apart);  // of the nutation
    CHECK(off < std::pow(gyration * h, 2));
    const Volume::Vector end = world.pose(ball).position.normalized();
    CHECK(std::abs(world.spin(ball).dot(end) / spin - 1) < 1e-5);
  }
}

TEST_CASE("a ball that rolls round in a tube goes down and up and keeps its energy") {
  const double tube = 1, radius = 0.1, rate = 5, gravity = 9.81, path = tube - radius;
  const double swing = rate * std::sqrt(2.0 / 7), drop = 10.0 / 7 * gravity / (swing * swing);
  for (const double h : {2e-3, 5e-4}) {
    CAPTURE(h);
    World<Ball<>> world(0.2, friction<Ball<>>(3));
    world.add_cylinder(Volume::Vector::Zero(), Volume::Vector::UnitZ(), tube);
    world.set_gravity({0, 0, -gravity});
    const BodyId ball = world.add_grain(world.add_shape(Ball<>(radius)),
                                        {path * Volume::Vector::UnitX(), Volume::identity()}, 1000);
    world.set_velocity(ball, {0, path * rate, 0});
    world.set_spin(ball, {0, 0, -path * rate / radius});
    double off = 0;
    for (int k = 1; k <= int(2 * turn / swing / h); ++k) {
      world.step(h);
      const double height = -drop / 2 * (1 - std::cos(swing * h * k));
      off = std::max(off, std::abs(world.pose(ball).position[2] - height));
    }
    CHECK(off < 3 * std::pow(rate * h, 2) * drop);
    CHECK(std::abs(world.velocity(ball).norm() / (path * rate) - 1) < 0.3 * std::pow(rate * h, 2));
  }
}

TEST_CASE_TEMPLATE("a spin that turns a wall across a periodic axis is refused", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (BallIn<Space<3, float>>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  using Law = SignoriniCoulomb<T>;
  constexpr const char* text = "must be about the only periodic axis";
  const auto build = [] {
    Simulation<ShapeT, Law> world(T(0.02), Law(T(0.5)));
    world.add_grain(world.add_shape(ShapeT(T(0.01))), Pose<S>(Vector(Vector::Zero())), T(2700));
    return world;
  };
  auto world = build();
  const Vector up = Vector::Unit(S::dim - 1);
  const BodyId floor = world.add_wall(up, Vector(T(-0.01) * up));
  const auto about = [](int axis) {
    Angular spin = Angular::Zero();
    spin[S::dim == 2 ? 0 : axis] = T(0.3);
    return spin;
  };
  world.set_spin(floor, about(1));
  CHECK_THROWS_WITH_AS(world.set_periodic(0, 0, 1), doctest::Contains(text), std::invalid_argument);
  CHECK(world.cell().is_open());
  world.set_spin(floor, Angular::Zero());
  world.set_periodic(0, 0, 1);
  CHECK_THROWS_WITH_AS(world.set_spin(floor, about(1)),
                       doctest::Contains("Simulation::set_spin: spin = "), std::invalid_argument);
  CHECK(world.spin(floor) == Angular(Angular::Zero()));
  world.set_spin(world.grain(0), about(1));
  world.set_spin(floor, Angular::Zero());
  if constexpr (S::dim == 3) {
    const Angular both = about(0) + about(2);
    CHECK_THROWS_AS(world.set_spin(floor, both), std::invalid_argument);
    world.set_spin(floor, about(0));  // the periodic axis: the floor stays along it
    for (int k = 0; k < 100; ++k) world.step(T(1e-2));
    CHECK(std::abs((world.pose(floor).rotation * Vector::UnitX())[0]) < T(1e-5));
    CHECK_THROWS_AS(world.set_periodic(1, -1, 1), std::invalid_argument);
    auto turned = build();
    turned.set_periodic(0, 0, 1);
    const BodyId table = turned.add_wall(up, Vector(T(-0.01) * up));
    // About its normal: a point at x and its image at x + 1 would have different velocities.
    CHECK_THROWS_WITH_AS(turned.set_spin(table, about(2)), doctest::Contains(text),
                         std::invalid_argument);
    turned.set_spin(table, about(0));
    CHECK_THROWS_WITH_AS(turned.set_periodic(1, 0, 1), doctest::Contains(text),
                         std::invalid_argument);
    turned.set_spin(table, Angular::Zero());
    turned.set_periodic(1, 0, 1);
    CHECK_THROWS_AS(turned.set_spin(table, about(0)), std::invalid_argument);
    CHECK_THROWS_AS(turned.set_spin(table, about(2)), std::invalid_argument);
    auto drum = build();
    drum.set_periodic(0, 0, 1);
    const BodyId cylinder = drum.add_cylinder(Vector::Zero(), Vector::UnitX(), T(0.1));
    drum.set_spin(cylinder, about(0));
    CHECK_THROWS_WITH_AS(drum.set_spin(cylinder, about(2)), doctest::Contains(text),
                         std::invalid_argument);
  }
}
