// SPDX-License-Identifier: MIT
// A periodic cell that deforms, in the stages of a step: the velocities that it adds at the contacts (cell_jumps.hpp)
// and, if it moves by its stress, the equation of its rate (cell_servo.hpp), which is solved with the contacts.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "moreau/law/concepts.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/world/detail/cell/cell_jumps.hpp"
#include "moreau/world/detail/cell/cell_servo.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// What a deforming cell does in a step; the functions stand in the order of their calls.
template <class S, class Law>
class CellEquation {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  using Twist = typename S::Twist;
  using Context = StepContext<S, Law>;

  /// Begins the step of a cell that deforms; adds the velocities of the cell to those of the operator.
  void start(const Context& context, auto& op, const Team& team) {
    servo_.start(*context.cell, context.bodies, context.step);
    jumps_.add(context.cell->rate(), context.contacts, op, team);
  }
  /// The velocities of the cell at the contacts.
  const CellJumps<S>& jumps() const { return jumps_; }
  /// Whether the stress moves the cell.
  bool moves(const Context& context) const { return context.deforms() && servo_.moves(); }
  /// Makes a cell that moves a body of the operator.
  /// @param pulls impulse of the attraction of each contact; empty: none attracts [N s]
  void join(const Context& context, [[maybe_unused]] std::span<const Scalar> pulls, auto& op) {
    Matrix moment = Matrix::Zero();
    if constexpr (AttractiveLaw<Law, S>)
      if (!pulls.empty())
        moment = CellJumps<S>::moment_of_contacts(
                     context.contacts,
                     [&](std::size_t c) { return Vector(-pulls[c] * Vector::Unit(0)); }, Scalar(1))
                     .template cast<Scalar>();
    servo_.set_rate(servo_.free(moment));
    jumps_.change(servo_.rate(), context.contacts, op);
    op.add_cell(servo_.response());
  }
  /// Takes the rate of the cell from the operator; its free velocities have it from then on.
  /// @param pushes p of the solution, see pushes.hpp
  void leave(const Context& context, const auto& pushes, auto& op) {
    op.move_cell(pushes);
    servo_.set_rate(servo_.rate() + op.cell_change());
    op.remove_cell();
    jumps_.change(servo_.rate(), context.contacts, op);
  }
  /// Measures the step.
  /// @param after  velocities after it, one per body
  /// @param report out: cell_work
  /// @returns V sigma, see world/cell_control.hpp [J]
  Matrix measure(const Context& context, std::span<const Twist> after, StepReport& report) const {
    if (context.deforms())
      report.cell_work = CellJumps<S>::work(context.bodies, context.contacts, after,
                                            context.cell->rate(), servo_.rate(), context.step);
    return CellJumps<S>::moment(context.bodies, context.contacts, after, context.step);
  }
  /// L after the step [1/s].
  const Matrix& rate() const { return servo_.rate(); }

 private:
  CellJumps<S> jumps_;
  CellServo<S> servo_;
};

}  // namespace moreau::detail
