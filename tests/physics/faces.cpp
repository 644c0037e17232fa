// SPDX-License-Identifier: MIT
// Faces carry what statics says, at default options: the motion of a grain that lands, tips or slides
// on a face does not depend on the direction in which it lies, on the order of its vertices, or on
// the body under it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "rotation_between.hpp"
#include "world/assemblies.hpp"

namespace {

using moreau::ContactPoints;
using moreau::Polygon;
using moreau::Polyhedron;
using scenes::World;
using S = moreau::Space<3>;
using Vector = S::Vector;
constexpr double pi = std::numbers::pi, weight = 9.81, step = 2e-4;

/// A prism along z, centred at the origin, with a regular base or one stretched along an axis.
/// @param sides  of the base; a side faces +x
/// @param half   half axes of the ellipse around the base, and half the height [m]
/// @param order  seed of the order of the vertices; 0: along the rim
Polyhedron<> prism(int sides, const Vector& half, unsigned order) {
  std::vector<Vector> corners;
  for (int k = 0; k < sides; ++k)
    for (const double z : {-half[2], half[2]}) {
      const double angle = 2 * pi * (k + 0.5) / sides;
      corners.push_back({half[0] * std::cos(angle), half[1] * std::sin(angle), z});
    }
  std::mt19937 random(order);
  if (order != 0) std::shuffle(corners.begin(), corners.end(), random);
  return Polyhedron<>(std::span<const Vector>(corners));
}
S::Rotation about(const Vector& axis, double angle) {
  return S::exp(angle * axis);
}

/// What lies under the grain.
enum class Floor { wall, plate_before, plate_after };

/// A grain on a floor through the origin.
struct Scene {
  World<Polyhedron<>> world;
  moreau::BodyId grain;
  S::Rotation tilt;  ///< turns z into the normal of the floor
  bool converged = true;

  /// @param pose of the grain, where z is the normal of the floor
  Scene(const Polyhedron<>& shape, double size, const moreau::Pose<S>& pose, double friction,
        const Vector& up = Vector::UnitZ(), Floor floor = Floor::wall)
      : world(size, moreau::Materials<scenes::LawOf<Polyhedron<>>>(
                        1, scenes::LawOf<Polyhedron<>>(friction))),
        tilt(rotation_between(Vector::UnitZ(), up)) {
    const moreau::Pose<S> placed{tilt * pose.position, tilt * pose.rotation};
    const auto plate = [&] {
      const auto id = world.add_shape(scenes::cuboid<Polyhedron<>>({2, 2, 0.5}));
      world.prescribe_motion(world.add_grain(id, {tilt * Vector(0, 0, -0.5), tilt}, 1000));
    };
    if (floor == Floor::plate_before) plate();
    grain = world.add_grain(world.add_shape(shape), placed, 1000);
    if (floor == Floor::plate_after) plate();
    if (floor == Floor::wall) world.add_wall(up, Vector::Zero());
    world.set_gravity(-weight * up);
  }
  void run(double duration, const auto& look) {
    const int steps = static_cast<int>(std::lround(duration / step));
    for (int k = 0; k < steps; ++k) {
      converged = world.step(step).solve.converged && converged;
      look();
    }
  }
  double spin() const { return world.spin(grain).norm(); }
  /// Where the floor's normal is z [m].
  Vector position() const { return tilt.inverse() * world.pose(grain).position; }
};

}  // namespace

// The reaction of the floor passes through the face if friction times the height of the centre is
// less than the distance from the centre to the nearest side. So the grain slides on, and its face
// stays on the floor.
TEST_CASE("a prism that lands flat while it flies along the floor does not spin") {
  const Vector ups[] = {Vector::UnitZ(), Vector::UnitX(), {0.48, 0.6, 0.64}};
  for (const int sides : {3, 4, 5, 6, 8, 20}) {
    double distance = -1;
    for (unsigned d = 0; d < 8; ++d) {
      const double angle = 2 * pi * d / 8 + 0.05 * (d / 4);
      const Vector along(std::cos(angle), std::sin(angle), 0);
      Scene scene(prism(sides, {0.1, 0.06, 0.03}, d), 0.06,
                  {{0, 0, 0.030003}, about(Vector::UnitZ(), 0.05 * d)}, 0.3, ups[d % 3],
                  Floor(d % 2 == 0 ? 0 : 1 + d / 2 % 2));
      scene.world.set_velocity(scene.grain, scene.tilt * Vector(3 * along - Vector::UnitZ()));
      double spin = 0;
      scene.run(0.2, [&] { spin = std::max(spin, scene.spin()); });
      CAPTURE(sides);
      CAPTURE(d);
      CHECK(scene.converged);
      CHECK(spin < 1e-2);  // reduced to three points: 12 rad/s
      const Vector way = scene.position() - Vector(0, 0, 0.03);
      if (distance < 0) distance = way.dot(along);
      CHECK(way.dot(along) == doctest::Approx(distance).epsilon(1e-6));
      CHECK((way - along * way.dot(along)).norm() < 2e-5);
    }
  }
}

TEST_CASE("a rod that tips over a side of its base does not spin about its axis") {
  for (const int sides : {4, 6})
    for (const double friction : {0.2, 1.0})
      for (unsigned d = 0; d < 6; ++d) {
        const S::Rotation turn = about(Vector::UnitZ(), 2 * pi * d / 6);
        const Polyhedron<> rod = prism(sides, {0.01, 0.01, 0.1}, d);
        const double tilt = 0.02 + std::atan(0.1 * std::cos(pi / sides));
        const S::Rotation rotation = turn * about(Vector::UnitY(), tilt);
        double lowest = 1;
        for (const auto& corner : rod.vertices().rowwise())
          lowest = std::min(lowest, (rotation * Vector(corner.transpose()))[2]);
        Scene scene(rod, 0.02, {{0, 0, -lowest}, rotation}, friction);
        double spin = 0;
        scene.run(0.8, [&] {
          const Vector axis = scene.world.pose(scene.grain).rotation * Vector::UnitZ();
          spin = std::max(spin, std::abs(scene.world.spin(scene.grain).dot(axis)));
        });
        CAPTURE(sides);
        CAPTURE(friction);
        CAPTURE(d);
        CHECK(scene.converged);
        CHECK(spin < 1e-2);  // reduced to three points: up to 180 rad/s after the fall
        const Vector axis = scene.world.pose(scene.grain).rotation * Vector::UnitZ();
        CHECK(std::abs(axis[2]) < 1e-3);  // it lies on its side
      }
}

TEST_CASE("a prism on an incline stays or slides straight, whatever the direction of the incline") {
  constexpr double slope = 0.4;  // tan = 0.42
  for (const int sides : {3, 4, 6, 8})
    for (const double friction : {0.3, 0.7})
      for (unsigned d = 0; d < 6; ++d) {
        const double angle = 2 * pi * d / 6;
        const Vector down(std::cos(angle), std::sin(angle), 0);
        Scene scene(prism(sides, {0.01, 0.01, 0.005}, d), 0.01,
                    {{0, 0, 0.005}, about(Vector::UnitZ(), 0.3 * d)}, friction, Vector::UnitZ(),
                    Floor(d % 3));
        scene.world.set_gravity(weight *
                                (std::sin(slope) * down - std::cos(slope) * Vector::UnitZ()));
        double spin = 0;
        scene.run(0.3, [&] { spin = std::max(spin, scene.spin()); });
        const double acceleration =
            std::max(0.0, weight * (std::sin(slope) - friction * std::cos(slope)));
        CAPTURE(sides);
        CAPTURE(friction);
        CAPTURE(d);
        CHECK(scene.converged);
        CHECK(spin < 1e-2);  // reduced to three points: 0.27 rad/s
        const Vector way = scene.position() - Vector(0, 0, 0.005);
        // The scheme makes h a t too much: the velocity at the end of a step is that in the whole step.
        const double t = scene.world.time();
        CHECK(std::abs(way.dot(down) - acceleration * t * t / 2) < acceleration * t * step + 1e-9);
        CHECK((way - down * way.dot(down)).norm() < 1e-7);
      }
}

TEST_CASE("a rectangle that lands flat does not spin, to either side, on a wall or a plate") {
  using Plane = moreau::Space<2>;
  for (const double half : {0.03, 0.1})
    for (const double speed : {-3.0, 3.0})
      for (const bool plate : {false, true})
        for (const double lean : {0.0, 0.7, pi / 2}) {
          const Plane::Rotation tilt(lean);
          const Plane::Vector up = tilt * Plane::Vector::UnitY();
          World<Polygon<>> world(
              0.06, moreau::Materials<scenes::LawOf<Polygon<>>>(1, scenes::LawOf<Polygon<>>(0.5)));
          const auto grain =
              world.add_grain(world.add_shape(scenes::cuboid<Polygon<>>({half, 0.03})),
                              {0.030003 * up, tilt}, 1000);
          if (plate)
            world.prescribe_motion(world.add_grain(
                world.add_shape(scenes::cuboid<Polygon<>>({2, 0.5})), {-0.5 * up, tilt}, 1000));
          else
            world.add_wall(up, Plane::Vector::Zero());
          world.set_gravity(-weight * up);
          world.set_velocity(grain, tilt * Plane::Vector(speed, -1));
          double spin = 0;
          bool converged = true;
          for (int k = 0; k < 1000; ++k) {
            converged = world.step(step).solve.converged && converged;
            spin = std::max(spin, std::abs(world.spin(grain)[0]));
          }
          CAPTURE(half);
          CAPTURE(speed);
          CAPTURE(plate);
          CHECK(converged);
          CHECK(spin < 1e-2);
        }
}

namespace {

/// A grain without weight that flies onto a floor at 1 m/s, with a face that is turned by `tilt` from it. In the middle
/// of a step the middle of the face is at the floor, so that some of the points have closed their gap and others have
/// not. Returns the largest velocity of a rim of the face, relative to its middle, after the impact [m/s].
template <class ShapeT>
double flutter(const ShapeT& shape, double half, double radius, double friction, double restitution,
               const typename moreau::SpaceOf<ShapeT>::Angular& tilt) {
  using Space = moreau::SpaceOf<ShapeT>;
  using Law = scenes::LawOf<ShapeT>;
  const auto up = Space::Vector::Unit(Space::dim - 1);
  World<ShapeT> world(0.05, moreau::Materials<Law>(1, Law(friction, restitution)));
  const auto grain =
      world.add_grain(world.add_shape(shape), {(half + 2.5e-4) * up, Space::exp(tilt)}, 2000);
  world.add_wall(up, Space::Vector::Zero());
  world.set_velocity(grain, 0.7 * Space::Vector::UnitX() - up);
  double spin = 0;
  for (int k = 0; k < 8; ++k) {
    const auto report = world.step(1e-4);
    CHECK(report.solve.converged);
    spin = std::max(spin, world.spin(grain).norm());
  }
  CHECK(world.velocity(grain).dot(up) == doctest::Approx(restitution).epsilon(1e-3));
  return spin * radius;
}

}  // namespace

TEST_CASE("a face that lands flat bounces as a whole, also where rounding has left it tilted") {
  for (const double restitution : {0.15, 0.5, 0.9})
    for (const double friction : {0.0, 0.4, 0.9})
      for (const double size : {0.0, 1e-9, -1e-7, 1e-5}) {
        CAPTURE(restitution);
        CAPTURE(friction);
        CAPTURE(size);
        for (const int sides : {3, 4, 8, 24})
          for (const double turn : {0.0, 2.0}) {
            CAPTURE(sides);
            const Vector tilt(size * std::cos(turn), size * std::sin(turn), 0);
            for (const double half : {0.01, 0.025})  // sweeps along the rim of 24 points diverged
              CHECK(flutter(prism(sides, {0.06, 0.06, half}, 0), half, 0.06, friction, restitution,
                            tilt) < 1e-3);
          }
        moreau::Space<2>::Angular tilt;
        tilt[0] = size;
        CHECK(flutter(scenes::cuboid<Polygon<>>({0.06, 0.02}), 0.02, 0.06, friction, restitution,
                      tilt) < 1e-3);
      }
}

TEST_CASE_TEMPLATE("all contact points are used unless a program says few", ShapeT, Polyhedron<>,
                   Polygon<>) {
  World<ShapeT> world(0.06,
                      moreau::Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(0.5)));
  CHECK(world.contact_points() == ContactPoints::all);
  world.set_contact_points(ContactPoints::few);
  CHECK(world.contact_points() == ContactPoints::few);
}
