// SPDX-License-Identifier: MIT
// Sources add grains where there is room, sinks remove them.
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "moreau/boundary/detail/point_grid.hpp"
#include "moreau/boundary/sink.hpp"
#include "moreau/boundary/source.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/sample/concave_mesh.hpp"

#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::LawOf;
using scenes::World;

namespace {

constexpr double h = 1e-3;

template <class ShapeT>
struct Shaft {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  World<ShapeT> world{0.02, Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(0.4))};
  ShapeId large = world.add_shape(regular_shape<ShapeT>(0.03));
  ShapeId small = world.add_shape(regular_shape<ShapeT>(0.02));

  Shaft() { world.set_gravity(-9.81 * Vector::Unit(up)); }
  /// A source in a box of 0.2 m at the height 0.
  SourceOptions<S> options() const {
    SourceOptions<S> options;
    options.region = {Vector::Zero(), Vector::Constant(0.2)};
    options.shapes = {large, small};
    options.density = 2700;
    options.velocity = -0.5 * Vector::Unit(up);
    return options;
  }
  double least_gap() const {
    double least = 1;
    for (std::size_t i = 0; i < world.grain_count(); ++i)
      for (std::size_t j = i + 1; j < world.grain_count(); ++j) {
        const BodyId a = world.grain(i), b = world.grain(j);
        Pose<S> other = world.pose(b);
        other.position = world.cell().nearest(other.position, world.pose(a).position);
        const Placed<ShapeT> one(world.shape(a), world.pose(a)), two(world.shape(b), other);
        least = std::min(least, distance(one, two).gap);
      }
    return least;
  }
};

}  // namespace

TEST_CASE_TEMPLATE("a grid of points finds all that are near", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937 random(5);
  std::uniform_real_distribution<T> number(-1, 1);
  const auto draw = [&] { return Vector(Vector::NullaryExpr([&] { return number(random); })); };
  detail::PointGrid<S> grid;
  constexpr T reach = T(0.1);
  grid.start(reach);
  std::vector<Vector> points;
  for (int k = 0; k < 400; ++k) {
    points.push_back(draw());
    grid.add(points.back());
    const Vector x = draw();
    std::set<std::uint32_t> found;
    CHECK_FALSE(grid.any_near(x, [&](std::uint32_t number) {
      CHECK(found.insert(number).second);  // once
      return false;
    }));
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if ((points[i] - x).norm() < reach) CHECK(found.count(i) == 1);
    CHECK(grid.any_near(points.front(), [](std::uint32_t number) { return number == 0; }));
  }
}

TEST_CASE_TEMPLATE("a source puts no grain into the solid of a closed mesh wall", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>), (Polygon<>, Polyhedron<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Simulation<ShapeT, SignoriniCoulomb<>> world(0.01, SignoriniCoulomb<>(0.4));
  const FacetMesh<S> solid = star_mesh<S>([](const Vector&) { return 0.08; }, 2);
  const Vector place = Vector::Constant(0.1);
  world.add_mesh_wall(solid, Pose<S>(place));
  SourceOptions<S> options;
  options.region = {Vector::Zero(), Vector::Constant(0.2)};
  options.shapes = {world.add_shape(regular_shape<ShapeT>(0.01))};
  options.density = 2700;
  options.grain_limit = 60;
  options.trials = 200;
  Source<S> source(options);
  source.apply(world, h);
  CHECK(world.grain_count() > 20);
  for (const BodyId grain : world.grains())
    CHECK((world.pose(grain).position - place).norm() > 0.08);
}

TEST_CASE_TEMPLATE("a source fills its box up to its limit, without overlaps", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>))) {
  for (const bool periodic : {false, true}) {
    Shaft<ShapeT> shaft;
    using Vector = typename Shaft<ShapeT>::Vector;
    auto& world = shaft.world;
    auto options = shaft.options();
    options.grain_limit = 25;
    options.trials = 200;
    if (periodic) {
      world.set_periodic(0, 0.05, 0.25);
    } else {
      world.add_wall(Vector::UnitX(), 0.03 * Vector::UnitX());
    }
    Source source(options);
    const GrainSum added = source.apply(world, h);
    CHECK(added.count >= 12);
    CHECK(added.count == world.grain_count());
    CHECK(source.added().size() == added.count);
    CHECK(shaft.least_gap() >= 0);
    double mass = 0;
    for (const BodyId grain : source.added()) {
      mass += world.bodies().grain_mass[grain.index()];
      CHECK(world.velocity(grain) == options.velocity);
      CHECK(options.region.contains(world.shape(grain).bounding_box(world.pose(grain))));
    }
    CHECK(added.mass == mass);
    CHECK(world.step(h).max_overlap == 0);
    for (int k = 0; k < 5; ++k) source.apply(world, h);
    CHECK(world.grain_count() <= 25);
    CHECK(source.total().count == world.grain_count());
  }
}

TEST_CASE("a source keeps out of a cylinder wall and the grains that are there") {
  Shaft<Disk<>> shaft;
  using Vector = Shaft<Disk<>>::Vector;
  shaft.world.add_cylinder(Vector(0.1, 0.1), Shaft<Disk<>>::S::Angular::Constant(1), 0.09);
  const BodyId obstacle = shaft.world.add_grain(shaft.world.add_shape(Disk<>(0.05)),
                                                {Vector(0.1, 0.1), Space<2>::identity()}, 1000);
  shaft.world.prescribe_motion(obstacle);
  auto options = shaft.options();
  options.grain_limit = 12;
  options.trials = 500;
  Source source(options);
  CHECK(source.apply(shaft.world, h).count > 5);
  CHECK(shaft.least_gap() >= 0);
  CHECK(shaft.world.step(h).max_overlap == 0);
}

TEST_CASE("a rate is kept, as long as there is room; what is missing follows") {
  Shaft<Disk<>> shaft;
  auto options = shaft.options();
  options.rate = 250;
  Source source(options);
  for (int k = 0; k < 100; ++k) {
    source.apply(shaft.world, h);
    CHECK(double(source.total().count) + source.waiting() == std::floor(0.25 * (k + 1) + 1e-9));
    shaft.world.step(h);
  }
  CHECK(source.total().count == 25);
  CHECK(source.waiting() == 0);
  CHECK(shaft.world.grain_count() == 25);
}

TEST_CASE_TEMPLATE("a sink removes the grains behind a plane or outside a box", ShapeT, Ball<>,
                   Disk<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Shaft<ShapeT> shaft;
  auto& world = shaft.world;
  const auto add = [&](double x) {
    return world.add_grain(shaft.small, {x * Vector::UnitX(), S::identity()}, 1000);
  };
  const BodyId left = add(-1), middle = add(0), right = add(1), fixed = add(-2), far = add(5);
  world.prescribe_motion(fixed);
  Sink<S> behind = Sink<S>::behind(Vector::UnitX(), -0.5 * Vector::UnitX());
  const double mass = world.bodies().grain_mass[left.index()];
  GrainSum removed = behind.apply(world);
  CHECK(removed.count == 1);
  CHECK(removed.mass == mass);
  CHECK(behind.removed().front() == left);
  CHECK_FALSE(world.contains(left));
  CHECK(behind.apply(world).count == 0);
  CHECK(behind.removed().empty());
  CHECK(behind.total().count == 1);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  Aabb<S> box{Vector::Constant(-infinity), Vector::Constant(infinity)};
  box.upper[0] = 2;
  Sink<S> outside = Sink<S>::outside(box);
  CHECK(outside.apply(world).count == 1);
  CHECK_FALSE(world.contains(far));
  world.set_periodic(1, 0, 1);
  Pose<S> pose = world.pose(right);
  pose.position[1] = 7.25;  // 0.25 in the cell
  world.set_pose(right, pose);
  box.lower[1] = 0.2;
  CHECK(Sink<S>::outside(box).apply(world).count == 1);
  CHECK(world.contains(right));
  CHECK_FALSE(world.contains(middle));
  CHECK(world.contains(fixed));
}

TEST_CASE("a run with a source and a sink restarts with the same bits") {
  Shaft<Disk<>> shaft, other;
  using S = Space<2>;
  for (auto* one : {&shaft, &other}) one->world.add_wall({0.6, 0.8}, {0.1, -0.1});
  auto options = shaft.options();
  options.rate = 150;
  Source source(options), other_source(options);
  Sink<S> sink = Sink<S>::behind({0, 1}, {0, -0.2}), other_sink = sink;
  const auto run = [](auto& world, auto& from, auto& to) {
    for (int k = 0; k < 500; ++k) {
      from.apply(world, h);
      world.step(h);
      to.apply(world);
    }
  };
  run(shaft.world, source, sink);
  const std::string middle = snapshot(shaft.world, source, sink);
  restore_snapshot(middle, other.world, other_source, other_sink);
  run(shaft.world, source, sink);
  run(other.world, other_source, other_sink);
  CHECK(snapshot(shaft.world, source, sink) == snapshot(other.world, other_source, other_sink));
  CHECK(sink.total().count > 10);
  CHECK(source.total().count - sink.total().count == shaft.world.grain_count());
}

TEST_CASE("bad options of a source and a sink are named") {
  Shaft<Disk<>> shaft;
  using S = Space<2>;
  const auto refused = [&](const char* what, auto&& change) {
    auto options = shaft.options();
    options.rate = 1;
    change(options);
    CHECK_THROWS_WITH_AS(Source<S>(options).apply(shaft.world, 2), doctest::Contains(what),
                         std::invalid_argument);
  };
  refused("Source: region.lower", [](auto& options) { options.region.upper[0] = -1; });
  refused("Source: shapes.size() = 0", [](auto& options) { options.shapes.clear(); });
  refused("Source: rate = 0", [](auto& options) { options.rate = 0; });
  refused("Source: trials = 0", [](auto& options) { options.trials = 0; });
  refused("Source: rate = inf must be finite if there is no grain_limit",
          [](auto& options) { options.rate = std::numeric_limits<double>::infinity(); });
  refused("Source: velocity", [](auto& options) { options.velocity[0] = options.rate / 0.0; });
  refused("Source::apply: shape = 0 must have a circumdiameter",
          [](auto& options) { options.region.upper[0] = 0.025; });
  refused("Simulation::shape: shape = 9", [](auto& options) { options.shapes = {ShapeId(9)}; });
  refused("Simulation::add_grain: density = 0", [](auto& options) { options.density = 0; });
  auto options = shaft.options();
  options.rate = 1;
  CHECK_THROWS_WITH_AS(Source<S>(options).apply(shaft.world, 0),
                       "Source::apply: step = 0 must be finite and > 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Sink<S>::behind({0, 2}, {0, 0}),
                       "Sink::behind: normal = (0, 2) must be unit", std::invalid_argument);
  CHECK_THROWS_AS(Sink<S>::outside(Aabb<S>()), std::invalid_argument);
  CHECK(shaft.world.grain_count() == 0);
}

TEST_CASE("a grain that finds no room is the next one: large grains are not left out") {
  World<Disk<>> world(0.01, Materials<LawOf<Disk<>>>(1, LawOf<Disk<>>(0.4)));
  SourceOptions<Space<2>> options;
  options.region = {{0.0, 0.0}, {0.1, 0.1}};
  options.shapes = {world.add_shape(Disk<>(0.005)), world.add_shape(Disk<>(0.045))};
  options.density = 2700;
  options.grain_limit = 1000;
  Source<Space<2>> source(options), copy(options);
  std::size_t large = 0, all = 0;
  for (int k = 0; k < 2000; ++k) {
    source.apply(world, h);
    for (const BodyId grain : source.added())
      large += circumradius(world.shape(grain)) > 0.02 ? 1u : 0u, ++all;
    if (world.grain_count() > 0)
      world.remove_grain(world.grains().front());  // the oldest one leaves
  }
  CHECK(all > 200);
  CHECK(double(large) / double(all) == doctest::Approx(0.5).epsilon(0.15));
  // A snapshot contains the shape that waits.
  World<Disk<>> other(0.01, Materials<LawOf<Disk<>>>(1, LawOf<Disk<>>(0.4)));
  restore_snapshot(snapshot(world, source), other, copy);
  for (int k = 0; k < 50; ++k) {
    for (auto* one : {&world, &other})
      if (one->grain_count() > 0) one->remove_grain(one->grains().front());
    source.apply(world, h);
    copy.apply(other, h);
  }
  CHECK(snapshot(world, source) == snapshot(other, copy));
}

TEST_CASE("the limit of a source does not count obstacles") {
  Shaft<Disk<>> shaft;
  for (int k = 0; k < 5; ++k)
    shaft.world.prescribe_motion(
        shaft.world.add_grain(shaft.small, {{1 + 0.1 * k, 0}, Space<2>::identity()}, 2700));
  auto options = shaft.options();
  options.grain_limit = 3;
  options.trials = 500;
  Source<Space<2>> source(options);
  CHECK(source.apply(shaft.world, h).count == 3);
  CHECK(source.apply(shaft.world, h).count == 0);
  CHECK(source.waiting() == 1);
  CHECK(shaft.world.grain_count() == 8);
}

TEST_CASE("a source counts the grains that it added before it threw") {
  using ShapeT = Disk<>;
  World<ShapeT> world(0.02, Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(0.4)));
  world.set_periodic(0, 0, 0.2);
  const ShapeId small = world.add_shape(ShapeT(0.005)), wide = world.add_shape(ShapeT(0.06));
  SourceOptions<Space<2>> options;
  options.region = {{0.0, 0.0}, {0.2, 0.4}};
  options.shapes = {small, small, small, wide};
  options.density = 2500;
  options.grain_limit = 50;
  Source<Space<2>> source(options);
  CHECK_THROWS_AS(source.apply(world, h), std::invalid_argument);  // too wide for the cell
  CHECK(source.added().size() == world.grain_count());
  CHECK(source.total().count == world.grain_count());
}
