// SPDX-License-Identifier: MIT
// The contact solvers on the problem of one step of a packing under gravity and a side wall's
// force: time and sweeps to a residual, and time per contact point and sweep. The packing is made
// from a fixed seed, outside the timed loop; every solution starts from the warm start that the
// step had.
#include <benchmark/benchmark.h>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "moreau/contact/delassus.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

namespace {

using namespace moreau;
using Law = SignoriniCoulomb<double>;

/// One contact problem, as a solver gets it.
template <class S>
struct Problem {
  BodyDelassus<S> op;
  std::vector<Law> laws;
  std::vector<std::uint32_t> law_of;
  std::vector<typename S::Vector> guess;
};

/// A solver that keeps the last problem it was given.
struct Keeping : ColouredGaussSeidel {
  using ColouredGaussSeidel::ColouredGaussSeidel;
  void* kept = nullptr;

  template <class Operator, class L>
  SolveReport solve(Operator& op, std::span<const L> laws, std::span<const std::uint32_t> law_of,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, L>& workspace) const {
    if (kept) {
      auto& problem = *static_cast<Problem<typename Operator::Space>*>(kept);
      problem.op = op;
      problem.laws.assign(laws.begin(), laws.end());
      problem.law_of.assign(law_of.begin(), law_of.end());
      problem.guess.assign(impulses.begin(), impulses.end());
    }
    return ColouredGaussSeidel::solve(op, laws, law_of, impulses, workspace);
  }
};

/// Grains on a lattice fall into a box, then a wall presses from the side with ten weights.
template <class ShapeT>
Problem<SpaceOf<ShapeT>> settle(std::size_t count) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double radius = 0.0125, step = 2e-4, cell = 2.05 * radius;
  std::mt19937_64 random(1);
  const auto shapes = ballast_shapes<ShapeT>(30, random);
  Simulation<ShapeT, Law, MoreauJean, SweepAndPrune<S>, Keeping> world(
      2 * radius, Materials<Law>(1, Law(0.4)), Keeping(ColouredOptions{.max_sweeps = 200}));
  const auto side = static_cast<std::size_t>(std::ceil(std::pow(double(count), 1.0 / S::dim)));
  const double width = double(side) * cell;
  double mass = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Pose<S> pose;
    std::size_t place = i;
    for (int d = 0; d < S::dim; ++d) {
      pose.position[d] = (double(d == up ? place : place % side) + 0.5) * cell;
      place /= side;
    }
    typename S::Angular turn;
    for (auto& x : turn) x = std::uniform_real_distribution<double>(-3, 3)(random);
    pose.rotation = S::exp(turn);
    const auto body =
        world.add_grain(world.add_shape(shapes[i % shapes.size()].scaled(radius)), pose, 2700);
    mass += world.bodies().weight[body.index()];
  }
  BodyId wall;
  for (int d = 0; d < up; ++d) {
    world.add_wall(Vector::Unit(d), Vector::Zero());
    const BodyId far = world.add_wall(-Vector::Unit(d), width * Vector::Unit(d));
    if (d == 0) wall = far;
  }
  world.add_wall(Vector::Unit(up), Vector::Zero());
  world.set_gravity(-9.81 * Vector::Unit(up));
  for (int k = 0; k < 400; ++k) world.step(step);
  world.set_wall_mass(wall, mass);
  world.set_force(wall, -10 * mass * 9.81 * Vector::Unit(0));
  for (int k = 0; k < 200; ++k) world.step(step);
  Problem<S> problem;
  Keeping keeping(ColouredOptions{.max_sweeps = 200});
  keeping.kept = &problem;
  world.set_solver(keeping);
  world.step(step);
  return problem;
}

/// Settled once for all benchmarks of a size.
template <class ShapeT>
const Problem<SpaceOf<ShapeT>>& packing(std::size_t count) {
  static std::map<std::size_t, Problem<SpaceOf<ShapeT>>> settled;
  const auto found = settled.find(count);
  return found != settled.end() ? found->second
                                : settled.emplace(count, settle<ShapeT>(count)).first->second;
}

/// Arguments: grains, decimal digits of the residual.
template <class ShapeT, class Solver>
void to_residual(benchmark::State& state) {
  using S = SpaceOf<ShapeT>;
  const auto& problem = packing<ShapeT>(static_cast<std::size_t>(state.range(0)));
  typename Solver::Options options;
  options.tolerance = std::pow(10.0, -double(state.range(1)));
  options.max_sweeps = 20000;
  const Solver solver(options);
  typename Solver::template Workspace<BodyDelassus<S>, Law> workspace;
  BodyDelassus<S> op = problem.op;
  std::vector<typename S::Vector> impulses;
  SolveReport report;
  for (auto _ : state) {
    impulses = problem.guess;
    op.clear();
    report = solver.solve(op, std::span<const Law>(problem.laws),
                          std::span<const std::uint32_t>(problem.law_of), std::span(impulses),
                          workspace);
  }
  state.counters["points"] = double(op.size());
  state.counters["sweeps"] = report.sweeps;
  state.counters["residual"] = report.residual;
  state.counters["per_point_sweep"] = benchmark::Counter(
      double(op.size()) * report.sweeps,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

#define MOREAU_BENCH_SOLVER(shape, solver)       \
  BENCHMARK_TEMPLATE(to_residual, shape, solver) \
      ->ArgNames({"grains", "digits"})           \
      ->ArgsProduct({{300, 1200}, {3, 4, 6}})    \
      ->Unit(benchmark::kMillisecond)

MOREAU_BENCH_SOLVER(Polyhedron<>, ColouredGaussSeidel);
MOREAU_BENCH_SOLVER(Polyhedron<>, NonlinearGaussSeidel);
MOREAU_BENCH_SOLVER(Polygon<>, ColouredGaussSeidel);
MOREAU_BENCH_SOLVER(Polygon<>, NonlinearGaussSeidel);

}  // namespace

BENCHMARK_MAIN();
