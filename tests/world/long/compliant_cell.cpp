// SPDX-License-Identifier: MIT
// A periodic cell that deforms, under compliant contacts: closed forms, and stresses that are prescribed.
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/law/compliant.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

using Law = Compliant<SignoriniCoulomb<>>;
constexpr double radius = 0.01, stiffness = 1e4;

ColouredGaussSeidel solver() {
  ColouredOptions options;
  options.tolerance = 1e-12;
  options.max_sweeps = 1000;
  return ColouredGaussSeidel(options);
}
/// Balls on a square (cubic) lattice.
template <class ShapeT>
Simulation<ShapeT, Law> lattice_of(int side, double spacing, double friction, double jitter) {
  using S = SpaceOf<ShapeT>;
  Simulation<ShapeT, Law> simulation(
      2 * radius, Materials<Law>(1, Law(SignoriniCoulomb<>(friction), stiffness, stiffness)),
      solver());
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> noise(-1, 1);
  const ShapeId ball = simulation.add_shape(ShapeT(radius)),
                small = simulation.add_shape(ShapeT(0.7 * radius));
  const int count = S::dim == 2 ? side * side : side * side * side;
  for (int k = 0; k < count; ++k) {
    Pose<S> pose;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side)
      pose.position[axis] = spacing * (rest % side + 0.5) + jitter * noise(random);
    simulation.add_grain(jitter > 0 && k % 2 == 0 ? small : ball, pose, 1000);
  }
  simulation.set_cell(side * spacing * S::Matrix::Identity());
  return simulation;
}

}  // namespace

TEST_CASE_TEMPLATE("affine compression of a lattice of balls has the stress of its springs", ShapeT,
                   Disk<>, Ball<>) {
  using S = SpaceOf<ShapeT>;
  const int side = 4;
  const double h = 1e-4, rate = 0.5;
  auto simulation = lattice_of<ShapeT>(side, 2 * radius, 0.3, 0);
  CellControl<S> control;
  control.rate = -rate * S::Matrix::Identity();
  simulation.control_cell(control);
  for (int k = 0; k < 100; ++k) {
    simulation.step(h);
    const double now = simulation.cell().vectors()(0, 0) / side;
    const double middle = now / (1 - h / 2 * rate);  // spacing at detection
    // A spring takes the overlap at the next detection (law/compliant.hpp).
    const double force = stiffness * (2 * radius - middle + h * rate * middle);
    const double stress = force * middle / std::pow(middle, S::dim);
    const auto& sigma = simulation.cell_motion().stress();
    CHECK((sigma - stress * S::Matrix::Identity()).norm() < 1e-9 * stress);
  }
  for (const BodyId grain : simulation.grains()) CHECK(simulation.velocity(grain).norm() < 1e-10);
}

TEST_CASE("a cell reaches prescribed stresses, at rest and sheared") {
  using S = Space<2>;
  const double h = 5e-4, pressure = 100;
  auto simulation = lattice_of<Disk<>>(7, 2.05 * radius, 0.3, 0.0005);
  double mass = 0;
  for (const double one : simulation.bodies().grain_mass) mass += one;
  CellControl<S> control;
  control.mass = 2 * mass * S::Matrix::Identity();
  control.stress = pressure * S::Matrix::Identity();
  control.damping = 20;
  simulation.control_cell(control);
  double work = 0, taken = 0, sheared = 0;
  const auto run = [&](int steps, const auto& use) {
    for (int k = 0; k < steps; ++k) {
      const StepReport report = simulation.step(h);
      work += report.cell_work;
      taken += report.dissipation + report.elastic_work;
      sheared += h * control.rate(0, 1) * simulation.cell_motion().deformation()(1, 1);
      use(simulation.cell_motion().stress());
    }
  };
  run(4000, [](const auto&) {});
  run(200, [&](const S::Matrix& sigma) {
    CHECK(sigma(0, 0) == doctest::Approx(pressure).epsilon(0.01));
    CHECK(sigma(1, 1) == doctest::Approx(pressure).epsilon(0.01));
  });
  double energy = 0;
  for (const BodyId grain : simulation.grains()) {
    const std::size_t i = grain.index();
    energy += simulation.bodies().grain_mass[i] * simulation.velocity(grain).squaredNorm() / 2 +
              simulation.bodies().inertia_body[i](0, 0) * simulation.spin(grain).squaredNorm() / 2;
  }
  CHECK(std::abs(work - taken - energy) < 1e-9 * work);

  // Its width stays, its height has the prescribed stress.
  control.mass(0, 0) = control.stress(0, 0) = 0;
  control.rate(0, 1) = 1;
  control.damping = 2;
  simulation.control_cell(control);
  S::Matrix mean = S::Matrix::Zero();
  run(2000, [](const auto&) {});
  run(6000, [&](const S::Matrix& sigma) { mean += sigma / 6000; });
  CHECK(mean(1, 1) == doctest::Approx(pressure).epsilon(0.02));
  CHECK(-mean(1, 0) / mean(1, 1) > 0.15);
  CHECK(-mean(1, 0) / mean(1, 1) < 0.6);
  CHECK(std::abs(mean(0, 1) - mean(1, 0)) < 0.02 * pressure);
  const auto& map = simulation.cell_motion().deformation();
  CHECK(map(0, 1) == doctest::Approx(sheared).epsilon(1e-3));  // dF_xy/dt = L_xy F_yy
  CHECK(map(0, 1) > 3.5 * map(1, 1));                          // the height fluctuates
}
