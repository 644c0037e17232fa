// SPDX-License-Identifier: MIT
// Solids that were turned and written with the digits of a file stand on a floor, and on each other, as those that were not.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

#include "sanitized.hpp"

using namespace moreau;

namespace {

using S = Space<3>;
using Vector = S::Vector;
constexpr double size = 0.01, h = 1e-3;

/// A prism with a regular base, height 1.
std::vector<Vector> prism(int corners) {
  std::vector<Vector> points;
  for (int k = 0; k < corners; ++k)
    for (const double z : {-0.5, 0.5}) {
      const double angle = 2 * std::numbers::pi * k / corners;
      points.emplace_back(0.7 * std::cos(angle), 0.7 * std::sin(angle), z);
    }
  return points;
}

/// The solid turned by q and rounded, with its tolerance.
Polyhedron<> rounded(const std::vector<Vector>& points, const S::Rotation& q, int decimals) {
  const double unit = std::pow(10., decimals);
  std::vector<Vector> given;
  for (const Vector& x : points) {
    const Vector turned = size * (q * x);
    given.push_back(decimals > 0 ? Vector((turned * unit).array().round() / unit)
                                 : Vector(turned.cast<float>().cast<double>()));
  }
  return {std::span<const Vector>(given), decimals > 0 ? 0.5 / unit : size * 6e-8};
}

}  // namespace

TEST_CASE("solids from files stand") {
  std::mt19937_64 random(11);
  for (const int corners : {3, 4, 5, 8, 12})
    for (const int decimals : {0, 4, 6}) {
      CAPTURE(corners);
      CAPTURE(decimals);
      Simulation<Polyhedron<>, SignoriniCoulomb<>> world(
          size, Materials<SignoriniCoulomb<>>(1, SignoriniCoulomb<>(0.5)));
      world.add_wall(Vector::UnitZ(), Vector::Zero());
      world.set_gravity(-9.81 * Vector::UnitZ());
      // Two on each other; the frame of the file is turned back.
      double height = 0;
      for (int k = 0; k < 2; ++k) {
        const S::Rotation q = random_rotation<S>(random);
        const Polyhedron<> shape = rounded(prism(corners), q, decimals);
        CHECK(shape.face_count() == std::size_t(corners) + 2);
        // The rounding has tilted the base by a little: it is laid flat.
        const Vector axis = q * Vector::UnitZ();
        Eigen::Index base = 0;
        (shape.face_normals() * axis).minCoeff(&base);
        const Vector down = shape.face_normals().row(base).transpose();
        Pose<S> pose;
        pose.rotation = S::Rotation::FromTwoVectors(down, -Vector::UnitZ());
        pose.position = Vector(0, 0, height + shape.face_offsets()[base]);
        height += size;
        world.add_grain(world.add_shape(shape), pose, 1000);
      }
      std::vector<Pose<S>> start;
      for (const BodyId grain : world.grains()) start.push_back(world.pose(grain));
      int unsolved = 0;
      for (int k = 0; k < rounds(400); ++k) unsolved += !world.step(h).solve.converged;
      CHECK(unsolved <= 2);
      std::size_t k = 0;
      // The upper one lies on a top that is tilted by about the rounding over the size.
      const double tilt = decimals == 4 ? 0.02 : decimals == 6 ? 2e-4 : 1e-6;
      for (const BodyId grain : world.grains()) {
        const Pose<S> before = start[k++], now = world.pose(grain);
        CHECK((now.position - before.position).norm() < (1e-6 + tilt) * size);
        CHECK(now.rotation.angularDistance(before.rotation) < 1e-6 + tilt);
        CHECK(linear<S>(world.bodies().velocity[grain.index()]).norm() < 1e-5);
      }
    }
}
