// SPDX-License-Identifier: MIT
// Whole simulations against answers in closed form, each written once for plane and space.
#include <cmath>
#include <doctest/doctest.h>

#include "world/assemblies.hpp"

using moreau::BodyId;
using moreau::Polygon;
using moreau::Polyhedron;
using moreau::Space;
using moreau::Sphere;

namespace {

using Law = moreau::SignoriniCoulomb<double>;

moreau::ColouredOptions tight() {
  moreau::ColouredOptions options;
  options.tolerance = 1e-12;
  options.max_sweeps = 20000;
  return options;
}

/// One grain above a floor through the origin; gravity tilted by an angle towards +x.
template <class ShapeT>
struct OnFloor {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  scenes::World<ShapeT> simulation;
  BodyId grain;

  OnFloor(const ShapeT& shape, double height, const Law& law, double tilt = 0)
      : simulation(0.1, moreau::Materials<Law>(1, law), moreau::ColouredGaussSeidel(tight())) {
    moreau::Pose<S> pose;
    pose.position[up] = height;
    grain = simulation.add_grain(simulation.add_shape(shape), pose, 1000);
    simulation.add_wall(Vector::Unit(up), Vector::Zero());
    simulation.set_gravity(9.81 *
                           (std::sin(tilt) * Vector::UnitX() - std::cos(tilt) * Vector::Unit(up)));
  }
  double x() const { return simulation.bodies().pose[grain.index()].position[0]; }
  double z() const { return simulation.bodies().pose[grain.index()].position[up]; }
  double v() const { return simulation.bodies().velocity[grain.index()][0]; }
  typename S::Angular spin() const {
    return simulation.bodies().velocity[grain.index()].template tail<S::angular_dim>();
  }
};

}  // namespace

TEST_CASE_TEMPLATE(
    "block on an incline: sticks iff tan(tilt) <= mu, else slides at g (sin - mu cos)", ShapeT,
    Polyhedron<>, Polygon<>) {
  using Vector = typename OnFloor<ShapeT>::Vector;
  const ShapeT block = scenes::cuboid<ShapeT>(Vector::Constant(0.05));
  const double mu = 0.4;
  for (const double tilt : {std::atan(mu) - 1e-6, std::atan(mu) + 1e-6, 0.2, 0.5, 0.7}) {
    OnFloor<ShapeT> scene(block, 0.05, Law(mu), tilt);
    const double h = 1e-3;
    // Within a millionth of the friction angle the first steps from rest run into the cap on sweeps
    // (and say so); the acceleration is taken behind them.
    for (int k = 0; k < 50; ++k) scene.simulation.step(h);
    const double start = scene.v();
    for (int k = 0; k < 50; ++k) CHECK(scene.simulation.step(h).solve.converged);
    const double slides = std::max(0.0, 9.81 * (std::sin(tilt) - mu * std::cos(tilt)));
    CAPTURE(tilt);
    CHECK(std::abs((scene.v() - start) / (50 * h) - slides) < 1e-9);
    if (slides == 0) CHECK(std::abs(scene.v()) < 1e-9);
    CHECK(scene.spin().norm() < 1e-9);
  }
}

TEST_CASE_TEMPLATE("a sliding sphere (disk) comes to roll at 5/7 (2/3) of its speed", ShapeT,
                   Sphere<Space<3>>, Sphere<Space<2>>) {
  constexpr bool solid = OnFloor<ShapeT>::S::angular_dim == 3;
  const double v0 = 1, mu = 0.3, share = solid ? 5.0 / 7 : 2.0 / 3;
  const double roll_time = (solid ? 2.0 / 7 : 1.0 / 3) * v0 / (mu * 9.81);
  double errors[2];
  for (int refine = 0; refine < 2; ++refine) {
    OnFloor<ShapeT> scene(ShapeT(0.05), 0.05, Law(mu));
    scene.simulation.set_velocity(scene.grain, OnFloor<ShapeT>::Vector::UnitX());
    const double h = 1e-3 / (refine + 1);
    double start_of_roll = 0;
    while (scene.simulation.time() < 0.2) {
      scene.simulation.step(h);
      if (std::abs(scene.v() - 0.05 * scene.spin().norm()) > 1e-9)
        start_of_roll = scene.simulation.time();
    }
    CHECK(scene.v() == doctest::Approx(share * v0).epsilon(1e-9));
    errors[refine] = std::abs(start_of_roll - roll_time);
    CHECK(errors[refine] <= h * (1 + 1e-9));
  }
}

TEST_CASE_TEMPLATE("oblique impact of a sphere (disk): slips iff v_t/v_n is large", ShapeT,
                   Sphere<Space<3>>, Sphere<Space<2>>) {
  using Vector = typename OnFloor<ShapeT>::Vector;
  constexpr bool solid = OnFloor<ShapeT>::S::angular_dim == 3;
  const double mu = 0.3, e = 0.5, v_n = 1;
  for (const double v_t : {0.3, 1.0, 1.34, 1.36, 1.57, 1.58, 4.0}) {
    // Detection happens half a step later: there the gap is just closed, so the lever is the
    // radius.
    const double h = 1e-4;
    OnFloor<ShapeT> scene(ShapeT(0.05), 0.05 + v_n * h / 2 - 1e-13, Law(mu, e));
    scene.simulation.set_gravity(Vector::Zero());
    scene.simulation.set_velocity(scene.grain,
                                  v_t * Vector::UnitX() - v_n * Vector::Unit(OnFloor<ShapeT>::up));
    scene.simulation.step(h);
    const bool slips = v_t / v_n >= (solid ? 3.5 : 3) * mu * (1 + e);
    const double expected = slips ? v_t - mu * (1 + e) * v_n : (solid ? 5.0 / 7 : 2.0 / 3) * v_t;
    CAPTURE(v_t);
    CHECK(scene.v() == doctest::Approx(expected).epsilon(1e-10));
    CHECK(scene.simulation.bodies().velocity[scene.grain.index()][OnFloor<ShapeT>::up] ==
          doctest::Approx(e * v_n).epsilon(1e-10));
  }
}

TEST_CASE_TEMPLATE("a bouncing ball rests at sqrt(2 h0/g)(1+e)/(1-e), with an error of the step",
                   ShapeT, Sphere<Space<3>>, Sphere<Space<2>>) {
  const double e = 0.5, drop = 0.1;
  const double rest = std::sqrt(2 * drop / 9.81) * (1 + e) / (1 - e);
  for (const double h : {1e-3, 2.5e-4}) {
    OnFloor<ShapeT> scene(ShapeT(0.05), 0.05 + drop, Law(0, e));
    double last_motion = 0;
    while (scene.simulation.time() < 2 * rest) {
      scene.simulation.step(h);
      const auto& velocity = scene.simulation.bodies().velocity[scene.grain.index()];
      if (velocity.norm() > 9.81 * h) last_motion = scene.simulation.time();
    }
    CHECK(std::abs(last_motion - rest) < 15 * h);
  }
}

TEST_CASE_TEMPLATE("column: each contact carries the weight above it", ShapeT, Sphere<Space<3>>,
                   Sphere<Space<2>>, Polyhedron<>, Polygon<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int count = 6, up = S::dim - 1;
  const ShapeT shape = [] {
    if constexpr (std::is_constructible_v<ShapeT, double>)
      return ShapeT(0.05);
    else
      return scenes::cuboid<ShapeT>(Vector::Constant(0.05));
  }();
  scenes::World<ShapeT> simulation(0.1, moreau::Materials<Law>(1, Law(0.4)),
                                   moreau::ColouredGaussSeidel(tight()));
  const auto id = simulation.add_shape(shape);
  for (int k = 0; k < count; ++k) {
    moreau::Pose<S> pose;
    pose.position[up] = 0.05 + 0.1 * k;
    simulation.add_grain(id, pose, 1000);
  }
  simulation.add_wall(Vector::Unit(up), Vector::Zero());
  simulation.set_gravity(-9.81 * Vector::Unit(up));
  const double h = 1e-3;
  // From rest without a guess the first step takes some 7.5 N^2 sweeps and more.
  simulation.step(h);
  for (int k = 0; k < 9; ++k) CHECK(simulation.step(h).solve.converged);
  const double weight = simulation.bodies().weight[0] * 9.81;
  for (int k = 0; k < count; ++k) {
    double carried = 0;
    for (std::size_t c = 0; c < simulation.contacts().size(); ++c) {
      const auto& contact = simulation.contacts().points[c];
      const bool below = int(contact.a) == k - 1 && int(contact.b) == k;
      if (below || (k == 0 && int(contact.b) == count))
        carried += simulation.contacts().impulses[c][0];
    }
    CHECK(carried == doctest::Approx((count - k) * weight * h).epsilon(1e-8));
  }
}

TEST_CASE_TEMPLATE("a stack of boxes does not creep: ten seconds within the residual", ShapeT,
                   Polyhedron<>, Polygon<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  scenes::World<ShapeT> simulation(0.1, moreau::Materials<Law>(1, Law(0.4)),
                                   moreau::ColouredGaussSeidel(tight()));
  const auto id = simulation.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(0.05)));
  for (int k = 0; k < 3; ++k) {
    moreau::Pose<S> pose;
    pose.position[up] = 0.05 + 0.1 * k;
    simulation.add_grain(id, pose, 1000);
  }
  simulation.add_wall(Vector::Unit(up), Vector::Zero());
  // Tilted below the friction angle of 21.8 degrees.
  simulation.set_gravity(9.81 *
                         (std::sin(0.2) * Vector::UnitX() - std::cos(0.2) * Vector::Unit(up)));
  for (int k = 0; k < 2000; ++k) simulation.step(5e-3);
  for (int k = 0; k < 3; ++k) {
    CHECK(std::abs(simulation.bodies().pose[std::size_t(k)].position[0]) < 1e-5);
    CHECK(simulation.bodies().velocity[std::size_t(k)].norm() < 1e-8);
  }
}
