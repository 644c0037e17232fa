// SPDX-License-Identifier: MIT
// Contact problems with springs in series: every solver finds the same impulses from every start.
#include "moreau/law/compliant.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <span>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/proximal_fallback.hpp"

#include "solve/assembly.hpp"
#include "types.hpp"

using namespace solve_test;

namespace {

/// An Assembly whose contacts have springs. W_cc is about 2, so eps is about half of `compliance`.
template <class S>
struct CompliantAssembly {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Compliant<SignoriniCoulomb<T>>;
  using Operator = BodyDelassus<S, false, true>;

  ContactProblem<Operator, Law> problem;

  CompliantAssembly(std::uint64_t seed, T compliance, bool friction = true) {
    Assembly<S> rigid(seed, friction);
    Vector diagonal = Vector::Constant(T(0.8) * compliance);
    diagonal[0] = compliance;
    const std::vector<Vector> all(rigid.contacts.size(), diagonal);
    problem.delassus.assemble(rigid.contacts, rigid.roots, rigid.free,
                              std::span<const Vector>(all));
    for (const auto& law : rigid.laws) problem.laws.emplace_back(law, 1 / compliance);
    problem.law_of = rigid.law_of;
  }

  /// @param scale of the random impulses from which the solver starts [N s]
  template <class Solver>
  std::vector<Vector> solve(const Solver& solver, T scale, SolveReport& report) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<T> unit(-1, 1);
    std::vector<Vector> impulses(problem.delassus.size());
    for (Vector& r : impulses)
      for (T& x : r) x = scale * unit(random);
    typename Solver::template Workspace<Operator, Law> workspace;
    report = solver.solve(problem, std::span<Vector>(impulses), workspace);
    return impulses;
  }
};

template <class Vector>
double difference(const std::vector<Vector>& one, const std::vector<Vector>& other) {
  double square = 0, norm = 0;
  for (std::size_t c = 0; c < one.size(); ++c) {
    square += double((one[c] - other[c]).squaredNorm());
    norm += double(other[c].squaredNorm());
  }
  return std::sqrt(square / norm);
}

/// Solves an assembly by every solver from several starts.
/// @returns how many of the results differ from that of the reference by more than rounding and
///          40 tolerance / compliance
template <class S>
int other_answers(CompliantAssembly<S>& assembly, typename S::Scalar compliance) {
  using T = typename S::Scalar;
  const double tolerance = sizeof(T) == 8 ? 1e-10 : 3e-5;
  GaussSeidelOptions plain;
  plain.tolerance = tolerance;
  plain.max_sweeps = 20000;
  SolveReport report;
  const auto reference = assembly.solve(NonlinearGaussSeidel(plain), T(0), report);
  CHECK(report.converged);
  int others = 0;
  const auto check = [&](const auto& solver, T scale) {
    const auto found = assembly.solve(solver, scale, report);
    CHECK(report.converged);
    CHECK(report.residual <= tolerance);
    others += difference(found, reference) > 40 * tolerance / double(compliance);
    measure_residual(assembly.problem, std::span<const typename S::Vector>(found), report);
    CHECK(report.residual <= tolerance);
  };
  check(NonlinearGaussSeidel(plain), T(1));
  for (const bool accelerate : {false, true})
    for (const T scale : {T(0), T(1)})
      check(ColouredGaussSeidel(fast<S>(tolerance, accelerate)), scale);
  return others;
}

}  // namespace

// Without friction the problem is that of the minimum of a strictly convex function.
TEST_CASE_TEMPLATE("compliant: without friction every solver and every start give one answer", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  for (const T compliance : {T(0.3), T(0.03)})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      CompliantAssembly<S> assembly(seed, compliance, false);
      CHECK(other_answers(assembly, compliance) == 0);
    }
}

// Coulomb's law is not associated: springs alone do not make the answer unique. With soft springs it
// is, in these problems; with stiff springs some of them have several answers, which all satisfy the
// law to the tolerance.
TEST_CASE_TEMPLATE("compliant: with friction soft springs give one answer, stiff ones may not", S,
                   Space<2>, Space<3>) {
  int others = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CompliantAssembly<S> soft(seed, 0.3), stiff(seed, 0.03);
    CHECK(other_answers(soft, 0.3) == 0);
    others += other_answers(stiff, 0.03);
  }
  CHECK(others > 0);
}

TEST_CASE_TEMPLATE("compliant: the matrices of a problem have the compliance on their diagonal", S,
                   Space<2>, Space<3>) {
  CompliantAssembly<S> assembly(4, 0.1);
  SolveReport report;
  ColouredOptions options = fast<S>(1e-11);
  const auto found = assembly.solve(ColouredGaussSeidel(options), 0., report);
  CHECK(report.converged);
  const auto gathered = gather_problem(assembly.problem);
  Eigen::VectorXd r(S::dim * gathered.problem.size());
  for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
    r.segment<S::dim>(S::dim * Eigen::Index(k)) = found[gathered.contacts[k]];
  CHECK(natural_map_residual(gathered.problem, r) < 1e-10);
  const Eigen::SparseMatrix<double> w = gathered.problem.delassus;
  const Eigen::VectorXd x = Eigen::VectorXd::Random(w.cols());
  CHECK(x.dot(w * x) >= 0.08 * x.squaredNorm());
  // The proximal point method solves the same problem.
  options.max_sweeps = 3;
  const auto polished = assembly.solve(ProximalFallback<>(options), 0., report);
  CHECK(report.converged);
  CHECK(difference(polished, found) < 1e-8);
}
