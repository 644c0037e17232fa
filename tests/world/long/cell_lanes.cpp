// SPDX-License-Identifier: MIT
// The coloured sweeps of a cell that moves by its stress (solve/coloured/lane_cell.hpp) against the plain sweeps, which
// have the cell from the operator. A held grain makes groups whose impulses do not follow from the motion of a body.
#include <algorithm>
#include <cstddef>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<>;

/// Balls on a lattice, some of them held, under a stress.
template <class SimulationT, class ShapeT>
SimulationT cell(const auto& options, auto&& solver_of) {
  using S = SpaceOf<ShapeT>;
  const int side = S::dim == 2 ? 6 : 4;
  SimulationT simulation(1, Materials<Law>(1, Law(0.4)), solver_of(options));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> radius(0.35, 0.5), velocity(-1, 1);
  int count = 1;
  for (int axis = 0; axis < S::dim; ++axis) count *= side;
  for (int k = 0; k < count; ++k) {
    Pose<S> pose;
    typename S::Vector v;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side) {
      pose.position[axis] = 1.02 * (rest % side + 0.5);
      v[axis] = velocity(random);
    }
    const BodyId grain =
        simulation.add_grain(simulation.add_shape(ShapeT(radius(random))), pose, 1);
    if (k % 9 == 4)
      simulation.prescribe_motion(grain);
    else
      simulation.set_velocity(grain, v);
  }
  simulation.set_cell(1.02 * side * S::Matrix::Identity());
  CellControl<S> control;
  control.mass = 0.1 * count * S::Matrix::Identity();
  control.stress = 2 * S::Matrix::Identity();
  control.rate(0, 1) = 1;
  control.mass(0, 1) = 0;
  simulation.control_cell(control);
  return simulation;
}

}  // namespace

TEST_CASE_TEMPLATE("a cell under a stress: coloured sweeps have the motion of plain sweeps", ShapeT,
                   MOREAU_TYPES((Disk<>), (Ball<>))) {
  using S = SpaceOf<ShapeT>;
  using Coloured = Simulation<ShapeT, Law>;
  using Plain =
      Simulation<ShapeT, Law, MoreauJean, typename detail::DefaultPolicies<ShapeT, Law>::Broad,
                 NonlinearGaussSeidel>;
  ColouredOptions fast;
  fast.tolerance = 1e-12;
  fast.max_sweeps = 20000;
  GaussSeidelOptions slow;
  slow.tolerance = 1e-12;
  slow.max_sweeps = 100000;
  auto one = cell<Coloured, ShapeT>(fast, [](const auto& o) { return ColouredGaussSeidel(o); });
  auto two = cell<Plain, ShapeT>(slow, [](const auto& o) { return NonlinearGaussSeidel(o); });
  std::size_t points = 0;
  int unsolved = 0, held = 0;
  for (int k = 0; k < 100; ++k) {
    const StepReport a = one.step(5e-3), b = two.step(5e-3);
    REQUIRE(a.points == b.points);
    points += a.points;
    unsolved += !a.solve.converged + !b.solve.converged;
    for (std::size_t c = 0; c < one.contacts().size(); ++c)
      held += one.is_prescribed(one.bodies().id[one.contacts().points[c].b]);
  }
  CHECK(points > 1000);
  CHECK(held > 100);
  CHECK(unsolved == 0);
  double worst = 0;
  for (const BodyId grain : one.grains())
    worst = std::max(worst, (one.pose(grain).position - two.pose(grain).position).norm());
  CHECK(worst < 1e-8);
  CHECK((one.cell_motion().rate() - two.cell_motion().rate()).norm() < 1e-7);
  CHECK(one.cell_motion().rate()(1, 1) != 0);
  MESSAGE(S::dim, " dimensions: ", points, " points, ", held, " of held grains; difference ",
          worst);
}
