// SPDX-License-Identifier: MIT
// The simulations of these tests, compiled once, and the scenes that they start from: the same text in
// the plane and in space.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/distributed/distributed_simulation.hpp"
#include "moreau/distributed/reproducible_gauss_seidel.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace distributed_test {

using namespace moreau;

using Rigid = SignoriniCoulomb<>;
using Soft = Compliant<>;
using Rolling = RollingResistance<>;
using Polygons = Simulation<Polygon<>, Rigid>;
using Balls = Simulation<Ball<>, Rigid>;
using RollingBalls = Simulation<Ball<>, Rolling>;
using SoftPolyhedra = Simulation<Polyhedron<>, Soft>;
/// With the solver that has the same bits for any number of processes.
template <class ShapeT, class Law>
using Ordered =
    Simulation<ShapeT, Law, MoreauJean, CellGrid<SpaceOf<ShapeT>>, ReproducibleGaussSeidel>;
using OrderedPolygons = Ordered<Polygon<>, Rigid>;
using OrderedRollingBalls = Ordered<Ball<>, Rolling>;
using OrderedSoftPolyhedra = Ordered<Polyhedron<>, Soft>;

template <class World>
using ShapeIn = std::remove_cvref_t<decltype(std::declval<World&>().shape(ShapeId()))>;
template <class World>
using LawIn =
    typename std::remove_cvref_t<decltype(std::declval<World&>().materials().laws())>::value_type;
template <class World>
using SolverIn = std::conditional_t<std::is_same_v<World, Ordered<ShapeIn<World>, LawIn<World>>>,
                                    ReproducibleGaussSeidel, ColouredGaussSeidel>;

/// The rank of this process and the number of processes.
inline int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
inline int ranks() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

constexpr double size = 0.02;  // of the grains [m]
constexpr double step = 5e-4;  // [s]

/// An empty simulation. Overlaps are not corrected, so that the contact problem of a step depends on
/// the state before the step alone.
template <class World>
World empty_world(double tolerance = 1e-6) {
  using Law = LawIn<World>;
  typename SolverIn<World>::Options options;
  options.tolerance = tolerance;
  options.max_sweeps = 20000;
  const Law law = [] {
    if constexpr (std::is_same_v<Law, Soft>)
      return Soft(Rigid(0.4), 1e6);
    else if constexpr (std::is_same_v<Law, Rolling>)
      return Rolling(0.4, 0.1);
    else
      return Rigid(0.4);
  }();
  Tolerances tolerances;
  tolerances.narrows =
      false;  // as in several processes, whose contacts are compared with those of one
  World world(size, Materials<Law>(1, law), SolverIn<World>(options), tolerances);
  OverlapCorrectionOptions correction;
  correction.enabled = false;
  world.set_correction(correction);
  return world;
}

/// Cubes (in the plane squares) or balls of random size that fall into a box. One wall moves under a
/// force and its contacts.
template <class World>
World box_of_grains(std::size_t count, double tolerance = 1e-6, std::uint64_t seed = 1) {
  using S = typename World::S;
  using Vector = typename S::Vector;
  using ShapeT = ShapeIn<World>;
  constexpr int up = S::dim - 1;
  World world = empty_world<World>(tolerance);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<ShapeId> shapes;
  for (int k = 0; k < 5; ++k)
    shapes.push_back(world.add_shape(regular_shape<ShapeT>(size * (0.7 + 0.3 * part(random)))));
  const auto wide = std::size_t(std::round(std::pow(double(count) / 2, 1.0 / S::dim)));
  const double pitch = 1.3 * size;
  for (std::size_t k = 0; k < count; ++k) {
    Pose<S> pose;
    std::size_t rest = k;
    for (int axis = 0; axis < up; ++axis, rest /= wide)
      pose.position[axis] = pitch * (double(rest % wide) + 0.45 + 0.1 * part(random));
    pose.position[up] = pitch * (double(rest) + 0.5);
    pose.rotation = S::exp(S::Angular::Constant(part(random) - 0.5));
    world.add_grain(shapes[k % shapes.size()], pose, 2700);
  }
  const double length = pitch * double(wide);
  for (int axis = 0; axis < S::dim; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
  for (int axis = 0; axis < up; ++axis)
    world.add_wall(-Vector::Unit(axis), length * Vector::Unit(axis));
  const BodyId mover = world.walls().back();
  const double mass = world.bodies().grain_mass[0] * 20;
  world.set_wall_mass(mover, mass);
  world.set_force(mover, -20 * mass * Vector::Unit(up - 1));
  world.set_gravity(-9.81 * Vector::Unit(up));
  return world;
}

/// The scene on rank 0, an empty simulation on the other ranks.
template <class World, class Build>
World on_first_rank(const Build& build) {
  return rank() == 0 ? build() : empty_world<World>();
}

/// The residual and the other measures of the impulses of a step, by the code for one process: it
/// makes the contact problem of the step itself.
/// @param before the state before the step
/// @param after  the state after it, with the impulses that were found
template <class World>
SolveReport measured_on_one_rank(World before, const World& after) {
  using S = typename World::S;
  typename SolverIn<World>::Options options;
  options.max_sweeps = 1;
  before.set_solver(SolverIn<World>(options));
  before.step(after.time() - before.time());
  SolveReport report;
  const auto &mine = before.contacts(), &found = after.contacts();
  if (mine.keys != found.keys) {
    report.residual = INFINITY;
    return report;
  }
  auto problem = before.contact_problem();
  using Row = typename std::remove_cvref_t<decltype(problem)>::Vector;
  std::vector<Row> impulses;
  for (std::size_t c = 0; c < mine.size(); ++c) {
    Row& row = impulses.emplace_back();
    const typename S::Matrix &my_frame = problem.delassus.frame(c),
                             &found_frame = found.points[c].frame;
    linear<S>(row) = my_frame.transpose() * (found_frame * found.impulse(c));
    if constexpr (Rolls<LawIn<World>>)
      angular<S>(row) = S::angular_frame(my_frame).transpose() *
                        (S::angular_frame(found_frame) * found.couple(c)) /
                        problem.delassus.radius(c);
  }
  problem.delassus.clear();
  for (std::size_t c = 0; c < mine.size(); ++c) problem.delassus.apply(c, impulses[c]);
  measure_residual(problem, std::span<const Row>(impulses), report);
  return report;
}

/// The state of a simulation without the list of pairs, which a gathered one does not have.
template <class World>
std::string state(World& world) {
  detail::WorldParts<World> parts(world);
  parts.forget_pairs();
  return snapshot(world);
}

}  // namespace distributed_test

namespace moreau {
#ifdef MOREAU_DISTRIBUTED_INSTANTIATE
#define MOREAU_DISTRIBUTED_INSTANCE template
#else
#define MOREAU_DISTRIBUTED_INSTANCE extern template
#endif
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::Polygons>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::Balls>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::RollingBalls>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::SoftPolyhedra>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::OrderedPolygons>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::OrderedRollingBalls>;
MOREAU_DISTRIBUTED_INSTANCE class DistributedSimulation<distributed_test::OrderedSoftPolyhedra>;
MOREAU_DISTRIBUTED_INSTANCE StepReport Simulation<Polyhedron<>, Compliant<>>::step(double);
}  // namespace moreau
