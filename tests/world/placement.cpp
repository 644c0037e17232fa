// SPDX-License-Identifier: MIT
// Bodies that are put where no body can be: the next step names them, and nothing is thrown through the
// scene by the correction of overlaps.
#include <cmath>
#include <doctest/doctest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"

#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

constexpr double size = 0.02, h = 1e-3;

/// A grain of 2 cm at a depth below a floor that faces `up`.
template <class ShapeT>
struct Sunk {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<double>;

  scenes::World<ShapeT> world{size, Materials<Law>(1, Law(0.5))};
  Vector up = Vector::Zero();
  ShapeT shape = regular_shape<ShapeT>(size);
  double width = 0;  // smallest, of the bounding box [m]
  ShapeId id;
  BodyId floor;

  explicit Sunk(double angle) {
    up[0] = std::sin(angle), up[S::dim - 1] = std::cos(angle);
    const auto box = shape.bounding_box(Pose<S>());
    width = (box.upper - box.lower).minCoeff();
    id = world.add_shape(shape);
    floor = world.add_wall(up, Vector::Zero());
    world.set_gravity(-9.81 * up);
  }
  /// A pose whose lowest point lies `depth` below the floor [m].
  Pose<S> at(double depth) const {
    const typename S::Rotation turn(S::contact_frame(up));  // its first axis is `up`
    const auto box = shape.bounding_box(Pose<S>(Vector::Zero(), turn.inverse()));
    return Pose<S>(Vector((-box.lower[0] - depth) * up));
  }
};

/// What a call says.
std::string message_of(const auto& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}
bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE_TEMPLATE("a grain inside a floor is named, and moves by at most the largest shift",
                   ShapeT, MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  for (const double angle : {0.0, 0.4, 2.0})
    for (const double depth : {0.6 * size, size, 0.5, 1e7})
      for (const bool later : {false, true}) {
        CAPTURE(angle);
        CAPTURE(depth);
        CAPTURE(later);
        Sunk<ShapeT> scene(angle);
        auto& world = scene.world;
        const BodyId grain = world.add_grain(scene.id, scene.at(later ? -1e-3 : depth), 2700);
        if (later) {
          for (int k = 0; k < 3; ++k) world.step(h);
          world.set_velocity(grain, Sunk<ShapeT>::Vector::Zero());
          world.set_pose(grain, scene.at(depth));
        }
        const double time = world.time();
        const auto start = world.pose(grain).position;
        scenes::World<ShapeT> read(size, world.materials());
        restore_snapshot(snapshot(world), read);
        CHECK(has(message_of([&] { read.step(h); }), "overlap of grain 1 and wall 0"));
        for (int trial = 0; trial < 2; ++trial) {  // it is refused until it is mended
          const std::string message = message_of([&] { world.step(h); });
          CAPTURE(message);
          CHECK(has(message, "Simulation::step: overlap of grain 1 and wall 0 = "));
          CHECK(has(message, "allow_overlaps()"));
          CHECK(world.time() == time);
          CHECK(world.pose(grain).position == start);
        }
        world.allow_overlaps();
        for (int k = 0; k < 5; ++k) {
          const auto before = world.pose(grain).position;
          const double speed = world.velocity(grain).norm() + 9.81 * h;
          const StepReport report = world.step(h);
          CHECK((world.pose(grain).position - before).norm() <
                1.001 * 0.02 * size + h * speed + 1e-15 * depth);
          CHECK(report.correction.largest_shift <= 1.0001 * 0.02 * size);
          CHECK(report.max_overlap > 0.5 * depth);
          CHECK(report.correction.limited >= 1);
        }
        // Its state does not raise the alarm again.
        scenes::World<ShapeT> copy(size, world.materials());
        restore_snapshot(snapshot(world), copy);
        CHECK(message_of([&] { copy.step(h); }) == "");
      }
}

TEST_CASE_TEMPLATE("slight overlaps at the start are corrected without a word", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  for (const double share : {1e-3, 0.01, 0.1, 0.3, 0.45}) {
    Sunk<ShapeT> scene(0);
    CAPTURE(share);
    scene.world.add_grain(scene.id, scene.at(share * scene.width), 2700);
    CHECK(message_of([&] { scene.world.step(h); }) == "");
  }
}

TEST_CASE_TEMPLATE("a grain inside another, an obstacle that is released, a cell that closes",
                   ShapeT, MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  for (const double share : {0.05, 0.4, 0.6, 1.0})
    for (int axis = 0; axis < S::dim; ++axis) {
      CAPTURE(share);
      CAPTURE(axis);
      const Vector aside =
          (1 - share) * Sunk<ShapeT>(0).width * Vector::Unit(axis) + 1e-4 * Vector::Ones();
      const bool deep = share > 0.5;
      {
        Sunk<ShapeT> scene(0);
        scene.world.add_grain(scene.id, {}, 2700);
        scene.world.add_grain(scene.id, Pose<S>(aside), 2700);
        scene.world.set_pose(scene.floor, Pose<S>(Vector(-Vector::Unit(S::dim - 1)),
                                                  scene.world.pose(scene.floor).rotation));
        const std::string message = message_of([&] { scene.world.step(h); });
        CAPTURE(message);
        CHECK(has(message, "overlap of grain 1 and grain 2") == deep);
      }
      {
        Sunk<ShapeT> scene(0);
        auto& world = scene.world;
        const BodyId grain = world.add_grain(scene.id, scene.at(share * scene.width), 2700);
        world.prescribe_motion(grain);
        CHECK(message_of([&] { world.step(h); }) == "");
        world.release(grain);
        CHECK(has(message_of([&] { world.step(h); }), "grain 1 and wall 0") == deep);
      }
    }
  Sunk<ShapeT> scene(0);
  scene.world.add_grain(scene.id, scene.at(-0.5), 2700);
  const Vector aside = scene.at(-0.5).position + 5 * size * Vector::UnitX();
  scene.world.add_grain(scene.id, Pose<S>(aside), 2700);
  scene.world.step(h);
  scene.world.set_periodic(0, 0, 4.8 * size);
  CHECK(has(message_of([&] { scene.world.step(h); }), "overlap of grain 1 and grain 2"));
}

TEST_CASE_TEMPLATE(
    "grains without neighbours that are all placed elsewhere have few candidate pairs", ShapeT,
    Ball<>, Disk<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int side = S::dim == 2 ? 140 : 27;  // 2e4 grains
  constexpr std::size_t count = S::dim == 2 ? side * side : side * side * side;
  scenes::World<ShapeT> world(size, Materials<SignoriniCoulomb<>>(1, SignoriniCoulomb<>(0.5)));
  const ShapeId shape = world.add_shape(ShapeT(size / 2));
  for (std::size_t k = 0; k < count; ++k) {
    Vector x;
    std::size_t rest = k;
    for (int axis = 0; axis < S::dim; ++axis, rest /= side)
      x[axis] = 1.2 * size * double(rest % side);
    world.add_grain(shape, Pose<S>(x), 1000);
  }
  CHECK(world.step(h).candidate_pairs == 0);
  for (const BodyId grain : world.grains())
    world.set_pose(grain, Pose<S>(Vector(world.pose(grain).position + Vector::Constant(20))));
  CHECK(world.step(h).candidate_pairs < 14 * count);  // neighbours of a lattice
}

TEST_CASE_TEMPLATE("grains that start inside one another are not thrown", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Sunk<ShapeT> scene(0);
  auto& world = scene.world;
  for (int k = 0; k < 12; ++k) {
    Vector x = scene.at(-0.2 * size).position;
    x[0] += 0.5 * size * (k % 4), x[S::dim - 1] += 0.45 * size * (k / 4);
    world.add_grain(scene.id, Pose<S>(x, S::exp(S::Angular::Constant(0.3 * k))), 2700);
  }
  CHECK(has(message_of([&] { world.step(h); }), "overlap of grain"));
  world.allow_overlaps();
  double fastest = 0, farthest = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<Vector> before;
    for (const BodyId grain : world.grains()) before.push_back(world.pose(grain).position);
    world.step(h);
    for (std::size_t g = 0; g < before.size(); ++g) {
      const double speed = world.velocity(world.grain(g)).norm();
      fastest = std::max(fastest, speed);
      farthest = std::max(farthest, (world.pose(world.grain(g)).position - before[g]).norm() -
                                        h * (speed + 9.81 * h));
    }
  }
  CHECK(fastest < 1);
  CHECK(farthest < 0.03 * size);
}

TEST_CASE_TEMPLATE("a step that is refused deforms no cell", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  Sunk<ShapeT> scene(0);
  scenes::World<ShapeT> world(size, scene.world.materials());
  const ShapeId shape = world.add_shape(scene.shape);
  const BodyId one = world.add_grain(shape, Pose<S>(Vector(0.05 * Vector::Ones())), 2700),
               two = world.add_grain(shape, Pose<S>(Vector(0.15 * Vector::Ones())), 2700);
  world.set_cell(0.2 * Matrix::Identity());
  CellControl<S> control;
  control.rate(0, 1) = 3, control.rate(0, 0) = -2;
  world.control_cell(control);
  for (int k = 0; k < 3; ++k) world.step(h);
  scenes::World<ShapeT> copy(size, world.materials());
  restore_snapshot(snapshot(world), copy);
  CHECK(copy.cell_motion().volume() == world.cell_motion().volume());
  const Pose<S> aside = world.pose(two);
  world.set_pose(two, Pose<S>(Vector(world.pose(one).position + 1e-3 * Vector::Ones())));
  const Matrix vectors = world.cell().vectors(), deformation = world.cell_motion().deformation();
  const Vector place = world.pose(one).position;
  for (int trial = 0; trial < 3; ++trial) {
    CHECK(has(message_of([&] { world.step(h); }), "overlap of grain 0 and grain 1"));
    CHECK(world.cell_motion().deformation() == deformation);
    CHECK((world.cell().vectors() - vectors).norm() < 1e-14 * vectors.norm());
    CHECK(world.pose(one).position == place);
  }
  world.set_pose(two, aside);
  for (int k = 0; k < 3; ++k) world.step(h), copy.step(h);
  CHECK((world.cell().vectors() - copy.cell().vectors()).norm() < 1e-14 * vectors.norm());
  CHECK((world.pose(one).position - copy.pose(one).position).norm() < 1e-14);
}

TEST_CASE_TEMPLATE("the width of a flake does not depend on its axes", ShapeT, Polygon<double>,
                   Polyhedron<double>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  // A flake of 1 mm x 50 mm, whose vertices are given in oblique axes, as those of a scan.
  const auto turn = S::exp(S::Angular::Constant(0.6));
  std::vector<Vector> corners;
  for (int k = 0; k < 1 << S::dim; ++k) {
    Vector x;
    for (int axis = 0; axis < S::dim; ++axis)
      x[axis] = (k >> axis & 1 ? 0.5 : -0.5) * (axis + 1 == S::dim ? 0.001 : 0.05);
    corners.push_back(turn * x);
  }
  const ShapeT flake{std::span<const Vector>(corners)};
  CHECK(detail::smallest_width(flake) == doctest::Approx(0.001));
  CHECK(detail::smallest_width(Rounded<ShapeT>(flake, 0.002)) == doctest::Approx(0.005));
  CHECK(detail::smallest_width(OneOf<BallIn<S>, Rounded<ShapeT>>(Rounded<ShapeT>(flake, 0.002))) ==
        doctest::Approx(0.005));
  Simulation<ShapeT, SignoriniCoulomb<double>> world(0.05, SignoriniCoulomb<double>(0.4));
  const ShapeId shape = world.add_shape(flake);
  const Vector up = turn * Vector::Unit(S::dim - 1);
  world.add_grain(shape, {Vector::Zero(), S::identity()}, 2000);
  const BodyId second = world.add_grain(shape, {Vector(0.0004 * up), S::identity()}, 2000);
  CHECK_THROWS_WITH_AS((void)world.step(1e-4), doctest::Contains("half of the smallest width"),
                       std::invalid_argument);
  world.set_pose(second, {Vector(0.0006 * up), S::identity()});
  (void)world.step(1e-4);
}
