// SPDX-License-Identifier: MIT
// Turning floors and steps of meshes: small scenes whose answer is known, each in many variants: shape, size,
// direction, step, in space and in the plane, in double and single precision, at default options.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>

#include "physics/kinds.hpp"
#include "sanitized.hpp"

using namespace kinds;

// The prisms are so flat that they do not tip: the centrifugal acceleration, at most 7.5 m/s^2, times the height of the
// centre is less than gravity times the distance to the nearest side.
TEST_CASE_TEMPLATE("kinds: a turning floor carries a grain on its circle", ShapeT, Polyhedron<>,
                   Polyhedron<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937 random(11);
  for (int variant = 0; variant < 24; ++variant) {
    const double radius = variant % 2 == 0 ? 0.3 : 0.1, spin = variant % 3 == 0 ? -5 : 3;
    const double h = variant % 4 < 2 ? 1e-3 : 4e-4, half = 0.01, height = 0.4 * half;
    const typename S::Rotation tilt = tilt_to<S>(random, variant % 4 != 0);
    const Vector up = tilt * Vector::UnitZ();
    World<ShapeT> world = world_of<ShapeT>(2 * half, 1, up);
    const auto shape = world.add_shape(prism<ShapeT>(
        3 + variant % 5, {half, (variant % 2 == 0 ? 1 : 0.7) * half, height}, random));
    BodyId table;
    if (variant % 3 == 1) {
      table = world.add_grain(world.add_shape(scenes::cuboid<ShapeT>({T(0.5), T(0.5), T(0.05)})),
                              {Vector(T(-0.05) * up), tilt}, T(1000));
      world.prescribe_motion(table);
    } else {
      table = world.add_wall(up, Vector::Zero());
    }
    const Vector arm(T(radius), 0, T(height));
    const auto grain = world.add_grain(shape, {tilt * arm, tilt}, T(1000));
    const Vector axis = T(spin) * up;
    world.set_spin(table, axis);
    world.set_spin(grain, axis);
    world.set_velocity(grain, axis.cross(Vector(tilt * arm)));
    int unsolved = 0;
    for (int k = 0; k < rounds(int(2 * 2 * pi / std::abs(spin) / h)); ++k)
      unsolved += !world.step(T(h)).solve.converged;
    CAPTURE(variant);
    CHECK(unsolved <= 2);  // the first steps, from the tangent to the chord
    const Vector local = tilt.inverse() * world.pose(grain).position;
    CHECK(std::abs(double(local.template head<2>().norm()) - radius) <
          bound<ShapeT>(2e-5, 2e-3) * radius);
  }
}

namespace {

/// A floor, a riser at x = 0 and a tread of a height.
template <class S>
FacetMesh<S> mesh_of_step(double height) {
  using T = typename S::Scalar;
  FacetMesh<S> mesh;
  const double xs[] = {0.1, 0, 0, -0.1}, zs[] = {0, 0, height, height};
  for (std::uint32_t k = 0; k < 4; ++k) {
    if constexpr (S::dim == 2) {
      mesh.vertices.push_back({T(xs[k]), T(zs[k])});
      if (k > 0) mesh.facets.push_back({k - 1, k});
    } else {
      for (const double y : {-0.1, 0.1}) mesh.vertices.push_back({T(xs[k]), T(y), T(zs[k])});
      if (k == 0) continue;
      const std::uint32_t i = 2 * (k - 1);
      mesh.facets.push_back({i, i + 1, i + 3});
      mesh.facets.push_back({i, i + 3, i + 2});
    }
  }
  return mesh;
}

}  // namespace

// A grain that flies against a step below its centre tips over it, so lower steps are touched from the start.
TEST_CASE_TEMPLATE("kinds: a grain that is pushed against a step of a mesh stays on the floor",
                   ShapeT, Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  int variant = 0;
  for (const double height : {2e-3, 5e-3, 8e-3, 0.012, 0.015, 0.019})
    for (const double overlap : {-2e-3, 0.0, 1e-6})
      for (const double turn : {0.0, 0.2}) {
        if (turn > 0 && overlap > -1e-3) continue;
        if (overlap < 0 && height < 0.01) continue;
        for (const double push : {1.0, 3.0}) {
          ++variant;
          World<ShapeT> world = world_of<ShapeT>(0.02, 0, up);
          world.set_gravity(T(-weight) * up - T(push) * Vector::UnitX());
          world.add_mesh_wall(mesh_of_step<S>(height));
          const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(0.01))));
          Vector position = T(0.01) * up;
          position[0] = T(0.01 - overlap + 0.003 * (turn > 0));
          const auto grain = world.add_grain(shape, {position, S::exp(about_up<S>(turn))}, T(2700));
          double top = 0, over = 0;
          int unsolved = 0;
          for (int k = 0; k < rounds(1500); ++k) {
            const StepReport report = world.step(T(2e-4));
            unsolved += !report.solve.converged;
            top = std::max(top, double(world.pose(grain).position[S::dim - 1]));
            over = std::max(over, report.max_overlap);
          }
          CAPTURE(height);
          CAPTURE(overlap);
          CAPTURE(turn);
          CAPTURE(push);
          CHECK(unsolved == 0);
          CHECK(top < 0.01 + bound<ShapeT>(1e-6, 2e-6));
          CHECK(over < 2e-5);
          CHECK(double(world.pose(grain).position[0]) > 0.0099);
          CHECK(double(world.pose(grain).position[0]) < 0.0125);
        }
      }
}
