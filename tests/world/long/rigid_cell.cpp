// SPDX-License-Identifier: MIT
// Rigid grains in a periodic cell that moves by its stress (world/detail/cell/cell_servo.hpp).
#include <cmath>
#include <doctest/doctest.h>
#include <type_traits>

#include "moreau/measure/energy_balance.hpp"

#include "types.hpp"
#include "world/gas_cell.hpp"

using namespace moreau;
using namespace gas_cell;

TEST_CASE_TEMPLATE("rigid grains under a prescribed stress jam and bear it, also sheared", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Disk<>, Polyhedron<>))) {
  using S = SpaceOf<ShapeT>;
  using Matrix = typename S::Matrix;
  const double pressure =
      S::dim == 2 ? 1e3 : 1e4;  // the inertial time d sqrt(rho / P) has some 30 steps
  // Spheres of one size form a crystal with many more contacts than it needs: 2 steps of 1,600 reach the cap.
  Gas<ShapeT> gas(std::is_same_v<ShapeT, Ball<>> ? 0.75 : 1);
  auto& simulation = gas.simulation;
  ColouredOptions options;
  options.tolerance = 1e-4;
  options.max_sweeps = 5000;
  simulation.set_solver(ColouredGaussSeidel(options));
  simulation.set_cell(Gas<ShapeT>::square());
  double mass = 0;
  for (const double one : simulation.bodies().grain_mass) mass += one;
  CellControl<S> control;
  control.mass = mass * Matrix::Identity();
  control.stress = pressure * Matrix::Identity();
  control.damping = 50;
  simulation.control_cell(control);
  EnergyBalance<S> energy(simulation);
  int unsolved = 0;
  double sweeps = 0, deepest = 0, worst = 0;
  Matrix mean = Matrix::Zero();
  const auto run = [&](int steps) {
    mean.setZero();
    for (int k = 0; k < steps; ++k) {
      const StepReport report = simulation.step(h);
      energy.add(simulation, report, h);
      unsolved += !report.solve.converged;
      sweeps += report.solve.sweeps;
      deepest = std::max(deepest, report.max_overlap);
      worst = std::max(worst, std::abs(energy.imbalance()));
      mean += simulation.cell_motion().stress() / steps;
    }
  };
  run(1500);
  run(100);
  for (int axis = 0; axis < S::dim; ++axis)
    CHECK(mean(axis, axis) == doctest::Approx(pressure).epsilon(0.01));
  CHECK(simulation.cell_motion().rate().norm() < 0.05);
  CHECK(simulation.contacts().size() > simulation.grain_count());
  MESSAGE((sweeps / 1600), " sweeps a step, ", unsolved, " steps unsolved");
  if constexpr (S::dim == 2) {
    control.rate(0, 1) = 2;
    simulation.control_cell(control);
    sweeps = 0;
    run(400);
    CHECK(-mean(1, 0) > 0.1 * mean(1, 1));
    CHECK(-mean(1, 0) < mean(1, 1));
    MESSAGE((sweeps / 400), " sweeps a step sheared, ", unsolved, " steps unsolved");
  }
  CHECK(unsolved == 0);
  CHECK(deepest < 0.05 * 0.016);
  CHECK(worst < 1e-9 * energy.terms().cell);
}
