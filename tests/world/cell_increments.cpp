// SPDX-License-Identifier: MIT
// A cell at a rate that changes its numbers by less than a few multiples of their rounding per step.
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

// Euler's steps of both halves: F_00 = ((1 + x / 2) / (1 - x / 2))^n = exp(n x) but for n x^3 / 12.
TEST_CASE_TEMPLATE("a cell deforms by its rate, however small the step", ShapeT,
                   MOREAU_TYPES((Disk<float>), (Ball<float>, Disk<double>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Law = SignoriniCoulomb<T>;
  for (const double strain : {3e-8, 1e-6, 1.1e-5}) {
    CAPTURE(strain);
    // Nothing is in contact: the solver that takes least to compile.
    Simulation<ShapeT, Law, MoreauJean, CellGrid<S>, NonlinearGaussSeidel> world(
        T(0.02), Materials<Law>(1, Law(T(0.4))));
    const ShapeId shape = world.add_shape(ShapeT(T(0.01)));
    Pose<S> pose;
    pose.position.setConstant(T(0.05));
    world.add_grain(shape, pose, T(1000));
    const typename S::Matrix vectors = T(0.1) * S::Matrix::Identity();
    world.set_cell(vectors);
    CellControl<S> control;
    const double h = 1e-3;
    control.rate(0, 0) = T(strain / h);
    control.rate(0, 1) = T(-strain / h);
    world.control_cell(control);
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) world.step(T(h));
    const double should = std::expm1(steps * strain);
    // The numbers themselves have a rounding.
    const double rounding = double(std::numeric_limits<T>::epsilon()) + 1e-5 * should;
    const auto f = world.cell_motion().deformation();
    CHECK(std::abs(double(f(0, 0)) - 1 - should) < rounding);
    CHECK(std::abs(double(f(0, 1)) + should) < rounding);
    const auto now = world.cell().vectors();
    CHECK(std::abs(double(now(0, 0)) / double(vectors(0, 0)) - 1 - should) < rounding);
    CHECK(std::abs(double(now(0, 1)) / double(vectors(0, 0)) + should) < rounding);
  }
}
