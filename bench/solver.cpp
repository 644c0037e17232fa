// SPDX-License-Identifier: MIT
// Times the contact solvers on the problems of contact_problems/: time and sweeps to a given
// residual, and time per contact point and sweep. The creation of a problem is not timed. Every
// solution starts from the warm start of the step, or from zero if there is none. All solvers use
// the residual of SolveReport. The counter "converged" is 0 if the solver reached its cap, or if
// relative_approach exceeds its bound (SolveReport); the time is then not comparable.
#include <benchmark/benchmark.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/solve/proximal_fallback.hpp"

#include "contact_problems/contact_problems.hpp"
#include "contact_problems/matrix_solvers.hpp"

namespace {

using namespace moreau;
using contact_problems::Law;
using contact_problems::StepProblem;

constexpr int max_sweeps = 20000;
constexpr double max_seconds = 60;  // of the proximal point method

void count(benchmark::State& state, std::size_t points, const auto& report) {
  state.counters["points"] = double(points);
  state.counters["sweeps"] = report.sweeps;
  state.counters["residual"] = report.residual;
  state.counters["converged"] = report.converged;
  state.counters["per_point_sweep"] = benchmark::Counter(
      double(points) * report.sweeps,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Solver, class S>
void solve_step(benchmark::State& state, const StepProblem<S>& problem, const Solver& solver) {
  typename Solver::template Workspace<BodyDelassus<S>, Law> workspace;
  ContactProblem<BodyDelassus<S>, Law> step = problem.problem;
  std::vector<typename S::Vector> impulses;
  SolveReport report;
  for (auto _ : state) {
    impulses = problem.guess;
    step.delassus.clear();
    report = solver.solve(step, std::span(impulses), workspace);
  }
  count(state, step.size(), report);
  state.counters["relative_approach"] = report.relative_approach;
}

template <class Solver, class S>
void solve_matrices(benchmark::State& state, const FrictionProblem<S>& problem,
                    const Solver& solver) {
  Eigen::VectorXd impulses;
  ProblemReport report;
  for (auto _ : state) {
    impulses.setZero(problem.free_velocity.size());
    report = solver.solve(problem, impulses);
  }
  count(state, std::size_t(problem.size()), report);
}

/// "1e-4"
std::string text_of(int digits) {
  return "1e-" + std::to_string(digits);
}

template <class ShapeT>
void add_steps(const std::string& shape) {
  for (const auto& problem : contact_problems::step_problems<ShapeT>())
    for (const int digits : {3, 4, 6, 8}) {
      const auto add = [&](const std::string& name, const auto& solver) {
        const std::string title = shape + "/" + problem.name + "/" + name + "/" + text_of(digits);
        benchmark::RegisterBenchmark(title.c_str(), [problem, solver](benchmark::State& state) {
          solve_step(state, problem.get(), solver);
        })->Unit(benchmark::kMillisecond);
      };
      const double tolerance = std::pow(10., -digits);
      ColouredOptions options{.tolerance = tolerance, .max_sweeps = max_sweeps};
      add("coloured", ColouredGaussSeidel(options));
      options.accelerate = false;
      add("coloured_plain", ColouredGaussSeidel(options));
      add("reference", NonlinearGaussSeidel({.tolerance = tolerance, .max_sweeps = max_sweeps}));
      if (!problem.is_large())
        add("fallback", ProximalFallback<>({.tolerance = tolerance}, max_seconds));
    }
}

void add_files() {
  for (const auto& problem : contact_problems::file_problems())
    for (const int digits : {3, 4, 6, 8}) {
      const auto add = [&](const std::string& name, const auto& solver) {
        const std::string title = "file/" + problem.name + "/" + name + "/" + text_of(digits);
        benchmark::RegisterBenchmark(title.c_str(), [problem, solver](benchmark::State& state) {
          std::visit([&](const auto& p) { solve_matrices(state, p, solver); }, problem.get());
        })->Unit(benchmark::kMillisecond);
      };
      const double tolerance = std::pow(10., -digits);
      add("blocks", contact_problems::BlockGaussSeidel{tolerance, max_sweeps});
      add("proximal", contact_problems::Proximal{tolerance, max_sweeps, max_seconds});
    }
}

}  // namespace

int main(int argc, char** argv) {
  add_files();
  add_steps<Polyhedron<>>("polyhedra");
  add_steps<Polygon<>>("polygons");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  // Unless they are asked for, not those that take long to be made.
  const std::string filter = benchmark::GetBenchmarkFilter();
  benchmark::RunSpecifiedBenchmarks(filter.empty() ? "-large/" : filter);
  return 0;
}
