// SPDX-License-Identifier: MIT
// Compliant contacts against closed forms: compressed columns, a block on a slope, impacts, restart.
#include "moreau/law/compliant.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <vector>

#include "moreau/contact/warm_start.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

using Coulomb = SignoriniCoulomb<double>;
using Spring = Compliant<Coulomb>;
constexpr double radius = 0.01, gravity = 9.81, step = 2e-4;
/// Grains of the plane weigh about what those of space weigh.
template <class S>
constexpr double density = S::dim == 3 ? 2700 : 36;

ColouredGaussSeidel tight() {
  ColouredOptions options;
  options.tolerance = 1e-12;
  return ColouredGaussSeidel(options);
}

/// A column of equal balls or disks on a floor.
template <class S>
struct Column {
  using Shape = BallIn<S>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  Simulation<Shape, Spring> world;
  BodyId floor, lid;
  double mass;

  Column(std::size_t count, const Spring& law)
      : world(2 * radius, Materials<Spring>(1, law), tight()) {
    const ShapeId shape = world.add_shape(Shape(radius));
    for (std::size_t k = 0; k < count; ++k) {
      Pose<S> pose;
      pose.position[up] = radius * double(2 * k + 1);
      world.add_grain(shape, pose, density<S>);
    }
    mass = Shape(radius).mass_properties(density<S>).mass;
    floor = world.add_wall(Vector(Vector::Unit(up)), Vector(Vector::Zero()));
    lid = world.add_wall(Vector(-Vector::Unit(up)),
                         Vector(2 * radius * double(count) * Vector::Unit(up)));
    world.set_wall_mass(lid, mass);
  }
  double height(std::size_t k) const { return world.bodies().pose[k].position[up]; }
  double lid_height() const { return world.pose(lid).position[up]; }
  StepReport run(int steps) {
    StepReport report;
    for (int k = 0; k < steps; ++k) report = world.step(step);
    return report;
  }
};

}  // namespace

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("compliant: a simulation as the guide makes it") {
  using Shape = Ball<double>;
  using Law = Compliant<SignoriniCoulomb<double>>;
  const Law law(SignoriniCoulomb<double>(0.4), 1e8);  // friction [-], stiffness k [N/m]
  ColouredOptions options;
  options.tolerance = 1e-5;
  options.cold_sweeps = 2000;  // a second attempt, from zero impulses, where the first is capped
  Simulation<Shape, Law> simulation(0.02, Materials<Law>(1, law), ColouredGaussSeidel(options));
  CHECK(simulation.materials().laws()[0].stiffness() == 1e8);
}
#endif

TEST_CASE("compliant: stiffness must be positive") {
  CHECK_THROWS_AS(Spring(Coulomb(0.4), 0), std::invalid_argument);
  CHECK_THROWS_AS(Spring(Coulomb(0.4), -1), std::invalid_argument);
  CHECK_THROWS_AS(Spring(Coulomb(0.4), 1e8, INFINITY), std::invalid_argument);
  CHECK(Spring(Coulomb(0.4), 1e7).tangential_stiffness() == 1e7);
}

TEST_CASE("compliant: overlaps are not taken back") {
  using World = Simulation<Disk<double>, Spring>;
  World world(2 * radius, Materials<Spring>(1, Spring(Coulomb(0.4), 1e8)));
  OverlapCorrectionOptions on;
  CHECK_THROWS_AS(world.set_correction(on), std::invalid_argument);
  on.enabled = false;
  CHECK_NOTHROW(world.set_correction(on));
}

TEST_CASE_TEMPLATE("compliant: a column at rest is compressed by its weight", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  constexpr std::size_t count = 6;
  for (const double stiffness : {1e6, 1e8}) {
    Column<S> column(count, Spring(Coulomb(0.4), stiffness));
    column.world.set_gravity(typename S::Vector(-gravity * S::Vector::Unit(S::dim - 1)));
    column.world.set_pose(column.lid, [&] {
      Pose<S> pose = column.world.pose(column.lid);
      pose.position[S::dim - 1] += 1;
      return pose;
    }());
    column.run(2000);
    double compression = 0;
    for (std::size_t k = 0; k < count; ++k) {
      compression += double(count - k) * column.mass * gravity / stiffness;
      CHECK(column.height(k) - radius * double(2 * k + 1) ==
            doctest::Approx(-compression).epsilon(1e-6));
    }
  }
}

TEST_CASE_TEMPLATE("compliant: a column springs back by the force over its stiffness", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  constexpr std::size_t count = 5;
  constexpr double stiffness = 1e7, force = 100;
  Column<S> column(count, Spring(Coulomb(0.4), stiffness));
  const auto press = [&](double f) {
    column.world.set_force(column.lid, typename S::Vector(-f * S::Vector::Unit(S::dim - 1)));
    return column.run(40);  // soon enough: under load a column of disks buckles
  };
  const double start = column.lid_height();
  const StepReport pressed = press(force);
  const double low = column.lid_height();
  // count + 1 contacts in series.
  CHECK(start - low == doctest::Approx((count + 1) * force / stiffness).epsilon(1e-6));
  CHECK(pressed.max_elastic_overlap == doctest::Approx(force / stiffness).epsilon(1e-6));
  CHECK(pressed.elastic_energy ==
        doctest::Approx((count + 1) * force * force / (2 * stiffness)).epsilon(1e-6));
  CHECK(pressed.rigid_residual < 1e-6);
  press(force / 4);
  CHECK(column.lid_height() - low ==
        doctest::Approx(0.75 * (count + 1) * force / stiffness).epsilon(1e-6));
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("compliant: a block on a slope moves by its load over the tangential stiffness") {
  using Shape = Polygon<double>;
  using Vector = Eigen::Vector2d;
  constexpr double half = 0.01, slope = 0.3, stiffness = 1e6;
  const std::vector<Vector> corners{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  Simulation<Shape, Spring> world(2 * half, Materials<Spring>(1, Spring(Coulomb(0.5), stiffness)),
                                  tight());
  Pose<Space<2>> pose;
  pose.position = {0, half};
  const BodyId block = world.add_grain(world.add_shape(Shape(corners)), pose, density<Space<2>>);
  world.add_wall(Vector(0, 1), Vector(0, 0));
  world.set_gravity(Vector(gravity * std::sin(slope), -gravity * std::cos(slope)));
  for (int k = 0; k < 4000; ++k) world.step(step);
  const double weight = density<Space<2>> * 4 * half * half * gravity;
  const Vector moved = world.pose(block).position - Vector(0, half);
  // The two points share the stiffness of the pair. The block also tilts: its centre is above the
  // plane of the springs, which adds to what its centre moves along the slope.
  const double tilt = weight * std::sin(slope) * half / (stiffness * half * half);
  CHECK(moved[1] == doctest::Approx(-weight * std::cos(slope) / stiffness).epsilon(1e-3));
  CHECK(moved[0] ==
        doctest::Approx(weight * std::sin(slope) / stiffness + tilt * half).epsilon(1e-3));
  CHECK(world.bodies().velocity[block.index()].norm() < 1e-9);
}

TEST_CASE_TEMPLATE("compliant: springs follow what the bodies move, also if the step changes",
                   Shape, Polygon<double>, Polyhedron<double>) {
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double half = 0.05, slope = 0.2, stiffness = 1e6, mass = 10;
  for (const int pattern : {0, 1, 2}) {
    CAPTURE(S::dim);
    CAPTURE(pattern);
    const auto length = [&](int k) {
      if (pattern == 0) return 1e-3;
      if (pattern == 1) return k % 2 ? 1e-3 : 1e-4;
      return k % 97 == 0 ? 1e-2 : 3e-4;
    };
    Simulation<Shape, Spring> world(
        2 * half, Materials<Spring>(1, Spring(Coulomb(5), stiffness, stiffness / 2)));
    Pose<S> pose;
    pose.position[up] = half;
    const BodyId block = world.add_grain(world.add_shape(cuboid<Shape>(Vector::Constant(half))),
                                         pose, mass / std::pow(2 * half, S::dim));
    world.add_wall(Vector(Vector::Unit(up)), Vector(Vector::Zero()));
    world.set_gravity(Vector(gravity * std::sin(slope) * Vector::UnitX() -
                             gravity * std::cos(slope) * Vector::Unit(up)));
    double dissipation = 0;
    for (int k = 0; k < 9000; ++k) dissipation += world.step(length(k)).dissipation;
    const double along = mass * gravity * std::sin(slope), down = mass * gravity * std::cos(slope);
    const double tilt = along * half / (stiffness * half * half);
    const Vector moved = world.pose(block).position - half * Vector::Unit(up);
    const double expected = along / (stiffness / 2) + tilt * half;
    CHECK(moved[0] == doctest::Approx(expected).epsilon(2e-3));
    CHECK(moved[up] == doctest::Approx(-down / stiffness).epsilon(2e-3));
    // The load falls by what the springs give way; half of its work is elastic energy at the end.
    const double work = along * moved[0] - down * moved[up];
    CHECK(dissipation == doctest::Approx(work / 2).epsilon(1e-2));
  }
}

// On its tangential springs a flat block swings with the frequency omega. Rare long steps between short ones, which hardly damp,
// make no energy.
TEST_CASE_TEMPLATE("compliant: a change of the step makes no energy in the springs", Shape,
                   Polygon<double>, Polyhedron<double>) {
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double mass = 10, stiffness = 1e6, low = 1e4, speed = 1e-3;
  Vector half = Vector::Constant(0.5);
  half[up] = 0.01;
  const double omega = std::sqrt(stiffness / mass);
  for (const double turn : {1.0, 4.0, 16.0}) {
    CAPTURE(S::dim);
    CAPTURE(turn);
    Simulation<Shape, Spring> world(0.1,
                                    Materials<Spring>(1, Spring(Coulomb(100), low, stiffness)));
    Pose<S> pose;
    pose.position[up] = half[up] - mass / low;
    const BodyId block = world.add_grain(world.add_shape(cuboid<Shape>(half)), pose,
                                         mass / (std::pow(2., S::dim) * half.prod()));
    world.add_wall(Vector(Vector::Unit(up)), Vector(Vector::Zero()));
    world.set_gravity(Vector(-Vector::Unit(up)));
    for (int k = 0; k < 500; ++k) world.step(1e-2);
    const double x = world.pose(block).position[0];
    world.set_velocity(block, Vector(speed * Vector::UnitX()));
    double fastest = 0;
    for (int cycle = 0; cycle < (turn > 1 ? 60 : 300); ++cycle)
      for (int k = 0; k <= 20; ++k) {
        world.step((k == 20 ? turn * (1 + 0.07 * (cycle * 37 % 11) / 11) : 0.05) / omega);
        fastest = std::max(fastest, world.velocity(block).norm());
      }
    CHECK(fastest <= speed);
    CHECK(world.velocity(block).norm() < 0.1 * speed);
    if (turn <= 1) CHECK(std::abs(world.pose(block).position[0] - x) < 0.01 * speed / omega);
  }
}
#endif

TEST_CASE_TEMPLATE("compliant: an impact keeps the restitution up to eps", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  constexpr double speed = 1;
  for (const double restitution : {0., 0.5, 1.}) {
    constexpr double stiffness = 1e8;
    Simulation<BallIn<S>, Spring> world(
        2 * radius, Materials<Spring>(1, Spring(Coulomb(0.4, restitution), stiffness)), tight());
    Pose<S> pose;
    pose.position[S::dim - 1] = radius + 1e-3;
    const BodyId ball = world.add_grain(world.add_shape(BallIn<S>(radius)), pose, density<S>);
    world.add_wall(typename S::Vector(S::Vector::Unit(S::dim - 1)),
                   typename S::Vector(S::Vector::Zero()));
    world.set_velocity(ball, typename S::Vector(-speed * S::Vector::Unit(S::dim - 1)));
    for (int k = 0; k < 50; ++k) world.step(step);
    const double mass = BallIn<S>(radius).mass_properties(density<S>).mass;
    const double eps = mass / (stiffness * step * step);
    const double after = world.velocity(ball)[S::dim - 1] / speed;
    CHECK(std::abs(after - restitution) <= 3 * eps);
  }
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("compliant: a loaded cube on a floor comes to rest") {
  constexpr double half = 0.01, stiffness = 1e7, force = 500, mass = 2700 * 8 * half * half * half;
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {-half, half})
    for (const double y : {-half, half})
      for (const double z : {-half, half}) corners.emplace_back(x, y, z);
  Simulation<Polyhedron<double>, Spring> world(
      2 * half, Materials<Spring>(1, Spring(Coulomb(0.4), stiffness)), tight());
  Pose<Space<3>> pose;
  pose.position = {0, 0, half};
  const BodyId cube = world.add_grain(world.add_shape(Polyhedron<double>(corners)), pose, 2700);
  world.add_wall({0., 0., 1.}, {0., 0., 0.});
  world.set_gravity({0., 0., -gravity});
  world.set_force(cube, {0., 0., -force});
  EnergyBalance<Space<3>> energy(world);
  StepReport report;
  for (int k = 0; k < 2000; ++k) {
    report = world.step(step);
    energy.add(world, report, step);
  }
  const double load = force + mass * gravity, sunk = load / stiffness;
  CHECK(half - world.pose(cube).position[2] == doctest::Approx(sunk).epsilon(1e-6));
  CHECK(report.elastic_energy == doctest::Approx(load * sunk / 2).epsilon(1e-6));
  CHECK(energy.kinetic() < 1e-12);
  const EnergyTerms& terms = energy.terms();
  CHECK(std::abs(terms.impacts + terms.friction) <= load * sunk);
  CHECK(terms.elastic == doctest::Approx(load * sunk / 2).epsilon(1e-6));
}
#endif

TEST_CASE_TEMPLATE("compliant: a normal force that turns makes no tangential force", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  Contacts<S> before, now;
  const auto add = [](Contacts<S>& contacts, double angle) {
    Contact<S> contact{};
    const typename S::Vector normal =
        std::cos(angle) * S::Vector::UnitX() + std::sin(angle) * S::Vector::UnitY();
    contact.frame = S::contact_frame(normal);
    contacts.points.push_back(contact);
    contacts.keys.push_back({0, 1, FeatureKey()});
    contacts.classes.push_back({});
  };
  add(before, 0);
  add(now, 0.1);
  before.impulses = {typename S::Vector(S::Vector::Unit(0) * 3 + S::Vector::Unit(1))};
  const std::vector<typename S::Twist> at_rest(2, S::Twist::Zero());
  CHECK(carry(before, now, before.impulses, now.impulses, SpringTurn<S>{at_rest, 1}) == 1);
  CHECK(now.impulses[0][0] == 3);
  const typename S::Vector tangential =
      now.points[0].frame * now.impulses[0] - 3 * now.points[0].frame.col(0);
  const typename S::Vector expected = before.points[0].frame.col(1);
  CHECK((tangential - expected).norm() <= 0.1);
  CHECK(std::abs(tangential.dot(now.points[0].frame.col(0))) < 1e-15);
}

TEST_CASE_TEMPLATE("springs turn with the mean rotation of the two bodies", S, Space<2>, Space<3>) {
  constexpr int tangents = S::dim - 1;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const double size = std::pow(10., -trial % 4);  // of the rotation of a step [rad]
    std::vector<typename S::Twist> velocity(2, S::Twist::Zero());
    typename S::Vector n, memory;
    for (auto& x : n) x = normal(random);
    n.normalize();
    for (auto& x : memory) x = normal(random);
    Contact<S> before{}, now{};
    before.b = now.b = 1;
    before.frame = S::contact_frame(n);
    // Both bodies turn as one: the components of the spring stay, in the turned frame.
    for (auto& twist : velocity)
      for (int k = 0; k < S::dofs; ++k)
        twist[k] = k < S::dim               ? normal(random)
                   : &twist == &velocity[0] ? size * normal(random)
                                            : velocity[0][k];
    const double h = 0.5;
    const auto q = S::exp(typename S::Angular(h * angular<S>(velocity[0])));
    now.frame = q.toRotationMatrix() * before.frame;
    const SpringTurn<S> turn{velocity, h};
    CHECK((turn(before, now, memory) - memory).norm() <= 1e-14 * memory.norm());
    // The frame of this step may have other tangents: the spring is the same vector.
    const typename S::Vector spring =
        now.frame.template rightCols<tangents>() * memory.template tail<tangents>();
    now.frame = S::contact_frame(q * n);
    typename S::Vector carried = turn(before, now, memory);
    CHECK(carried[0] == doctest::Approx(memory[0]));
    CHECK((now.frame.template rightCols<tangents>() * carried.template tail<tangents>() - spring)
              .norm() <= 1e-14);
    // One body turns about the normal: half of its angle. The normal tilts: the length is kept.
    velocity[0].setZero();
    velocity[1].setZero();
    if constexpr (S::dim == 3) angular<S>(velocity[1]) = 2 * size * n;
    now.frame = before.frame;
    carried = turn(before, now, memory);
    const double cosine = S::dim == 3 ? std::cos(h * size) : 1;
    CHECK(carried.template tail<tangents>().dot(memory.template tail<tangents>()) ==
          doctest::Approx(cosine * memory.template tail<tangents>().squaredNorm()));
    typename S::Vector other = n;
    for (auto& x : other) x += size * normal(random);
    now.frame = S::contact_frame(other.normalized());
    carried = turn(before, now, memory);
    CHECK(carried.norm() == doctest::Approx(memory.norm()).epsilon(1e-12));
    now.frame = S::contact_frame(-n);  // any turn about a tangent: finite, and no longer
    CHECK(turn(before, now, memory).norm() <= 2 * memory.norm());
  }
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("compliant: no friction means no tangential spring") {
  using Law = Compliant<Frictionless<double>>;
  using Vector = Eigen::Vector2d;
  Simulation<Disk<double>, Law> world(2 * radius,
                                      Materials<Law>(1, Law(Frictionless<double>(), 1e8)));
  Pose<Space<2>> pose;
  pose.position = {0, radius};
  const BodyId disk =
      world.add_grain(world.add_shape(Disk<double>(radius)), pose, density<Space<2>>);
  world.add_wall(Vector(0, 1), Vector(0, 0));
  world.set_gravity(Vector(1, -gravity));
  for (int k = 0; k < 100; ++k) world.step(step);
  CHECK(world.velocity(disk)[0] == doctest::Approx(100 * step));
}
#endif

TEST_CASE("compliant: a longer step feels the same forces") {
  Column<Space<2>> column(4, Spring(Coulomb(0.4), 1e7));
  column.world.set_gravity(Eigen::Vector2d(0, -gravity));
  column.world.set_force(column.lid, Eigen::Vector2d(0, -50));
  column.run(200);
  const double before = column.lid_height();
  column.world.step(2 * step);
  column.world.step(step / 2);
  CHECK(std::abs(column.lid_height() - before) < 1e-11);
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("compliant: a restart goes on with the same bits") {
  Column<Space<3>> column(4, Spring(Coulomb(0.4), 1e7));
  column.world.set_gravity(Eigen::Vector3d(0.5, 0, -gravity));
  column.run(50);
  const auto path = std::filesystem::temp_directory_path() / "moreau_compliant.snapshot";
  write_snapshot(path, column.world);
  Simulation<Ball<double>, Spring> again(2 * radius,
                                         Materials<Spring>(1, Spring(Coulomb(0.4), 1e8)));
  read_snapshot(path, again);
  std::filesystem::remove(path);
  column.run(50);
  StepReport report;
  for (int k = 0; k < 50; ++k) report = again.step(step);
  const StepReport own = column.world.step(step), other = again.step(step);
  CHECK(own.dissipation == other.dissipation);
  CHECK(own.elastic_energy == other.elastic_energy);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(column.world.bodies().pose[k].position == again.bodies().pose[k].position);
}
#endif

TEST_CASE("compliant: the energy of springs leaves with a removed grain") {
  Column<Space<2>> column(3, Spring(Coulomb(0.4), 1e6));
  column.world.set_gravity(Eigen::Vector2d(0, -gravity));
  column.world.set_pose(
      column.lid, Pose<Space<2>>(Eigen::Vector2d(0, 9), column.world.pose(column.lid).rotation));
  const double before = column.run(2000).elastic_energy;  // of the loads 1, 2 and 3 weights
  CHECK(before > 0);
  column.world.remove_grain(column.world.grains().back());
  auto again = column.world;
  restore_snapshot(snapshot(column.world), again);
  for (auto* world : {&column.world, &again}) {
    const StepReport report = world->step(step);
    CHECK(report.warm_started == 2);
    CHECK(report.elastic_energy - report.elastic_work ==
          doctest::Approx(before * (4 + 9) / 14).epsilon(1e-6));
  }
}

TEST_CASE("compliant: the stiffness of a pair does not depend on the margin") {
  // A square of 2 cm that touches the floor with one corner; another one is open by 3 % of its size.
  const auto relative_compliance = [](double margin) {
    Tolerances tolerances;
    tolerances.margin = margin;
    Simulation<Polygon<double>, Spring> world(0.02, Materials<Spring>(1, Spring(Coulomb(0.5), 1e7)),
                                              tight(), tolerances);
    const std::vector<Eigen::Vector2d> corners{
        {-0.01, -0.01}, {0.01, -0.01}, {0.01, 0.01}, {-0.01, 0.01}};
    const double angle = 0.03;
    Pose<Space<2>> pose;
    pose.rotation = Eigen::Rotation2Dd(angle);
    pose.position = {0, 0.01 * (std::cos(angle) + std::sin(angle)) - 1e-7};
    world.add_grain(world.add_shape(Polygon<double>(corners)), pose, 36);
    world.add_wall({0, 1}, {0, 0});
    world.set_gravity({0, -gravity});
    const StepReport report = world.step(step);
    CHECK(report.points == 2);
    return report.relative_compliance;
  };
  CHECK(relative_compliance(0.04) == doctest::Approx(relative_compliance(0.2)).epsilon(1e-12));
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE_TEMPLATE("compliant: an attraction closes a new contact, with restitution, too", Solver,
                   NonlinearGaussSeidel, ColouredGaussSeidel) {
  using Sticky = Compliant<Cohesive<Coulomb>>;
  const double pull = 1, stiffness = 1e4;
  for (const double restitution : {0.0, 0.5}) {
    CAPTURE(restitution);
    Simulation<Disk<double>, Sticky, MoreauJean, CellGrid<Space<2>>, Solver> world(
        0.02, Materials<Sticky>(
                  1, Sticky(Cohesive<Coulomb>(Coulomb(0.3, restitution), pull), stiffness)));
    const ShapeId shape = world.add_shape(Disk<double>(0.01));
    const BodyId a = world.add_grain(shape, {{0, 0}}, 2500);
    const BodyId b = world.add_grain(shape, {{0.02 - 1e-9, 0}}, 2500);
    const StepReport first = world.step(1e-5);
    CHECK(first.elastic_energy < 1e-3 * pull * pull / (2 * stiffness));
    CHECK(std::abs(first.dissipation) < 1e-3 * pull * pull / (2 * stiffness));
    for (int k = 0; k < 4000; ++k) world.step(1e-5);
    const double overlap = 0.02 - (world.pose(b).position - world.pose(a).position)[0];
    CHECK(overlap == doctest::Approx(pull / stiffness).epsilon(1e-2));
  }
}
#endif
