// SPDX-License-Identifier: MIT
// Contact problems for the tests of solvers.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/core/list.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

#include "solve/plain_coulomb.hpp"

namespace solve_test {

using namespace moreau;

/// Chains of bodies that press on each other and on a fixed floor. Frames and levers are random, as
/// in a random packing. The first body touches more bodies than there are colours in the coloured
/// solver.
template <class S>
struct Assembly {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<T>;

  BodyDelassus<S> op;
  std::vector<Law> laws{Law(0), Law(T(0.3)), Law(T(0.6))};
  List<std::uint32_t> law_of;
  std::vector<Contact<S>> contacts;
  std::vector<MobilityRoot<S>> roots;
  std::vector<typename S::Twist> free;

  /// @param hub      mobility of the first body, relative to the mobility of the other bodies
  /// @param on_floor whether the first body touches the floor
  explicit Assembly(std::uint64_t seed, bool friction = true, T hub = T(0.1),
                    bool on_floor = true) {
    std::mt19937_64 random(seed);
    constexpr std::uint32_t count = 120, floor = count;
    const auto touch = [&](std::uint32_t a, std::uint32_t b) {
      add(a, b, b == floor, friction, random);
    };
    for (std::uint32_t a = 0; a < count; ++a) {
      if (a % 4 != 0 && a + 1 < count) touch(a, a + 1);
      if (a > 12 && a % 2 == 0) touch(0, a);
      if (a % 3 == 0 && (a > 0 || on_floor)) touch(a, floor);
    }
    assemble(count, hub, random);
  }
  /// A lattice of side x side bodies, each of which touches its neighbours, the lowest the floor. The
  /// first body touches every tenth body as well.
  static Assembly lattice(std::uint32_t side, std::uint64_t seed, T hub = T(0.02)) {
    Assembly made;
    std::mt19937_64 random(seed);
    const std::uint32_t count = side * side;
    for (std::uint32_t a = 0; a < count; ++a) {
      if (a == 0)
        for (std::uint32_t b = 10; b < count; b += 10) made.add(0, b, false, true, random);
      if (a > 0 && (a + 1) % side != 0) made.add(a, a + 1, false, true, random);
      if (a > 0 && a + side < count) made.add(a, a + side, false, true, random);
      if (a < side) made.add(a, count, true, true, random);
    }
    made.assemble(count, hub, random);
    return made;
  }

  /// A copy of the problem in the form that solvers take.
  ContactProblem<BodyDelassus<S>, Law> problem() const { return {op, laws, law_of}; }

  template <class Solver, class L>
  SolveReport solve(const Solver& solver, const std::vector<L>& table,
                    std::vector<Vector>& impulses) {
    impulses.resize(op.size(), Vector::Zero());
    typename Solver::template Workspace<BodyDelassus<S>, L> workspace;
    ContactProblem<BodyDelassus<S>, L> problem{std::move(op), table, law_of};
    const SolveReport report = solver.solve(problem, std::span(impulses), workspace);
    op = std::move(problem.delassus);
    return report;
  }
  SolveReport measure(const std::vector<Vector>& impulses) {
    detail::set_impulses(op, std::span<const Vector>(impulses));
    SolveReport report;
    measure_residual(problem(), std::span<const Vector>(impulses), report);
    return report;
  }

 private:
  Assembly() = default;
  /// One to three points between two bodies; b: the floor?
  void add(std::uint32_t a, std::uint32_t b, bool is_floor, bool friction,
           std::mt19937_64& random) {
    const auto vector = [&] {
      Vector v;
      for (int d = 0; d < S::dim; ++d) v[d] = unit_(random);
      return v;
    };
    const Vector n = (is_floor ? Vector(-Vector::Unit(S::dim - 1)) : vector()).normalized();
    const auto points = 1 + random() % 3;
    for (std::uint64_t p = 0; p < points; ++p) {
      const auto law = static_cast<std::uint32_t>(friction ? random() % laws.size() : 0);
      law_of.push_back(law);
      contacts.push_back(
          {a, b, law, T(0), S::contact_frame(n), n + T(0.4) * vector(), -n + T(0.4) * vector()});
    }
  }
  void assemble(std::uint32_t count, T hub, std::mt19937_64& random) {
    const std::uint32_t floor = count;
    roots.resize(count + 1);
    free.assign(count + 1, S::Twist::Zero());
    for (std::uint32_t i = 0; i < count; ++i) {
      const T light = i == 0 ? hub : T(1);
      roots[i].linear = S::Matrix::Identity() * light * (T(1) + T(0.5) * unit_(random));
      roots[i].angular = S::Inertia::Identity() * light * (T(1.5) + T(0.5) * unit_(random));
      for (int d = 0; d < S::dofs; ++d) free[i][d] = unit_(random);
    }
    roots[floor].linear.setZero();
    roots[floor].angular.setZero();
    op.assemble(contacts, roots, free);
  }

  std::uniform_real_distribution<T> unit_{-1, 1};
};

/// An Assembly under one law, which may have couples and springs.
template <class S, class Law>
struct AssemblyUnder {
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  ContactProblem<Operator, Law> problem;

  AssemblyUnder(std::uint64_t seed, const Law& law) {
    Assembly<S> points(seed);
    const std::vector<Row> compliance(CompliantLaw<Law, S> ? points.contacts.size() : 0,
                                      Row::Constant(typename S::Scalar(0.3)));
    problem.delassus.assemble(points.contacts, points.roots, points.free,
                              std::span<const Row>(compliance));
    problem.laws = {law};
    problem.law_of.assign(points.contacts.size(), 0);
  }
  template <class Solver>
  SolveReport solve(const Solver& solver, std::vector<Row>& impulses) {
    impulses.resize(problem.size(), Row::Zero());
    typename Solver::template Workspace<Operator, Law> workspace;
    return solver.solve(problem, std::span(impulses), workspace);
  }
  SolveReport measure(const std::vector<Row>& impulses) {
    detail::set_impulses(problem.delassus, std::span<const Row>(impulses));
    SolveReport report;
    measure_residual(problem, std::span<const Row>(impulses), report);
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

}  // namespace solve_test
