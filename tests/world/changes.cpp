// SPDX-License-Identifier: MIT
// What a contact, a wall or a pair of bodies remembers when something changes between two steps: the state of
// friction, the forces of springs, the cell.
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <stdexcept>
#include <vector>

#include "moreau/boundary/servo.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/solve/proximal_fallback.hpp"
#include "moreau/world/detail/enlarged_boxes.hpp"
#include "moreau/world/simulation.hpp"

#include "solve/plain_coulomb.hpp"
#include "types.hpp"

using namespace moreau;
using S = Space<2>;
using Vector = S::Vector;
using Coulomb = SignoriniCoulomb<double>;

namespace {

/// Coulomb's law as a user writes a law, which counts its copies.
template <class T>
struct Counted : solve_test::PlainCoulomb<T> {
  using Plain = solve_test::PlainCoulomb<T>;
  static inline long copies = 0;

  explicit Counted(T friction = 0) : Plain{SignoriniCoulomb<T>(friction)} {}
  Counted(const Counted& other) : Plain(other) { ++copies; }
  Counted& operator=(const Counted& other) {
    Plain::operator=(other);
    ++copies;
    return *this;
  }
  ~Counted() = default;
};

/// A disk of 10 cm that slides on a floor, or over a fixed disk of 2 m, on which the normal turns.
template <class Law, class Solver = ColouredGaussSeidel>
struct Slide {
  Simulation<Disk<double>, Law, MoreauJean, CellGrid<S>, Solver> world;

  Slide(const Law& law, bool curved) : world(0.1, Materials<Law>(1, law)) {
    const ShapeId disk = world.add_shape(Disk<double>(0.05));
    Vector centre(0, 0.05 - 1e-4), along(1, 0);
    if (curved) {
      world.prescribe_motion(
          world.add_grain(world.add_shape(Disk<double>(1)), Pose<S>(Vector(0, -1)), 1000));
      const Vector out = Vector(-0.3, 1).normalized();
      centre = Vector(0, -1) + (1.05 - 1e-4) * out;
      along = Vector(out.y(), -out.x());
    } else {
      world.add_wall({0, 1}, {0, 0});
    }
    world.set_velocity(world.add_grain(disk, Pose<S>(centre), 1000), 3 * along);
    world.set_gravity({0, -98.1});
  }
  /// |r_t| / (r_n + pull h) of each step.
  std::vector<double> friction(const std::vector<double>& lengths, double pull = 0) {
    std::vector<double> ratios;
    for (const double h : lengths) {
      world.step(h);
      REQUIRE(world.contacts().size() == 1);
      const Vector& r = world.contacts().impulses[0];
      ratios.push_back(std::abs(r[1]) / (r[0] + pull * h));
    }
    return ratios;
  }
};

/// Static friction in the first step, `slip` from then on.
void check_friction(const std::vector<double>& ratios, double slip) {
  CHECK(ratios.front() == doctest::Approx(0.4).epsilon(1e-6));
  for (std::size_t k = 1; k < ratios.size(); ++k)
    CHECK(ratios[k] == doctest::Approx(slip).epsilon(1e-6));
}

}  // namespace

TEST_CASE_TEMPLATE("static friction ends with the first slip, also where the normal turns", Solver,
                   MOREAU_TYPES((NonlinearGaussSeidel), (ColouredGaussSeidel))) {
  const std::vector<double> steps(20, 2e-4);
  for (const bool curved : {false, true}) {
    CAPTURE(curved);
    check_friction(Slide<Coulomb>(Coulomb(0.2, 0, 0.4), curved).friction(steps), 0.2);
    check_friction(Slide<Coulomb>(Coulomb(0, 0, 0.4), curved).friction(steps), 0);
    using Springs = Compliant<Coulomb>;
    check_friction(Slide<Springs>(Springs(Coulomb(0.2, 0, 0.4), 1e6), curved).friction(steps), 0.2);
  }
  // The pull of a step is its length times the attraction.
  const std::vector<double> uneven{1e-4, 1.5e-4, 1e-4, 2e-4, 1e-4, 1.5e-4};
  using Sticky = Cohesive<Coulomb>;
  Slide<Sticky, Solver> slide(Sticky(Coulomb(0.2, 0, 0.4), 50, 1e-2), false);
  check_friction(slide.friction(uneven, 50), 0.2);
}

TEST_CASE_TEMPLATE("cohesive: a disk is held by another at the default range, up to its adhesion",
                   Solver, MOREAU_TYPES((NonlinearGaussSeidel), (ColouredGaussSeidel))) {
  using Law = Cohesive<Coulomb>;
  const Disk<double> shape(0.01);
  const double weight = shape.mass_properties(2500).mass * 9.81;
  // The largest distance from the place at which the disk hung [m].
  const auto lowered = [&](double adhesion, double angle, double step, bool correct) {
    OverlapCorrectionOptions correction;
    correction.enabled = correct;
    Simulation<Disk<double>, Law, MoreauJean, CellGrid<S>, Solver> world(
        0.02, Materials<Law>(1, Law(Coulomb(0.5), adhesion)), {}, {}, correction);
    const Vector down(std::sin(angle), -std::cos(angle));
    const ShapeId disk = world.add_shape(shape);
    world.prescribe_motion(world.add_grain(disk, {}, 2500));
    const BodyId hanging = world.add_grain(disk, Pose<S>(Vector(0.02 * down)), 2500);
    world.set_gravity(9.81 * down);
    double most = 0;
    for (double time = 0; time < 0.2; time += step) {
      world.step(step);
      most = std::max(most, (world.pose(hanging).position - 0.02 * down).norm());
    }
    return most;
  };
  for (const double angle : {0.0, 0.3, 1.1, 2.0, 3.1, 4.4})
    for (const double step : {1e-4, 1e-3, 1.0 / 60})
      for (const bool correct : {false, true}) {
        CAPTURE(angle);
        CAPTURE(step);
        CAPTURE(correct);
        CHECK(lowered(1.05 * weight, angle, step, correct) < 1e-6);
        CHECK(lowered(0.95 * weight, angle, step, correct) > 1e-4);
      }
}

TEST_CASE_TEMPLATE("cohesive: free disks keep their momentum to rounding, whatever the adhesion",
                   Solver, MOREAU_TYPES((NonlinearGaussSeidel), (ColouredGaussSeidel))) {
  using Law = Cohesive<Coulomb>;
  const double r = 0.01, rate = 10, h = 1e-4;
  const int steps = 200;
  OverlapCorrectionOptions correction;
  correction.enabled = false;
  for (double adhesion = 1; adhesion < 2e6; adhesion *= 10) {
    CAPTURE(adhesion);
    Simulation<Disk<double>, Law, MoreauJean, CellGrid<S>, Solver> world(
        2 * r, Materials<Law>(1, Law(Coulomb(0.5), adhesion)), {}, {}, correction);
    const ShapeId disk = world.add_shape(Disk<double>(r));
    for (int k = 0; k < 7; ++k) {  // a triangular lattice, which turns and flies
      const Vector at = 2 * r * Vector(k % 3 + 0.5 * double(k / 3), std::sqrt(0.75) * (k / 3));
      const BodyId grain = world.add_grain(disk, Pose<S>(at), 2500);
      world.set_velocity(grain, {0.1 - rate * at.y(), rate * at.x()});
      world.set_spin(grain, S::Angular::Constant(rate));
    }
    const Momentum<S> before = momentum(world);
    for (int k = 0; k < steps; ++k) world.step(h);
    const Momentum<S> after = momentum(world);
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * steps;
    CHECK((after.linear - before.linear).norm() < rounding * before.linear.norm());
    CHECK((after.angular - before.angular).norm() < rounding * before.angular.norm());
  }
}

TEST_CASE("a snapshot between two steps keeps the state of friction") {
  Slide<Coulomb> slide(Coulomb(0.2, 0, 0.4), false), copy(Coulomb(0.2, 0, 0.4), false);
  slide.friction({2e-4});
  restore_snapshot(snapshot(slide.world), copy.world);
  CHECK(copy.friction({2e-4}).front() == doctest::Approx(0.2).epsilon(1e-6));
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE_TEMPLATE(
    "springs in series with rolling resistance: a disk is slowed down as by the rigid law", Solver,
    NonlinearGaussSeidel, ColouredGaussSeidel) {
  // A disk that rolls is slowed down by eta g / (1 + k), k = 1/2.
  using Law = Compliant<RollingResistance<double>>;
  const double eta = 0.1, g = 9.81, h = 1e-3;
  Simulation<Disk<double>, Law, MoreauJean, CellGrid<S>, Solver> world(
      0.1, Materials<Law>(1, Law(RollingResistance<double>(0.5, eta), 1e6)));
  world.add_wall({0, 1}, {0, 0});
  const BodyId disk =
      world.add_grain(world.add_shape(Disk<double>(0.05)), Pose<S>(Vector(0, 0.05)), 1000);
  world.set_velocity(disk, {1, 0});
  world.set_spin(disk, S::Angular::Constant(-1 / 0.05));
  world.set_gravity({0, -g});
  for (int step = 0; step < 100; ++step) CHECK(world.step(h).solve.converged);
  CHECK(world.velocity(disk).x() == doctest::Approx(1 - 0.1 * eta * g / 1.5).epsilon(0.01));
}
#endif

TEST_CASE("a solver's place may be left to its default where the solver is the reference") {
  using Law = Cohesive<Coulomb>;
  const Materials<Law> materials(1, Law(Coulomb(0.4), 1));
  using World = Simulation<Disk<double>, Law, MoreauJean, CellGrid<Space<2>>, NonlinearGaussSeidel>;
  CHECK(World(0.1, materials, {}, Tolerances()).grain_size() == 0.1);
  CHECK(ProximalFallback<>().options().tolerance == ProximalFallback<>::Options().tolerance);
}

TEST_CASE("a snapshot between set_periodic() and the next step can be read back") {
  using Sim = Simulation<Disk<double>, Coulomb>;
  const auto make = [] {
    Sim world(0.1, Materials<Coulomb>(1, Coulomb(0.3)));
    const ShapeId disk = world.add_shape(Disk<double>(0.05));
    for (int k = 0; k < 6; ++k) world.add_grain(disk, Pose<S>(Vector(0.0999 * k, 0.05)), 1000);
    world.add_wall({0, 1}, {0, 0});
    world.set_gravity({0, -9.81});
    for (int step = 0; step < 5; ++step) world.step(1e-3);
    return world;
  };
  Sim world = make(), copy = make();
  world.set_periodic(0, -1, 1);
  restore_snapshot(snapshot(world), copy);
  for (int step = 0; step < 3; ++step) world.step(1e-3), copy.step(1e-3);
  CHECK(snapshot(copy) == snapshot(world));
  CHECK(world.contacts().size() > 6);
}

TEST_CASE("springs push anew after what moves a body, or a law, has changed") {
  using Law = LinearSpringDashpot<double>;
  const double stiffness = 1e5, overlap = 1e-4, h = 1e-6;
  const Materials<Law> soft(1, Law(stiffness / 10, stiffness / 20, 1, 0)),
      stiff(1, Law(stiffness, stiffness / 2, 1, 0));
  // Two disks, which overlap, are held for a step. What is changed then must act in the next step.
  const auto speed_after = [&](const auto& change) {
    Simulation<Disk<double>, Law> world(0.1, soft);
    const ShapeId shape = world.add_shape(Disk<double>(0.05));
    const BodyId left = world.add_grain(shape, Pose<S>(Vector(0, 0)), 1000),
                 right = world.add_grain(shape, Pose<S>(Vector(0.1 - overlap, 0)), 1000);
    world.prescribe_motion(left);
    change(world, right, false);
    world.step(h);
    world.set_velocity(right, {0, 0});
    world.set_pose(right, Pose<S>(Vector(0.1 - overlap, 0)));
    world.step(h);
    change(world, right, true);
    const double before = world.velocity(right).x();
    world.step(h);
    return (world.velocity(right).x() - before) * world.bodies().grain_mass[right.index()] / h;
  };
  const double released = speed_after([](auto& world, BodyId right, bool now) {
    now ? world.release(right) : world.prescribe_motion(right);
  });
  CHECK(released == doctest::Approx(stiffness / 10 * overlap).epsilon(1e-3));
  const double stiffened = speed_after([&](auto& world, BodyId, bool now) {
    if (now) world.set_materials(stiff);
  });
  CHECK(stiffened == doctest::Approx(stiffness * overlap).epsilon(1e-3));
}

TEST_CASE_TEMPLATE("a step does not visit the laws of all pairs of materials", SpaceT,
                   MOREAU_TYPES((Space<2>), (Space<3>, Space<2, float>, Space<3, float>))) {
  using T = typename SpaceT::Scalar;
  using Law = Counted<T>;
  using Direction = typename SpaceT::Vector;
  constexpr std::size_t materials = 100;
  Simulation<BallIn<SpaceT>, Law> world(T(0.1), Materials<Law>(materials, Law(T(0))));
  const Direction up = Direction::Unit(SpaceT::dim - 1);
  world.add_wall(up, Direction::Zero(), MaterialId(3));
  const BodyId ball = world.add_grain(world.add_shape(BallIn<SpaceT>(T(0.05))),
                                      Pose<SpaceT>(Direction(T(0.05) * up)), 1000, MaterialId(70));
  world.set_velocity(ball, Direction::UnitX());
  world.set_gravity(T(-9.81) * up);
  const T h = T(1e-3);
  world.step(h);
  const long before = Law::copies;
  for (int k = 0; k < 5; ++k) world.step(h);
  CHECK(Law::copies - before < 1000);  // with all 10,000 laws 50,000
  CHECK(double(world.velocity(ball)[0]) == doctest::Approx(1));
  // Laws that are set act in the next step.
  Materials<Law> rough(materials, Law(T(0)));
  rough.set(MaterialId(70), MaterialId(3), Law(T(0.5)));
  world.set_materials(rough);
  auto copy = world;
  for (auto* one : {&world, &copy}) {
    one->step(h);
    CHECK(double(one->velocity(ball)[0]) == doctest::Approx(1 - 0.5 * 9.81 * double(h)));
  }
}

TEST_CASE("a pressure acts on half-spaces alone, and no wall lies across a periodic axis") {
  Simulation<Disk<double>, Coulomb> world(0.1, Materials<Coulomb>(1, Coulomb(0.3)));
  FacetMesh<S> segments;
  segments.vertices = {{-1, 0}, {1, 0}};
  segments.facets = {{1, 0}};
  const BodyId mesh = world.add_mesh_wall(segments, {}, WallSides::both);
  const auto load = [&](BodyId wall) { PressureLoad(world, wall, 1e3, 1.0, [] { return 1.0; }); };
  CHECK_THROWS_WITH_AS(load(mesh), "PressureLoad: wall = 0 must be the id of a half-space",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(load(world.add_cylinder({0, 0}, S::Angular::Ones(), 5.0)),
                       "PressureLoad: wall = 1 must be the id of a half-space",
                       std::invalid_argument);

  Simulation<Disk<double>, Coulomb> periodic(0.1, Materials<Coulomb>(1, Coulomb(0.3)));
  const BodyId floor = periodic.add_wall({0, 1}, {0, 0});
  periodic.set_periodic(0, -1, 1);
  Pose<S> pose = periodic.pose(floor);
  pose.position.y() = -0.1;
  periodic.set_pose(floor, pose);
  pose.rotation = S::exp(S::Angular::Constant(0.5)) * pose.rotation;
  CHECK_THROWS_WITH_AS(periodic.set_pose(floor, pose),
                       doctest::Contains("Simulation::set_pose: normal"), std::invalid_argument);
  CHECK(periodic.pose(floor).position.y() == -0.1);
}

TEST_CASE("dashpots push anew after a velocity has been set") {
  // A ball that hits a floor is stopped. What is left is the force of the spring.
  using Law = LinearSpringDashpot<double>;
  const double stiffness = 1e5, radius = 0.05;
  const Law law(stiffness, 0, 0, 0.3);
  Simulation<Disk<double>, Law> world(0.1, Materials<Law>(1, law));
  world.add_wall({0, 1}, {0, 0});
  const BodyId ball =
      world.add_grain(world.add_shape(Disk<double>(radius)), Pose<S>(Vector(0, radius)), 1000);
  const double mass = world.bodies().grain_mass[ball.index()], h = law.duration(mass) / 200;
  world.set_velocity(ball, {0, -1});
  for (int k = 0; k < 40; ++k) world.step(h);
  const double overlap = radius - world.pose(ball).position.y();
  world.set_velocity(ball, {0, 0});
  world.step(h);
  CHECK(world.velocity(ball).y() * mass / h == doctest::Approx(stiffness * overlap).epsilon(0.03));
}

TEST_CASE(
    "springs: a disk deep inside a floor is refused and nothing has moved, unless it is allowed") {
  using Law = LinearSpringDashpot<double>;
  for (const double depth : {1e-4, 0.02, 0.045, 0.055, 0.1, 1.0})
    for (const bool later : {false, true}) {
      CAPTURE(depth);
      CAPTURE(later);
      Simulation<Disk<double>, Law> world(0.1, Materials<Law>(1, Law(1e5)));
      const ShapeId shape = world.add_shape(Disk<double>(0.05));
      world.add_wall({0, 1}, {0, 0});
      const Pose<S> place(Vector(0, 0.05 - depth));
      const BodyId disk = world.add_grain(shape, later ? Pose<S>(Vector(0, 0.06)) : place, 1000);
      world.set_gravity({0, -9.81});
      if (later) {
        world.step(1e-5);
        world.set_pose(disk, place);
      }
      const Vector velocity = world.velocity(disk);
      const double time = world.time();
      if (depth < 0.05) {
        CHECK_NOTHROW(world.step(1e-5));
        continue;
      }
      CHECK_THROWS_WITH_AS(world.step(1e-5),
                           doctest::Contains("Simulation::step: overlap of grain 1 and wall 0 = "),
                           std::invalid_argument);
      CHECK(world.pose(disk).position == place.position);
      CHECK(world.velocity(disk) == velocity);
      CHECK(world.time() == time);
      world.allow_overlaps();
      CHECK_NOTHROW(world.step(1e-5));
    }
}

TEST_CASE_TEMPLATE(
    "couples and impulses of keys that are gone go to the nearest contact of the pair", T, Space<2>,
    Space<3>) {
  using List = Contacts<T, T::dofs>;
  List before, now;
  const auto add = [](List& contacts, std::uint32_t b, std::size_t feature, double x,
                      double angle) {
    Contact<T> contact{};
    contact.a = 0, contact.b = b;
    contact.lever_a = x * T::Vector::UnitX();
    typename T::Angular turn = T::Angular::Zero();
    turn[0] = angle;
    contact.frame = T::contact_frame(typename T::Vector(T::exp(turn) * T::Vector::Unit(1)));
    contacts.points.push_back(contact);
    contacts.keys.push_back({0, b, FeatureKey(FeatureKey::Kind::vertex_edge, feature, 0)});
    contacts.impulses.push_back(T::Twist::Zero());
  };
  for (const double x : {0.0, 1.0, 2.0}) add(before, 1, std::size_t(x), x, 0.1 * x);
  for (std::size_t c = 0; c < 3; ++c) angular<T>(before.impulses[c]).setConstant(1 + double(c));
  add(now, 1, 1, 1, 0.3);     // the same
  add(now, 1, 5, 0.1, 0.2);   // nearest to the first
  add(now, 1, 6, 1.9, -0.2);  // nearest to the last
  add(now, 2, 0, 2, 0);       // another pair
  CHECK(warm_start(before, now) == 1);
  CHECK(hand_over(before, now, before.impulses, now.impulses, ImpulseTurn<T>()) == 2);
  const auto in_world = [](const List& contacts, std::size_t c) {
    return typename T::Angular(T::angular_frame(contacts.points[c].frame) * contacts.couple(c));
  };
  CHECK((in_world(now, 0) - in_world(before, 1)).norm() < 1e-15);
  CHECK((in_world(now, 1) - in_world(before, 0)).norm() < 1e-15);
  CHECK((in_world(now, 2) - in_world(before, 2)).norm() < 1e-15);
  CHECK(now.impulses[3].isZero(0));
}

TEST_CASE("a grain without a pair makes the list of pairs new some twenty times on its way") {
  using Boxes = detail::EnlargedBoxes<S>;
  const double reach = 1e-4, skin = 1e-3;
  for (const double speed : {0.3 * skin, 2 * skin, 1000 * skin}) {  // per step
    int renewals = 0;
    Aabb<S> box(Vector(0, 0), Vector(0.02, 0.02)), old = box.inflated(reach + skin);
    const Vector move = speed * Vector(0.8, -0.6);
    for (int k = 0; k < 100000; ++k) {
      box = {box.lower + move, box.upper + move};
      if (old.contains(box.inflated(reach))) continue;
      old = Boxes::next(box, old, reach, skin);
      REQUIRE(old.contains(box.inflated(reach)));
      ++renewals;
    }
    CHECK(renewals < 22);
    CHECK(old.lower ==
          Boxes::next(box, old, reach, skin).lower);  // renewed by others: it keeps its box
  }
  Boxes boxes;
  boxes.find_pairs_of(4, {{0, 2}});
  CHECK((!boxes.is_alone(0) && boxes.is_alone(1) && !boxes.is_alone(2) && boxes.is_alone(3)));
}
