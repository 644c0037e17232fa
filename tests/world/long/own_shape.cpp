// SPDX-License-Identifier: MIT
// A whole simulation with a shape that has only a mass, a bounding box and a support function.
#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/support_box.hpp"
#include "moreau/world/simulation.hpp"

#include "conformance/shape.hpp"
#include "sanitized.hpp"

namespace {

using namespace moreau;
using S = Space<3>;
using V = S::Vector;

/// The superellipsoid sum |x_i / a_i|^p <= 1. Its moments follow from Dirichlet's integral.
struct Superellipsoid {
  using Space = S;
  using Vector = V;
  Vector axes;
  double p;

  /// The integral of x_i^power over the body.
  double moment(int i, int power) const {
    double product = 8 / (p * p * p);
    for (int k = 0; k < 3; ++k)
      product *=
          std::pow(axes[k], k == i ? power + 1 : 1) * std::tgamma((k == i ? power + 1 : 1) / p);
    return product / std::tgamma(1 + (3 + power) / p);
  }
  MassProperties<S> mass_properties(double density) const {
    const Vector second(moment(0, 2), moment(1, 2), moment(2, 2));
    const Vector inertia = Vector::Constant(second.sum()) - second;
    return {density * moment(0, 0), Vector::Zero(), density * S::Inertia(inertia.asDiagonal())};
  }
  Aabb<S> bounding_box(const Pose<S>& pose) const { return support_box(*this, pose); }
  Vector support(const Vector& direction) const {
    const Vector d = axes.cwiseProduct(direction).normalized();
    const Vector x = d.cwiseAbs().array().pow(1 / (p - 1));
    const double norm = std::pow(x.array().pow(p).sum(), 1 / p);
    return axes.cwiseProduct(x.cwiseProduct(d.cwiseSign())) / norm;
  }
};
static_assert(ConvexShape<Superellipsoid> && !Polytope<Superellipsoid>);

using Law = SignoriniCoulomb<double>;
using World = Simulation<Superellipsoid, Law>;

TEST_CASE("it is a shape") {
  conformance::check_shape(Superellipsoid{{1, 0.8, 0.6}, 4});
  const auto ball = Superellipsoid{{1, 1, 1}, 2}.mass_properties(1);
  CHECK(ball.mass == doctest::Approx(4 * std::numbers::pi / 3));
  CHECK(ball.inertia(0, 0) == doctest::Approx(0.4 * ball.mass));
}

TEST_CASE("it stays at rest on a floor, round or nearly a box, turned about the vertical") {
  for (const double p : {2.0, 4.0, 12.0}) {
    World world(0.02, Materials<Law>(1, Law(0.4)));
    const Pose<S> start{V(0, 0, 0.008), S::exp(V(0, 0, 0.4))};
    const BodyId grain = world.add_grain(world.add_shape({{0.012, 0.01, 0.008}, p}), start, 2700);
    world.add_wall(V::UnitZ(), V::Zero());
    world.set_gravity({0, 0, -9.81});
    for (int k = 0; k < rounds(500); ++k) CHECK(world.step(5e-4).solve.converged);
    const auto& pose = world.pose(grain);
    CHECK((pose.position - start.position).norm() < 1e-5);
    CHECK(pose.rotation.angularDistance(start.rotation) < 1e-3);
    CHECK(world.bodies().velocity[grain.index()].norm() < 1e-4);
  }
}

TEST_CASE("it comes to rest in a heap between walls") {
  World world(0.02, Materials<Law>(1, Law(0.4)));
  const ShapeId shape = world.add_shape({{0.012, 0.01, 0.008}, 4});
  for (int k = 0; k < 8; ++k)
    world.add_grain(
        shape,
        {V(0.015 + 0.026 * (k % 2), 0.015 + 0.026 * (k / 2 % 2), 0.015 + 0.03 * (k / 4)),
         S::exp(V(0.3 * k, 0.2, 0.1 * k))},
        2700);
  for (int axis = 0; axis < 3; ++axis) world.add_wall(V::Unit(axis), V::Zero());
  for (int axis = 0; axis < 2; ++axis) world.add_wall(-V::Unit(axis), 0.056 * V::Unit(axis));
  world.set_gravity({0, 0, -9.81});
  double overlap = 0, speed = 0;
  for (int k = 0; k < rounds(2000); ++k) overlap = std::max(overlap, world.step(5e-4).max_overlap);
  for (const BodyId grain : world.grains()) {
    speed = std::max(speed, world.velocity(grain).norm());
    CHECK(world.pose(grain).position.minCoeff() > 0.006);
  }
  CHECK(overlap < 1e-2 * 0.02);
  if (sanitizer_share == 1) CHECK(speed < 0.02);
}

}  // namespace
