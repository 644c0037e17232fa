// SPDX-License-Identifier: MIT
// Problems given by the matrix W only. The results that the solver reports are checked
// independently.
#include "moreau/solve/proximal_solver.hpp"

#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/instances/friction_problems.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

using namespace moreau;

namespace {

/// Contacts between random pairs of a few bodies. The number of contacts is several times the rank
/// of W. If `skew` is not zero, W = J M^-1 J^T is not exactly symmetric, as in codes that compute
/// its two factors separately.
template <class S>
FrictionProblem<S> random_problem(std::uint64_t seed, int contacts, int bodies, double skew) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(S::dim * contacts, S::dofs * bodies);
  Eigen::VectorXd velocity(S::dofs * bodies);
  for (double& v : velocity) v = unit(random);
  FrictionProblem<S> problem;
  problem.friction.resize(contacts);
  for (int c = 0; c < contacts; ++c) {
    problem.friction[c] = c % 5 == 0 ? 0 : std::abs(unit(random));
    const int a = int(random() % std::uint64_t(bodies));
    for (const int body : {a, (a + 1) % bodies})
      for (int row = 0; row < S::dim; ++row)
        for (int k = 0; k < S::dofs; ++k) j(S::dim * c + row, S::dofs * body + k) = unit(random);
  }
  Eigen::MatrixXd other = j, w = Eigen::MatrixXd::Zero(j.rows(), j.rows());
  for (Eigen::Index k = 0; k < other.size(); ++k) other.data()[k] *= 1 + skew * unit(random);
  problem.free_velocity = Eigen::VectorXd::Zero(j.rows());
  for (Eigen::Index k = 0; k < j.cols(); ++k)
    for (Eigen::Index row = 0; row < j.rows(); ++row) {
      problem.free_velocity[row] += j(row, k) * velocity[k];
      for (Eigen::Index column = 0; column < j.rows(); ++column)
        w(row, column) += 1e-3 * j(row, k) * other(column, k);
    }
  problem.delassus = w.sparseView();
  return problem;
}

}  // namespace

TEST_CASE_TEMPLATE("hyperstatic problems are solved to the tolerance", S, Space<2>, Space<3>) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    const FrictionProblem<S> problem = random_problem<S>(seed, 60, 15, 0);
    Eigen::VectorXd r;
    const ProblemReport report = ProximalSolver().solve(problem, r);
    CHECK(report.converged);
    CHECK(report.residual == natural_map_residual(problem, r));
    CHECK(report.residual <= 1e-10);
  }
}

TEST_CASE_TEMPLATE("slightly asymmetric ones too", S, Space<2>, Space<3>) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    const FrictionProblem<S> problem = random_problem<S>(seed, 60, 15, 1e-3);
    Eigen::VectorXd r;
    CHECK(ProximalSolver().solve(problem, r).residual <= 1e-10);
  }
}

TEST_CASE("the residual does not depend on units; a solution is a fixed point") {
  FrictionProblem<Space<3>> problem = random_problem<Space<3>>(3, 30, 10, 0);
  Eigen::VectorXd r;
  ProximalSolver().solve(problem, r);
  Eigen::VectorXd again = r;
  const ProblemReport report = ProximalSolver().solve(problem, again);
  CHECK(report.sweeps == 0);
  CHECK(again == r);
  r *= 1.1;
  const double before = natural_map_residual(problem, r);
  problem.delassus *= 1024;
  r /= 1024;
  CHECK(natural_map_residual(problem, r) == doctest::Approx(before).epsilon(1e-12));
}

TEST_CASE("no contacts, no mobility, no solution: a report and no numbers that are not") {
  FrictionProblem<Space<3>> problem;
  Eigen::VectorXd r;
  CHECK(ProximalSolver().solve(problem, r).converged);
  CHECK(r.size() == 0);
  problem.delassus.resize(3, 3);
  problem.free_velocity = -Eigen::VectorXd::Unit(3, 0);
  problem.friction = Eigen::VectorXd::Constant(1, 0.5);
  ProximalOptions options;
  options.max_sweeps = 2000;
  const ProblemReport stuck = ProximalSolver(options).solve(problem, r);
  CHECK_FALSE(stuck.converged);
  CHECK(std::isfinite(stuck.residual));
  CHECK(r.allFinite());
  // Two contacts of one body that both approach. No velocity of the body satisfies both.
  problem.delassus.resize(6, 6);
  problem.free_velocity.setZero(6);
  problem.free_velocity[0] = problem.free_velocity[3] = -1;
  problem.friction = Eigen::VectorXd::Constant(2, 0.1);
  for (const int i : {0, 3})
    for (const int j : {0, 3}) problem.delassus.insert(i, j) = i == j ? 1 : -1;
  r.resize(0);
  const ProblemReport wedged = ProximalSolver(options).solve(problem, r);
  CHECK_FALSE(wedged.converged);
  CHECK(std::isfinite(wedged.residual));
  CHECK(r.allFinite());
}

TEST_CASE("bad problems and options are refused") {
  FrictionProblem<Space<2>> problem = random_problem<Space<2>>(1, 5, 4, 0);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(3);
  CHECK_THROWS_WITH_AS(ProximalSolver().solve(problem, r),
                       "ProximalSolver::solve: impulses.size() = 3 must be D times the contacts",
                       std::invalid_argument);
  r.resize(0);
  problem.friction[2] = -0.5;
  CHECK_THROWS_WITH_AS(ProximalSolver().solve(problem, r),
                       "ProximalSolver::solve: mu[2] = -0.5 must be finite and >= 0",
                       std::invalid_argument);
  problem.friction[2] = 0.5;
  problem.free_velocity[3] = std::nan("");
  CHECK_THROWS_AS(ProximalSolver().solve(problem, r), std::invalid_argument);
  problem.free_velocity.resize(4);
  CHECK_THROWS_AS(ProximalSolver().solve(problem, r), std::invalid_argument);
  ProximalOptions options;
  options.tolerance = 0;
  CHECK_THROWS_AS(ProximalSolver{options}, std::invalid_argument);
  options = {};
  options.max_seconds = -1;
  CHECK_THROWS_AS(ProximalSolver{options}, std::invalid_argument);
}

TEST_CASE_TEMPLATE("the problem of a step, gathered, has the step's solution", S, Space<2>,
                   Space<3>) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] {
    typename S::Vector v;
    for (double& x : v) x = unit(random);
    return v;
  };
  constexpr std::uint32_t bodies = 20;
  std::vector<MobilityRoot<S>> roots(bodies);
  std::vector<typename S::Twist> free(bodies);
  for (std::uint32_t i = 0; i < bodies; ++i) {
    roots[i].linear = S::Matrix::Identity() * (i == 0 ? 0. : 1 + 0.5 * unit(random));
    roots[i].angular = S::Inertia::Identity() * (i == 0 ? 0. : 1 + 0.5 * unit(random));
    for (double& x : free[i]) x = unit(random);
  }
  std::vector<Contact<S>> contacts;
  using Law = SignoriniCoulomb<double>;
  ContactProblem<BodyDelassus<S>, Law> step{{}, {Law(0.2), Law(0.7)}, {}};
  for (std::uint32_t i = 0; i < 40; ++i) {
    const typename S::Vector n = vector().normalized();
    step.law_of.push_back(i % 2);
    contacts.push_back({i % bodies, (7 * i + 3) % bodies, i % 2, 0., S::contact_frame(n),
                        n + 0.3 * vector(), -n + 0.3 * vector()});
  }
  step.delassus.assemble(contacts, roots, free);
  step.delassus.offset_normal(11, std::numeric_limits<double>::infinity());
  const auto gathered = gather_problem(step);
  CHECK(gathered.contacts.size() == 39);
  CHECK(gathered.contacts[11] == 12);

  GaussSeidelOptions options;
  options.tolerance = 1e-11;
  options.max_sweeps = 50000;
  std::vector<typename S::Vector> impulses(contacts.size(), S::Vector::Zero());
  CHECK(NonlinearGaussSeidel(options).solve(step, std::span(impulses)).converged);
  Eigen::VectorXd r(S::dim * 39);
  for (std::size_t k = 0; k < 39; ++k)
    r.template segment<S::dim>(S::dim * Eigen::Index(k)) = impulses[gathered.contacts[k]];
  CHECK(natural_map_residual(gathered.problem, r) <= 1e-10);
}
