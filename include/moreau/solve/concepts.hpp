// SPDX-License-Identifier: MIT
// What a simulation asks of a solver.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/rolling_delassus.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

/// The operator u = W r + b of a step's contacts as a solver gets it: rows of impulses, or of
/// impulses and couples for a law that rolls.
template <class Law, class S>
using OperatorOf = std::conditional_t<RollingLaw<Law, S>, RollingDelassus<S>, BodyDelassus<S>>;

/// Finds the impulses of all contacts.
///
/// - Workspace<Operator, Law>: its buffers, made empty and kept from step to step
/// - solve(op, laws, law_of, impulses, workspace): impulses [N s] that with u = op r + b obey
///   laws[law_of[c]] at every contact c, each in its frame, normal first. They come in as a warm
///   start; op is left with the velocities that those which go out make. Not converging is no
///   error: the report says so.
template <class V, class Law, class S>
concept ContactSolver = SetValuedLaw<Law, S> && std::copyable<V> &&
    requires(const V solver, OperatorOf<Law, S>& op, std::span<const Law> laws,
             std::span<const std::uint32_t> law_of,
             std::span<typename OperatorOf<Law, S>::Vector> impulses,
             typename V::template Workspace<OperatorOf<Law, S>, Law>& workspace) {
  { solver.solve(op, laws, law_of, impulses, workspace) } -> std::same_as<SolveReport>;
};

}  // namespace moreau
