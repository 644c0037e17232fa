// SPDX-License-Identifier: MIT
// Boundaries in single precision.
#include <cmath>
#include <doctest/doctest.h>

#include "boundary/check_lid.hpp"
#include "world/assemblies.hpp"

namespace {

using moreau::BodyId;
using moreau::Polygon;
using moreau::Polyhedron;
using Law = moreau::SignoriniCoulomb<float>;

}  // namespace

TEST_CASE_TEMPLATE("float: a lid under pressure settles to it", ShapeT, Polyhedron<float>,
                   Polygon<float>) {
  scenes::check_lid<ShapeT>();
}

TEST_CASE_TEMPLATE("float: a box rests in a cylinder on its corners", ShapeT, Polyhedron<float>,
                   Polygon<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const float half = 0.05f, radius = 0.2f, h = 1e-3f;
  const float depth = std::sqrt(radius * radius - half * half) - half;
  scenes::World<ShapeT> world(0.1f, moreau::Materials<Law>(1, Law(0.4f)));
  moreau::Pose<S> pose;
  pose.position = -depth * Vector::Unit(up);
  const BodyId grain =
      world.add_grain(world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(half))), pose, 1000);
  world.add_cylinder(Vector::Zero(), S::Angular::Unit(S::angular_dim / 2), radius);
  world.set_gravity(-9.81f * Vector::Unit(up));
  for (int k = 0; k < 300; ++k) CHECK(world.step(h).pairs == 1);
  const Vector now = world.bodies().pose[grain.index()].position;
  CHECK(double((now - pose.position).norm()) < 1e-4);
  CHECK(double(world.bodies().velocity[grain.index()].norm()) < 1e-3);
}

TEST_CASE_TEMPLATE("float: grains hunt each other around a periodic cell", ShapeT,
                   Polyhedron<float>, Polygon<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  scenes::World<ShapeT> ring(0.2f, moreau::Materials<Law>(1, Law(0, 1)));
  ring.set_periodic(0, 0, 1);
  const auto shape = ring.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(0.1f)));
  moreau::Pose<S> pose;
  pose.position[0] = 0.2f;
  const BodyId runner = ring.add_grain(shape, pose, 1000);
  pose.position[0] = 0.7f;
  const BodyId target = ring.add_grain(shape, pose, 1000);
  ring.set_velocity(runner, Vector::UnitX());
  for (int k = 0; k < 5000; ++k) ring.step(1e-3f);
  const auto& bodies = ring.bodies();
  const float travelled =
      bodies.pose[runner.index()].position[0] + bodies.pose[target.index()].position[0] - 0.9f;
  CHECK(double(travelled) == doctest::Approx(5).epsilon(1e-4));
  CHECK(bodies.pose[runner.index()].position[0] > 1.2f);
}
