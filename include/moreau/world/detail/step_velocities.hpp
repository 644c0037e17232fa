// SPDX-License-Identifier: MIT
// The velocities of the bodies in a step (stages 2 and 9 of impulse_dynamics.hpp), and relative velocities of contacts that follow
// from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/detail/cell/cell_jumps.hpp"
#include "moreau/world/detail/integrate.hpp"
#include "moreau/world/detail/step_context.hpp"

namespace moreau::detail {

/// One entry per body in each list; velocities are (v, w), world axes [m/s, rad/s].
template <class S, class Law>
struct StepVelocities {
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  using Twist = typename S::Twist;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;
  using Context = StepContext<S, Law>;

  List<Angular> momentum;       ///< angular, world axes [kg m^2/s]
  List<MobilityRoot<S>> roots;  ///< M^-1/2
  /// Before the step, with the spins of `momentum` in the configuration of the contacts: the inertia turns.
  List<Twist> before;
  List<Twist> free, after;  ///< without and with the impulses of the contacts
  List<Twist> unattracted;  ///< `free` without the attraction of the law, if it has one

  void resize(std::size_t bodies) {
    momentum.resize(bodies);
    before.resize(bodies);
    free.resize(bodies);
    after.resize(bodies);
    roots.resize(bodies);
  }
  /// Stage 2, without the attraction.
  void find_free(const auto& integrator, const Context& context, const Team& team) {
    const Bodies<S>& bodies = context.bodies;
    team.share_each(bodies.size(), 128, [&](std::size_t i) {
      roots[i] = bodies.mobility_root(i);
      before[i] = bodies.velocity[i];
      const typename S::Inertia& root = roots[i].angular;
      if (bodies.rotates(i))
        angular<S>(before[i]) = product(root, Angular(product(root, momentum[i])));
    });
    const std::span<Twist> of_free(free);
    free_velocity<S>(integrator, bodies, context.gravity, momentum, of_free, context.step, team);
    if (context.deforms())
      CellJumps<S>::turn_velocities(bodies, context.cell->rate(), context.step, of_free, team);
    if constexpr (AttractiveLaw<Law, S>) unattracted = free;
  }
  /// Sets the scales of errors of a problem: the rounding of `free`, and what the loads of the step add to the velocities.
  void find_scales(const Bodies<S>& bodies, auto& problem, const Team& team) const {
    using Scalar = typename S::Scalar;
    constexpr Scalar several = 8;
    const auto largest = [](const Vector& v) { return v.template lpNorm<Eigen::Infinity>(); };
    problem.rounding.resize(free.size());
    problem.load.resize(free.size());
    constexpr bool single = std::is_same_v<Scalar, float>;
    if constexpr (single) problem.free.resize(free.size());
    team.share_each(free.size(), 256, [&](std::size_t i) {
      const Vector v = free[i].template head<S::dim>();
      problem.rounding[i] = several * std::numeric_limits<Scalar>::epsilon() * largest(v);
      problem.load[i] = largest(v - bodies.velocity[i].template head<S::dim>());
      if constexpr (single) problem.free[i] = free[i];
    });
  }
  /// Stage 9: V = V_free and what the impulses have changed. Throws if a velocity is not finite.
  /// @param op        with the velocities of the impulses
  /// @param attracted whether the changes are those of the attraction in place of the operator's
  void find_after(const Operator& op, [[maybe_unused]] const auto& attraction,
                  [[maybe_unused]] bool attracted, const Team& team) {
    team.share_each(roots.size(), 256, [&](std::size_t i) {
      after[i] = free[i] + op.velocity_change(i);
      if constexpr (AttractiveLaw<Law, S>)
        if (attracted) after[i] = unattracted[i] + attraction.change_of(i);
      if (!all_finite(after[i]))
        throw_not_finite("Simulation::step", "velocity of body", i, after[i]);
    });
  }

  /// What the external forces of the step and the attraction add to the relative velocity of contact c, a row of the
  /// operator [m/s].
  /// @param earlier relative velocity before the step, contact frame [m/s]
  /// @param jumps   of the cell, if it deforms
  MOREAU_INLINED Row forced(const Context& context, std::size_t c, const Vector& earlier,
                            const CellJumps<S>& jumps, const Operator& op) const {
    const Contact<S>& contact = context.contacts.points[c];
    const std::uint32_t a = contact.a, b = contact.b;
    Vector change = relative_velocity(contact, free[a], free[b]);
    change -= earlier;
    if (context.deforms()) change += jumps[c];
    const Twist turn = (free[b] - before[b]) - (free[a] - before[a]);
    return op.row(c, change, angular<S>(turn));
  }
  /// The relative velocity of a contact if none that attracts bears anything, without its offset, a row of the operator
  /// [m/s].
  /// @param jumps of the cell, if it deforms
  Row unloaded(const Context& context, std::size_t c, const CellJumps<S>& jumps,
               const Operator& op) const {
    const Contact<S>& contact = context.contacts.points[c];
    const Twist &a = unattracted[contact.a], &b = unattracted[contact.b];
    Vector velocity = relative_velocity(contact, a, b);
    if (context.deforms()) velocity += jumps[c];
    return op.row(c, velocity, angular<S>(Twist(b - a)));
  }
};

}  // namespace moreau::detail
