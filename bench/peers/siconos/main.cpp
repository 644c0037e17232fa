// SPDX-License-Identifier: MIT
// The contact solvers beside Siconos' non-smooth Gauss-Seidel (fc3d_nsgs) on the same problems in
// space, from the same impulses, on one thread. Siconos keeps its defaults, tolerance 1e-4 and 1000
// iterations at most, on a residual of its own; this library is asked for 1e-4, and once more for
// what Siconos' result has. The residual in the table is that of SolveReport, computed from the
// matrices by one function for all. Time is that of the process, the best of runs of half a second
// together, without handing the problem over. An argument selects the problems whose names have it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

#include "contact_problems/contact_problems.hpp"
#include "contact_problems/matrix_solvers.hpp"
#include "siconos_problem.hpp"

namespace {

using namespace moreau;
using contact_problems::Law;
using S = Space<3>;
using Problem = FrictionProblem<S>;
using Step = contact_problems::StepProblem<S>;

constexpr double tolerance = 1e-4;
constexpr int max_sweeps = 20000, siconos_iterations = 1000;
constexpr double least = 1e-12;     // of the residuals that are asked for: beyond is rounding
constexpr double max_seconds = 60;  // of the proximal point method

double process_seconds() {
  std::timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// How a solver ended, by its own account.
struct Ending {
  int sweeps;
  bool converged;
};

/// What the solvers make of one problem, a line each; times are compared with the first.
class Table {
 public:
  Table(const std::string& title, const Problem& problem) : problem_(problem) {
    std::printf("\n%s: %d points\n%-30s %12s %8s %8s %10s %10s\n", title.c_str(),
                int(problem.size()), "", "ms", "ratio", "sweeps", "residual", "converged");
  }

  /// @param solve leaves its impulses, 3 n, and returns an Ending
  /// @returns the residual
  double enter(const std::string& solver, const auto& solve) {
    constexpr double enough = 0.5;  // [s]
    double best = std::numeric_limits<double>::infinity();
    Eigen::VectorXd impulses;
    Ending ending{};
    for (double spent = 0; spent < enough;) {
      const double start = process_seconds();
      ending = solve(impulses);
      const double took = process_seconds() - start;
      best = std::min(best, took);
      spent += took;
    }
    if (first_ == 0) first_ = best;
    const double residual = contact_problems::residual(problem_, impulses);
    std::printf("%-30s %12.3f %8.3f %8d %10.1e %10s\n", solver.c_str(), 1e3 * best, best / first_,
                ending.sweeps, residual, ending.converged ? "yes" : "no");
    std::fflush(stdout);
    return residual;
  }

 private:
  const Problem& problem_;
  double first_ = 0;
};

/// @param enter_others(table, tolerance) the solvers of this library
void contest(const std::string& title, const Problem& problem, const Eigen::VectorXd& start,
             const auto& enter_others) {
  Table table(title, problem);
  peers::SiconosProblem siconos(problem);
  const double reached = table.enter("Siconos NSGS", [&](Eigen::VectorXd& impulses) {
    impulses = start;
    const auto [iterations, converged] = siconos.solve(impulses, tolerance, siconos_iterations);
    return Ending{iterations, converged};
  });
  enter_others(table, tolerance);
  enter_others(table, std::max(reached, least));
}

std::string titled(const char* solver, double asked) {
  char text[64];
  std::snprintf(text, sizeof text, "%s to %.1e", solver, asked);
  return text;
}

void contest(const std::string& name, const Problem& problem) {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.free_velocity.size());
  contest(name, problem, start, [&](Table& table, double asked) {
    const auto enter = [&](const char* solver_name, const auto& solver) {
      table.enter(titled(solver_name, asked), [&](Eigen::VectorXd& impulses) {
        impulses = start;
        const ProblemReport report = solver.solve(problem, impulses);
        return Ending{report.sweeps, report.converged};
      });
    };
    enter("blocks", contact_problems::BlockGaussSeidel{asked, max_sweeps});
    enter("proximal", contact_problems::Proximal{asked, max_sweeps, max_seconds});
  });
}

void contest(const std::string& name, const Step& step, const std::vector<S::Vector>& start) {
  const auto gathered = gather_problem(step.problem);
  const auto gather = [&](const std::vector<S::Vector>& impulses) {
    Eigen::VectorXd all(3 * gathered.problem.size());
    for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
      all.segment<3>(3 * Eigen::Index(k)) = impulses[gathered.contacts[k]];
    return all;
  };
  contest(name, gathered.problem, gather(start), [&](Table& table, double asked) {
    const auto enter = [&]<class Solver>(const char* solver_name, const Solver& solver) {
      typename Solver::template Workspace<BodyDelassus<S>, Law> workspace;
      ContactProblem<BodyDelassus<S>, Law> problem = step.problem;
      table.enter(titled(solver_name, asked), [&](Eigen::VectorXd& result) {
        std::vector<S::Vector> impulses = start;
        problem.delassus.clear();
        const SolveReport report = solver.solve(problem, std::span(impulses), workspace);
        result = gather(impulses);
        return Ending{report.sweeps, report.converged};
      });
    };
    enter("coloured", ColouredGaussSeidel({.tolerance = asked, .max_sweeps = max_sweeps}));
    enter("reference", NonlinearGaussSeidel({.tolerance = asked, .max_sweeps = max_sweeps}));
  });
}

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  for (const auto& problem : contact_problems::file_problems()) {
    if (problem.name.find(wanted) == std::string::npos) continue;
    if (const Problem* const in_space = std::get_if<Problem>(&problem.get()))
      contest(problem.name, *in_space);
  }
  for (const auto& problem : contact_problems::step_problems<Polyhedron<>>()) {
    const bool is_wanted =
        wanted.empty() ? !problem.is_large() : problem.name.find(wanted) != std::string::npos;
    if (!is_wanted) continue;
    const Step& step = problem.get();
    contest(problem.name + " from zero", step,
            std::vector<S::Vector>(step.guess.size(), S::Vector::Zero()));
    const bool is_warm = std::any_of(step.guess.begin(), step.guess.end(),
                                     [](const S::Vector& r) { return !r.isZero(0); });
    if (is_warm) contest(problem.name + " from the warm start", step, step.guess);
  }
  return 0;
}
