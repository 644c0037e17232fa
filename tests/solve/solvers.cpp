// SPDX-License-Identifier: MIT
// Both solvers on random assemblies: what they claim is measured again, and they agree.
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/contact/delassus.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

using namespace moreau;

namespace {

/// A law that offers no more than the concept asks for.
template <class T>
struct PlainCoulomb {
  SignoriniCoulomb<T> law;

  T velocity_offset(T gap, T before, T step) const {
    return law.velocity_offset(gap, before, step);
  }
  template <class S>
  typename S::Vector solve(const LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const {
    return law.solve(block, b, guess);
  }
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    return law.natural_map(u, r);
  }
  template <class Vector>
  Vector project(const Vector& x) const {
    return law.project(x);
  }
};

/// Chains of bodies that push on one another and on a floor that does not move, with
/// frames and levers as a random packing has them; the first body, a heavy one, touches more
/// partners than there are colours.
template <class S>
struct Assembly {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<T>;

  BodyDelassus<S> op;
  std::vector<Law> laws{Law(0), Law(T(0.3)), Law(T(0.6))};
  std::vector<std::uint32_t> law_of;
  std::vector<Contact<S>> contacts;

  explicit Assembly(std::uint64_t seed, bool friction = true) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<T> unit(-1, 1);
    const auto vector = [&] {
      Vector v;
      for (int d = 0; d < S::dim; ++d) v[d] = unit(random);
      return v;
    };
    constexpr std::uint32_t count = 120, floor = count;
    const auto touch = [&](std::uint32_t a, std::uint32_t b) {
      const Vector n = (b == floor ? Vector(-Vector::Unit(S::dim - 1)) : vector()).normalized();
      const auto points = 1 + random() % 3;
      for (std::uint64_t p = 0; p < points; ++p) {
        const auto law = static_cast<std::uint32_t>(friction ? random() % laws.size() : 0);
        law_of.push_back(law);
        contacts.push_back(
            {a, b, law, T(0), S::contact_frame(n), n + T(0.4) * vector(), -n + T(0.4) * vector()});
      }
    };
    for (std::uint32_t a = 0; a < count; ++a) {
      if (a % 4 != 0 && a + 1 < count) touch(a, a + 1);
      if (a > 12 && a % 2 == 0) touch(0, a);
      if (a % 3 == 0) touch(a, floor);
    }
    std::vector<MobilityRoot<S>> roots(count + 1);
    std::vector<typename S::Twist> free(count + 1, S::Twist::Zero());
    for (std::uint32_t i = 0; i < count; ++i) {
      const T light = i == 0 ? T(0.1) : T(1);
      roots[i].linear = S::Matrix::Identity() * light * (T(1) + T(0.5) * unit(random));
      roots[i].angular = S::Inertia::Identity() * light * (T(1.5) + T(0.5) * unit(random));
      for (int d = 0; d < S::dofs; ++d) free[i][d] = unit(random);
    }
    roots[floor].linear.setZero();
    roots[floor].angular.setZero();
    op.assemble(contacts, roots, free);
  }

  template <class Solver, class L>
  SolveReport solve(const Solver& solver, const std::vector<L>& table,
                    std::vector<Vector>& impulses) {
    impulses.resize(op.size(), Vector::Zero());
    typename Solver::template Workspace<BodyDelassus<S>, L> workspace;
    return solver.solve(op, std::span<const L>(table), std::span<const std::uint32_t>(law_of),
                        std::span(impulses), workspace);
  }
  SolveReport measure(const std::vector<Vector>& impulses) {
    op.clear();
    for (std::size_t c = 0; c < op.size(); ++c) op.apply(c, impulses[c]);
    SolveReport report;
    measure_residual(op, std::span<const Law>(laws), std::span<const std::uint32_t>(law_of),
                     std::span<const Vector>(impulses), report);
    return report;
  }
};

template <class S>
ColouredOptions fast(double tolerance, bool accelerate = true) {
  ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 20000;
  options.accelerate = accelerate;
  return options;
}

}  // namespace

#define MOREAU_SPACES Space<2, double>, Space<3, double>, Space<2, float>, Space<3, float>

TEST_CASE_TEMPLATE("both solvers meet the tolerance they report", S, MOREAU_SPACES) {
  const double tolerance = sizeof(typename S::Scalar) == 8 ? 1e-9 : 3e-5;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Assembly<S> problem(seed);
    GaussSeidelOptions options;
    options.tolerance = tolerance;
    options.max_sweeps = 20000;
    std::vector<typename S::Vector> impulses;
    SolveReport report = problem.solve(NonlinearGaussSeidel(options), problem.laws, impulses);
    CHECK(report.converged);
    CHECK(problem.measure(impulses).residual <= tolerance);
    for (const bool momentum : {false, true}) {
      impulses.clear();
      report =
          problem.solve(ColouredGaussSeidel(fast<S>(tolerance, momentum)), problem.laws, impulses);
      CHECK(report.converged);
      CHECK_FALSE(report.capped);
      CHECK(report.residual == problem.measure(impulses).residual);
      CHECK(report.residual <= tolerance);
      CHECK(report.worst_cone <= tolerance);
    }
  }
}

TEST_CASE_TEMPLATE("without friction the velocities are unique and equal", S, Space<2>, Space<3>) {
  Assembly<S> problem(4, false);
  GaussSeidelOptions options;
  options.tolerance = 1e-12;
  options.max_sweeps = 100000;
  std::vector<typename S::Vector> reference, impulses;
  problem.solve(NonlinearGaussSeidel(options), problem.laws, reference);
  problem.measure(reference);
  std::vector<typename S::Vector> velocities;
  for (std::size_t c = 0; c < problem.op.size(); ++c) velocities.push_back(problem.op.velocity(c));
  problem.solve(ColouredGaussSeidel(fast<S>(1e-12)), problem.laws, impulses);
  for (std::size_t c = 0; c < problem.op.size(); ++c)
    CHECK((problem.op.velocity(c) - velocities[c]).norm() < 1e-7);
}

TEST_CASE_TEMPLATE("a law that does not know lanes is solved all the same", S, Space<2>, Space<3>) {
  Assembly<S> problem(5);
  std::vector<PlainCoulomb<double>> plain;
  for (const auto& law : problem.laws) plain.push_back({law});
  static_assert(!LaneLaw<PlainCoulomb<double>, S> && LaneLaw<SignoriniCoulomb<double>, S>);
  std::vector<typename S::Vector> impulses;
  const SolveReport report = problem.solve(ColouredGaussSeidel(fast<S>(1e-9)), plain, impulses);
  CHECK(report.converged);
  CHECK(problem.measure(impulses).residual <= 1e-9);
}

TEST_CASE_TEMPLATE("equal input gives equal bits, with fresh or used buffers", S, Space<2>,
                   Space<3>) {
  Assembly<S> problem(6), other(7);
  const ColouredGaussSeidel solver(fast<S>(1e-6));
  using Law = typename Assembly<S>::Law;
  ColouredGaussSeidel::Workspace<BodyDelassus<S>, Law> used;
  std::vector<typename S::Vector> impulses, again, scratch(other.op.size(), S::Vector::Zero());
  problem.solve(solver, problem.laws, impulses);
  solver.solve(other.op, std::span<const Law>(other.laws),
               std::span<const std::uint32_t>(other.law_of), std::span(scratch), used);
  again.resize(problem.op.size(), S::Vector::Zero());
  solver.solve(problem.op, std::span<const Law>(problem.laws),
               std::span<const std::uint32_t>(problem.law_of), std::span(again), used);
  for (std::size_t c = 0; c < impulses.size(); ++c) CHECK(impulses[c] == again[c]);
}

TEST_CASE("the cap is reported") {
  Assembly<Space<3>> problem(8);
  ColouredOptions options;
  options.tolerance = 1e-14;
  options.max_sweeps = 15;
  std::vector<Space<3>::Vector> impulses;
  const SolveReport report = problem.solve(ColouredGaussSeidel(options), problem.laws, impulses);
  CHECK(report.sweeps == 15);
  CHECK(report.capped);
  CHECK_FALSE(report.converged);
  CHECK(report.residual > 1e-14);
}

TEST_CASE("no contacts are solved at once; options out of range are refused") {
  BodyDelassus<Space<3>> op;
  using Law = SignoriniCoulomb<double>;
  ColouredGaussSeidel::Workspace<BodyDelassus<Space<3>>, Law> workspace;
  const SolveReport report =
      ColouredGaussSeidel().solve(op, std::span<const Law>(), std::span<const std::uint32_t>(),
                                  std::span<Space<3>::Vector>(), workspace);
  CHECK(report.converged);
  CHECK(report.sweeps == 0);
  ColouredOptions options;
  options.tolerance = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("tolerance"),
                       std::invalid_argument);
  options = {};
  options.max_sweeps = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("max_sweeps"),
                       std::invalid_argument);
  options = {};
  options.check_interval = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("check_interval"),
                       std::invalid_argument);
}
