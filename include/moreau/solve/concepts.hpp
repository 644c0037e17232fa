// SPDX-License-Identifier: MIT
// The requirements on a solver of the contact problem.
#pragma once

#include <concepts>
#include <span>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/contact.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

/// The operator u = W r + b of the contacts of a step: with couples for a law that rolls, and with W + D in
/// place of W for a law with springs in series.
template <class Law, class S>
using OperatorOf = BodyDelassus<S, RollingLaw<Law, S>, CompliantLaw<Law, S>>;

/// The contacts of a step under a law, set-valued or regularized: with couples for a law that rolls.
template <class Law, class S>
using ContactsOf = Contacts<S, RollingLaw<Law, S> ? S::dofs : S::dim>;

/// Finds the impulses of all contacts.
///
/// - Workspace<Operator, Law>: its buffers, default-constructed and kept from step to step
/// - solve(problem, impulses, workspace): the impulses [N s] that solve a ContactProblem, one per
///   contact, in its frame, normal first. On entry they are a warm start. On return the operator of
///   the problem carries their velocities. A solver that does not converge says so in its report;
///   this is no error.
template <class V, class Law, class S>
concept ContactSolver = SetValuedLaw<Law, S> && std::copyable<V> &&
    requires(const V solver, ContactProblem<OperatorOf<Law, S>, Law>& problem,
             std::span<typename OperatorOf<Law, S>::Vector> impulses,
             typename V::template Workspace<OperatorOf<Law, S>, Law>& workspace) {
  { solver.solve(problem, impulses, workspace) } -> std::same_as<SolveReport>;
};

namespace detail {

/// The workspace of a solver; empty for a solver that cannot take the law.
template <class Solver, class Operator, class Law>
struct WorkspaceOf {
  struct type {};
};
template <class Solver, class Operator, class Law>
requires requires {
  typename Solver::template Workspace<Operator, Law>;
}
struct WorkspaceOf<Solver, Operator, Law> {
  using type = typename Solver::template Workspace<Operator, Law>;
};

}  // namespace detail

}  // namespace moreau
