// SPDX-License-Identifier: MIT
// The part of a step around the contacts, for laws that give impulses (contact dynamics):
// predict -> (detect) -> overlap correction -> free velocity -> assemble -> warm start
// -> solve impulses -> advance.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/body/bodies.hpp"
#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/overlap_correction.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The unknowns of a law that acts at points: the impulses of the contacts themselves.
template <class S, class Law>
class PointUnknowns {
 public:
  using Operator = OperatorOf<Law, S>;

  static const BodyDelassus<S>& points(const Operator& op) { return op; }
  std::size_t start(const Operator&, const Contacts<S>& previous, Contacts<S>& contacts) {
    return warm_start(previous, contacts);
  }
  static std::span<typename S::Vector> impulses(Contacts<S>& contacts) { return contacts.impulses; }
  static void finish(const Operator&, Contacts<S>&) {}
};

/// The unknowns of a law with couples: impulses and couples / R in one vector.
template <class S, class Law>
class RollingUnknowns {
 public:
  using Operator = OperatorOf<Law, S>;

  static const BodyDelassus<S>& points(const Operator& op) { return op.points(); }
  std::size_t start(const Operator& op, const Contacts<S>& previous, Contacts<S>& contacts) {
    const std::size_t found = warm_start(previous, contacts);
    carry_couples(previous, contacts, previous.couples, contacts.couples);
    unknowns_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      unknowns_[c].template head<S::dim>() = contacts.impulses[c];
      unknowns_[c].template tail<S::angular_dim>() = contacts.couples[c] / op.radius(c);
    }
    return found;
  }
  std::span<typename Operator::Vector> impulses(Contacts<S>&) { return unknowns_; }
  void finish(const Operator& op, Contacts<S>& contacts) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      contacts.impulses[c] = unknowns_[c].template head<S::dim>();
      contacts.couples[c] = op.radius(c) * unknowns_[c].template tail<S::angular_dim>();
    }
  }

 private:
  std::vector<typename Operator::Vector> unknowns_;
};

/// The solver's, or nothing for one that cannot take the law; see policies.hpp.
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

template <class S, class Law, class Integrator, class Solver>
class ImpulseDynamics {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;
  using Unknowns =
      std::conditional_t<RollingLaw<Law, S>, RollingUnknowns<S, Law>, PointUnknowns<S, Law>>;
  using Operator = typename Unknowns::Operator;

  ImpulseDynamics(const Solver& solver, const OverlapCorrectionOptions& correction,
                  const Integrator& integrator)
      : solver_(solver), correction_(correction), integrator_(integrator) {}

  void set_solver(const Solver& solver) { solver_ = solver; }
  void set_correction(const OverlapCorrectionOptions& options) {
    correction_ = OverlapCorrection<S>(options);
  }
  const OverlapCorrection<S>& correction() const { return correction_; }

  /// To where contacts are detected.
  void predict(Bodies<S>& bodies, Scalar step) {
    momentum_.resize(bodies.size());
    free_.resize(bodies.size());
    after_.resize(bodies.size());
    roots_.resize(bodies.size());
    integrator_.predict_configuration(bodies, std::span(momentum_), step);
  }

  /// From the detected contacts to the end of the step.
  void advance(Bodies<S>& bodies, const Vector& gravity, const Materials<Law>& materials,
               const Contacts<S>& previous, Contacts<S>& contacts, Scalar grain_size, Scalar step,
               StepReport& report);

  /// visitor(operator, table of laws, entry of each contact) of the last step.
  decltype(auto) visit_problem(const Materials<Law>& materials, auto& visitor) const {
    return visitor(operator_, laws(materials), std::span<const std::uint32_t>(law_of_));
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(solver_, correction_, integrator_); }

  static constexpr bool stateful = StatefulLaw<Law, S>;

  /// What the attraction does to the bodies, as if it were an external force. It is that of the
  /// gaps as detected, although the correction of overlaps changes them afterwards.
  template <class L>  // not for laws without: clang would instantiate it with the class
  void attract(const Materials<L>& materials, const Contacts<S>& contacts, Scalar step) {
    pulls_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      pulls_[c] = step * materials.laws()[contact.law].attraction(contact.gap);
      if (pulls_[c] == 0) continue;
      const Vector pull = -pulls_[c] * contact.frame.col(0);
      pull_body(contact.b, contact.lever_b, pull);
      pull_body(contact.a, contact.lever_a, -pull);
    }
  }
  void pull_body(std::uint32_t i, const Vector& lever, const Vector& pull) {
    const MobilityRoot<S>& root = roots_[i];
    free_[i].template head<S::dim>() += root.linear * (root.linear * pull);
    free_[i].template tail<S::angular_dim>() +=
        root.angular * (root.angular * S::moment(lever, pull));
  }
  /// From the impulse on b to the push against the attraction (sign 1), or back (-1).
  void shift_impulses(Contacts<S>& contacts, Scalar sign) {
    const auto impulses = unknowns_.impulses(contacts);
    for (std::size_t c = 0; c < contacts.size(); ++c) impulses[c][0] += sign * pulls_[c];
  }

  /// The law of each contact in this step: that of its materials, or a variant of it.
  void choose_laws(const Materials<Law>& materials, Contacts<S>& contacts) {
    const auto impulses = unknowns_.impulses(contacts);
    law_of_.resize(contacts.size());
    if constexpr (stateful) {
      variants_.clear();
      for (const Law& law : materials.laws())
        for (std::size_t k = 0; k < Law::variants; ++k) variants_.push_back(law.variant(k));
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      law_of_[c] = contacts.points[c].law;
      if constexpr (stateful)
        law_of_[c] = static_cast<std::uint32_t>(
            law_of_[c] * Law::variants +
            materials.laws()[law_of_[c]].variant_after(typename S::Vector(impulses[c])));
    }
  }
  std::span<const Law> laws(const Materials<Law>& materials) const {
    return stateful ? std::span<const Law>(variants_) : std::span<const Law>(materials.laws());
  }

  /// Relative velocities before the step, and the law's offsets.
  void offset_velocities(const Bodies<S>& bodies, const Materials<Law>& materials,
                         Contacts<S>& contacts, Scalar step) {
    const auto impulses = unknowns_.impulses(contacts);
    before_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      before_[c] = BodyDelassus<S>::relative_velocity(contact, bodies.velocity[contact.a],
                                                      bodies.velocity[contact.b]);
      const Scalar offset =
          materials.laws()[contact.law].velocity_offset(contact.gap, before_[c][0], step);
      if (!std::isfinite(offset)) impulses[c].setZero();
      operator_.offset_normal(c, offset);
    }
  }

  void shift_bodies(Bodies<S>& bodies, const Vector& gravity, OverlapCorrectionReport& report) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Twist& shift = correction_.shifts()[i];
      const Vector move = shift.template head<S::dim>();
      const Vector force = bodies.force[i].template head<S::dim>() + bodies.weight[i] * gravity;
      report.work += double(force.dot(move));
      report.largest_shift = std::max(report.largest_shift, double(move.norm()));
      bodies.pose[i].position += move;
      bodies.pose[i].rotation =
          S::normalized(S::exp(shift.template tail<S::angular_dim>()) * bodies.pose[i].rotation);
    }
  }

  /// V = V_free + M^-1/2 y. Nothing has moved yet: what is not finite ends here.
  void velocities_after() {
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      const auto y = operator_.scaled_velocity(i);
      after_[i] = free_[i];
      after_[i].template head<S::dim>() += roots_[i].linear * y.template head<S::dim>();
      after_[i].template tail<S::angular_dim>() +=
          roots_[i].angular * y.template tail<S::angular_dim>();
      if (!after_[i].allFinite())
        throw_not_finite("Simulation::step", "velocity of body", i, after_[i]);
    }
  }
  /// The energy that the impulses took: -sum r . (u before + u after)/2, and so the couples.
  void measure_dissipation(const Bodies<S>& bodies, const Contacts<S>& contacts,
                           StepReport& report) const {
    constexpr int tangents = S::dim - 1;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const std::uint32_t a = contact.a, b = contact.b;
      const Vector& impulse = contacts.impulses[c];
      if (impulse.isZero(0)) continue;
      const Vector mean =
          (before_[c] + BodyDelassus<S>::relative_velocity(contact, after_[a], after_[b])) / 2;
      const double friction =
          -double(impulse.template tail<tangents>().dot(mean.template tail<tangents>()));
      report.friction += friction;
      report.dissipation += friction - double(impulse[0] * mean[0]);
      if (contacts.couples.empty()) continue;
      const Twist turn = (bodies.velocity[b] - bodies.velocity[a] + after_[b] - after_[a]) / 2;
      const double rolling = -double((S::angular_frame(contact.frame) * contacts.couples[c])
                                         .dot(turn.template tail<S::angular_dim>()));
      report.rolling += rolling;
      report.dissipation += rolling;
    }
  }

  Solver solver_;
  OverlapCorrection<S> correction_;
  Integrator integrator_;
  Operator operator_;
  Unknowns unknowns_;
  typename WorkspaceOf<Solver, Operator, Law>::type workspace_;

  std::vector<typename S::Angular> momentum_;
  std::vector<Twist> free_, after_;
  std::vector<MobilityRoot<S>> roots_;
  std::vector<Law> variants_;
  std::vector<std::uint32_t> law_of_;
  std::vector<Vector> before_;
  std::vector<Scalar> pulls_;  // impulses of the attraction, if there is any
};

// Outside of the class: compiled once where a program declares the dynamics extern.
template <class S, class Law, class Integrator, class Solver>
void ImpulseDynamics<S, Law, Integrator, Solver>::advance(Bodies<S>& bodies, const Vector& gravity,
                                                          const Materials<Law>& materials,
                                                          const Contacts<S>& previous,
                                                          Contacts<S>& contacts, Scalar grain_size,
                                                          Scalar step, StepReport& report) {
  for (std::size_t i = 0; i < bodies.size(); ++i) roots_[i] = bodies.mobility_root(i);
  integrator_.free_velocity(bodies, gravity, std::span(momentum_), std::span(free_), step);
  if constexpr (AttractiveLaw<Law, S>) attract(materials, contacts, step);
  operator_.assemble(contacts.points, roots_, free_);
  report.warm_started = unknowns_.start(operator_, previous, contacts);
  if constexpr (AttractiveLaw<Law, S>) shift_impulses(contacts, 1);
  choose_laws(materials, contacts);
  if (correction_.solve(Unknowns::points(operator_), contacts.points, roots_, grain_size,
                        report.correction))
    shift_bodies(bodies, gravity, report.correction);
  offset_velocities(bodies, materials, contacts, step);
  report.solve = solver_.solve(operator_, laws(materials), std::span<const std::uint32_t>(law_of_),
                               unknowns_.impulses(contacts), workspace_);
  report.solve.worst_gap = report.solve.worst_velocity * double(step);
  if constexpr (AttractiveLaw<Law, S>) shift_impulses(contacts, -1);
  unknowns_.finish(operator_, contacts);
  velocities_after();
  measure_dissipation(bodies, contacts, report);
  integrator_.advance_configuration(bodies, std::span<const Twist>(after_), step);
}

}  // namespace moreau::detail
