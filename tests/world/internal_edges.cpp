// SPDX-License-Identifier: MIT
// Obstacles and parts of compound grains that lie flush are one surface for a polytope that slides over
// them; steps, slots and side walls are not.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/shape/compound.hpp"

#include "instances/compound.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"
#include "world/tiles.hpp"

using namespace moreau;

namespace {

template <class ShapeT>
struct WorldOf {
  using type = scenes::World<ShapeT>;
};
template <class Part>
struct WorldOf<Compound<Part>> {
  using type = Simulation<Compound<Part>, SignoriniCoulomb<>>;
};

/// A row of blocks whose tops lie in the plane of the last coordinate 0, and a grain that slides over it.
struct Slide {
  double block = 0.05, grain = 0.02;  ///< edge lengths [m]
  double slot = 0;                    ///< between two blocks [m]
  double jitter = 0;                  ///< of the heights [m]
  double tilt = 0;                    ///< of everything, about the last axis of rotation [rad]
  double turn = 0;                    ///< of the grain about the vertical, in space [rad]
  double friction = 0, h = 1e-3, v = 1, time = 0.3;
  bool backwards = false;  ///< the order in which blocks are added, after the grain
};

template <class ShapeT>
ShapeT box(double length, double height, double width = 0) {
  using S = SpaceOf<ShapeT>;
  typename S::Vector half = S::Vector::Constant((width > 0 ? width : length) / 2);
  half[0] = length / 2;
  half[S::dim - 1] = height / 2;
  return cuboid<ShapeT>(half);
}

/// How far a shape reaches along a unit vector from its origin [m].
template <class ShapeT>
double reach(const ShapeT& shape, const typename SpaceOf<ShapeT>::Vector& direction) {
  if constexpr (CompoundShape<ShapeT>) {
    double most = -1;
    for (const auto& part : shape.parts())
      most = std::max(
          most,
          direction.dot(part.pose(part.shape.support(part.pose.rotation.inverse() * direction))));
    return most;
  } else {
    return direction.dot(shape.support(direction));
  }
}

template <class S>
typename S::Rotation tilted(double angle) {
  typename S::Angular axis = S::Angular::Zero();
  axis[S::angular_dim / 2] = angle;
  return S::exp(axis);
}

/// Where the grain is at the end, along and above the row, and its speed; on a plane without blocks.
struct End {
  double way, height, speed;
};
template <class ShapeT>
End run(const Slide& slide, bool on_plane, const ShapeT& block, const ShapeT& grain) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  using Law = SignoriniCoulomb<>;
  typename WorldOf<ShapeT>::type world(0.02, Materials<Law>(1, Law(slide.friction)));
  const auto q = tilted<S>(slide.tilt);
  const ShapeId of_block = world.add_shape(block), of_grain = world.add_shape(grain);
  BodyId id;
  const auto add_grain = [&] {
    const Vector at = reach(grain, -Vector::Unit(up)) * Vector::Unit(up);
    typename S::Angular turn = S::Angular::Zero();
    turn[S::angular_dim - 1] = S::angular_dim > 1 ? slide.turn : 0;
    id = world.add_grain(of_grain, {q * at, S::normalized(q * S::exp(turn))}, 1000);
    world.set_velocity(id, slide.v * (q * Vector::UnitX()));
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-slide.jitter, slide.jitter);
  std::vector<Vector> places;
  const int count = int(0.5 / (slide.block + slide.slot));
  for (int k = -2; k < count; ++k)
    for (int j = 0; j < (S::dim == 2 ? 1 : 2); ++j) {
      Vector at = Vector::Zero();
      at[up - 1] = S::dim == 2 ? 0 : (j - 0.5) * slide.block;
      at[0] = k * (slide.block + slide.slot);
      at[up] = off(random) - reach(block, Vector::Unit(up));
      places.push_back(at);
    }
  if (slide.backwards) {
    add_grain();
    std::reverse(places.begin(), places.end());
  }
  if (on_plane)
    world.add_wall(q * Vector::Unit(up), Vector::Zero());
  else
    for (const Vector& at : places)
      world.prescribe_motion(world.add_grain(of_block, {q * at, q}, 1000));
  if (!slide.backwards) add_grain();
  world.set_gravity(-9.81 * (q * Vector::Unit(up)));
  for (double t = 0; t < slide.time - slide.h / 2; t += slide.h) world.step(slide.h);
  const Vector end = q.inverse() * world.pose(id).position;
  return {end[0], end[up] - reach(grain, -Vector::Unit(up)), world.velocity(id).norm()};
}
template <class ShapeT>
void check(const Slide& slide, const ShapeT& block, const ShapeT& grain) {
  const End right = run(slide, true, block, grain), found = run(slide, false, block, grain);
  CAPTURE(SpaceOf<ShapeT>::dim);
  CAPTURE(slide.block);
  CAPTURE(slide.grain);
  CAPTURE(slide.slot);
  CAPTURE(slide.jitter);
  CAPTURE(slide.tilt);
  CAPTURE(slide.turn);
  CAPTURE(slide.friction);
  CAPTURE(slide.h);
  CAPTURE(slide.v);
  CAPTURE(slide.backwards);
  CHECK(found.way == doctest::Approx(right.way).epsilon(1e-3));
  CHECK(found.speed == doctest::Approx(right.speed).epsilon(2e-3));
  CHECK(std::abs(found.height) < 1e-5);
}
template <class ShapeT>
void check(const Slide& slide) {
  check(slide, box<ShapeT>(slide.block, 0.05), box<ShapeT>(slide.grain, slide.grain));
}

template <class Part>
Compound<Part> compound_of(const std::vector<Part>& shapes,
                           const std::vector<typename SpaceOf<Part>::Vector>& places) {
  std::vector<typename Compound<Part>::Part> parts;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    parts.push_back({shapes[k], {places[k], SpaceOf<Part>::identity()}});
  return Compound<Part>(parts);
}

}  // namespace

TEST_CASE_TEMPLATE("a polytope slides over flush blocks as over a plane", ShapeT, Polygon<>,
                   Polyhedron<>) {
  check<ShapeT>({});
  check<ShapeT>({.h = 1e-4, .time = 0.1});
  check<ShapeT>({.block = 0.02});
  check<ShapeT>({.block = 0.013, .grain = 0.03});
  check<ShapeT>({.jitter = 1e-15});
  check<ShapeT>({.jitter = 1e-9});
  check<ShapeT>({.jitter = 5e-7});
  check<ShapeT>({.tilt = 0.3});
  check<ShapeT>({.jitter = 1e-9, .tilt = -0.7});
  check<ShapeT>({.backwards = true});
  check<ShapeT>({.v = 0.2, .time = 0.5});
  check<ShapeT>({.v = 3, .time = 0.1});
  check<ShapeT>({.friction = 0.3, .v = 1.2, .time = 0.4});
  check<ShapeT>({.friction = 0.1, .h = 2e-4, .v = 0.6});
  check<ShapeT>({.slot = 1e-9});
  check<ShapeT>({.slot = 3e-4});
  check<ShapeT>({.block = 0.02, .slot = 0.003});
}

TEST_CASE("a cube slides over flush blocks in any direction of its edges") {
  using ShapeT = Polyhedron<>;
  for (const double turn : {0.1, 0.5, 0.785, 1.2}) check<ShapeT>({.turn = turn});
  check<ShapeT>({.jitter = 1e-9, .tilt = 0.2, .turn = 0.4});
  std::vector<Eigen::Vector3d> hexagon;
  for (int k = 0; k < 6; ++k)
    for (const double z : {-0.01, 0.01})
      hexagon.push_back({0.012 * std::cos(k * std::numbers::pi / 3),
                         0.012 * std::sin(k * std::numbers::pi / 3), z});
  const ShapeT prism(hexagon);
  check<ShapeT>({.grain = 0.024}, box<ShapeT>(0.05, 0.05), prism);
  check<ShapeT>({.grain = 0.024, .turn = 0.3}, box<ShapeT>(0.05, 0.05), prism);
}

// Where four tiles meet, the tile diagonal to that below a cube turned it over.
TEST_CASE("polyhedra slide over floors of tiles in 100 directions") {
  using P = Polyhedron<>;
  tiles::check_directions<scenes::World<P>, P>(tiles::polytopes<P, P>(), 100, 1e-6);
}
TEST_CASE("polygons slide over blocks of different sizes") {
  using P = Polygon<>;
  tiles::check_directions<scenes::World<P>, P>(tiles::polytopes<P, P>(), 40, 1e-6);
}

TEST_CASE_TEMPLATE("a compound grain slides over flush parts and flush obstacles", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  using Vector = typename S::Vector;
  // Parts of different height: their vertices do not coincide.
  const Part tall = box<Part>(0.025, 0.05, 0.05), flat = box<Part>(0.025, 0.03, 0.05);
  const Vector x = Vector::UnitX(), up = Vector::Unit(S::dim - 1);
  const Vector at_tall = -0.0125 * x - 0.025 * up, at_flat = 0.0125 * x - 0.015 * up;
  const auto block = compound_of<Part>({tall, flat}, {at_tall, at_flat});
  const Part half = box<Part>(0.01, 0.02, 0.02);
  const auto single = compound_of<Part>({box<Part>(0.02, 0.02)}, {Vector::Zero()});
  const auto twin = compound_of<Part>({half, half}, {-0.005 * x, 0.005 * x});
  const auto plain = compound_of<Part>({box<Part>(0.05, 0.05)}, {Vector::Zero()});
  for (const auto& floor : {block, plain})
    for (const auto& grain : {single, twin}) {
      check<Compound<Part>>({}, floor, grain);
      check<Compound<Part>>({.jitter = 1e-9, .tilt = 0.3}, floor, grain);
      check<Compound<Part>>({.friction = 0.2, .v = 1.2}, floor, grain);
    }
}

namespace {

/// A polygon, or the prism of the same outline with the third axis along y, 0.1 wide.
template <class Part>
Part prism_of(const std::vector<Eigen::Vector2d>& outline) {
  std::vector<typename SpaceOf<Part>::Vector> points;
  for (const Eigen::Vector2d& x : outline)
    if constexpr (SpaceOf<Part>::dim == 2)
      points.push_back(x);
    else
      for (const double side : {-0.05, 0.05}) points.push_back({x[0], side, x[1]});
  return Part(points);
}
/// Two arms of length 0.3 along (+-sin angle, cos angle), which meet in the origin, their seam below it.
template <class Part>
Compound<Part> notch(double angle) {
  std::vector<Part> arms;
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector2d end = 0.3 * Eigen::Vector2d(side * std::sin(angle), std::cos(angle));
    const Eigen::Vector2d below(0, -0.2);
    arms.push_back(prism_of<Part>({{0, 0}, end, end + 2 * below, below}));
  }
  return Compound<Part>(arms);
}

}  // namespace

// The sides of a tip in a concave corner are the axes of least overlap with both arms, at their seam: the tip passed.
TEST_CASE_TEMPLATE("a tip stays in the concave corner in which a seam ends", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  using Law = SignoriniCoulomb<>;
  const auto up = typename S::Vector(S::Vector::Unit(S::dim - 1));
  for (const double angle : {0.5, 0.8, 1.05})
    for (const double sharpness : {0.3, 0.7, 0.95})
      for (const bool hangs :
           {false, true}) {  // the notch on the tip, upside down, or the tip in the notch
        typename WorldOf<Compound<Part>>::type world(0.05, Materials<Law>(1, Law(0.3)));
        const double half = sharpness * angle;
        const Eigen::Vector2d side(0.1 * std::sin(half), 0.1 * std::cos(half));
        const std::vector<Part> cone{prism_of<Part>({{0, 0}, side, {-side[0], side[1]}})};
        const Compound<Part> tip(cone), corner = notch<Part>(angle);
        const auto add = [&](const Compound<Part>& shape, double aside) {
          typename S::Vector at = shape.centroid_of_input();
          at[0] += aside;
          return world.add_grain(world.add_shape(shape), {at, S::identity()}, 1000);
        };
        const BodyId of_corner = add(corner, 0), of_tip = add(tip, hangs ? 0 : 0.001);
        world.prescribe_motion(hangs ? of_tip : of_corner);
        const BodyId grain = hangs ? of_corner : of_tip;
        world.set_gravity((hangs ? 9.81 : -9.81) * up);
        const auto before = world.pose(grain).position;
        for (int k = 0; k < 300; ++k) world.step(1e-3);
        CAPTURE(S::dim);
        CAPTURE(angle);
        CAPTURE(sharpness);
        CAPTURE(hangs);
        CHECK(std::abs((world.pose(grain).position - before).dot(up)) < 0.003);
      }
}

TEST_CASE_TEMPLATE("steps, side walls and ramps stay", ShapeT, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<>;
  constexpr int up = S::dim - 1;
  // A block that stands higher by this stops a grain at its side.
  for (const double step : {1e-4, 1e-3, 0.01, 0.1})
    for (const double h : {1e-3, 1e-4}) {
      scenes::World<ShapeT> world(0.02, Materials<Law>(1, Law(0.0)));
      const ShapeId block = world.add_shape(box<ShapeT>(0.2, 0.2));
      const ShapeId shape = world.add_shape(box<ShapeT>(0.02, 0.02));
      world.prescribe_motion(
          world.add_grain(block, {-0.1 * Vector::Unit(up), S::identity()}, 1000));
      world.prescribe_motion(world.add_grain(
          block, {0.2 * Vector::UnitX() + (step - 0.1) * Vector::Unit(up), S::identity()}, 1000));
      const BodyId grain = world.add_grain(shape, {0.01 * Vector::Unit(up), S::identity()}, 1000);
      world.set_gravity(-9.81 * Vector::Unit(up));
      world.set_velocity(grain, 0.1 * Vector::UnitX());  // faster, it would tip over the step
      for (int k = 0; k < int(1.2 / h); ++k) world.step(h);
      CAPTURE(S::dim);
      CAPTURE(step);
      CAPTURE(h);
      CHECK(world.pose(grain).position[0] < 0.0905);
      CHECK(world.pose(grain).position[up] > 0.00999);
    }
  // A shaft: a grain that falls between two blocks stays between them.
  scenes::World<ShapeT> world(0.02, Materials<Law>(1, Law(0.0)));
  const ShapeId block = world.add_shape(box<ShapeT>(0.05, 0.05));
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0})
      world.prescribe_motion(world.add_grain(
          block, {0.0351 * side * Vector::UnitX() + 0.05 * k * Vector::Unit(up), S::identity()},
          1000));
  world.add_wall(Vector::Unit(up), -0.025 * Vector::Unit(up));
  const BodyId grain = world.add_grain(world.add_shape(box<ShapeT>(0.02, 0.02)),
                                       {0.1 * Vector::Unit(up), S::identity()}, 1000);
  world.set_gravity(-9.81 * Vector::Unit(up) + Vector::UnitX());
  for (int k = 0; k < 1000; ++k) world.step(1e-3);
  CHECK(world.pose(grain).position[0] == doctest::Approx(1e-4).epsilon(0.1));
  CHECK(world.pose(grain).position[up] == doctest::Approx(-0.015).epsilon(1e-3));
}

TEST_CASE_TEMPLATE("a plank on many flush blocks costs as many times more as there are blocks",
                   ShapeT, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<>;
  constexpr int up = S::dim - 1;
  const auto milliseconds = [](int blocks) {
    ColouredOptions options;
    options.max_sweeps = 1;
    scenes::World<ShapeT> world(0.02, Materials<Law>(1, Law(0.3)), ColouredGaussSeidel(options));
    const ShapeId block = world.add_shape(box<ShapeT>(0.02, 0.02));
    for (int k = 0; k < blocks; ++k)
      world.prescribe_motion(world.add_grain(
          block, {0.02 * k * Vector::UnitX() - 0.01 * Vector::Unit(up), S::identity()}, 1000));
    const double length = 0.02 * blocks;
    world.add_grain(
        world.add_shape(box<ShapeT>(length, 0.02, 0.02)),
        {(length - 0.02) / 2 * Vector::UnitX() + 0.01 * Vector::Unit(up), S::identity()}, 1000);
    double least = 1e9;
    for (int k = 0; k < 3; ++k) least = std::min(least, world.step(1e-4).ms_detect);
    CHECK(world.contacts().size() >= 2 * std::size_t(blocks));
    return least;
  };
  const double some = milliseconds(1000), all = milliseconds(8000);
  CAPTURE(some);
  CAPTURE(all);
  CHECK(all < 32 * some);  // 64 times if every block is compared with every other one
}
