// SPDX-License-Identifier: MIT
// The part of a step around the contacts, for laws that give forces (molecular dynamics):
// predict -> (detect) -> forces -> advance.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "moreau/body/bodies.hpp"
#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/effective_radius.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// Takes the solver's place where there is nothing to solve: under a regularized law.
struct NoSolver {};

namespace detail {

template <class S, class Law, class Integrator>
class ForceDynamics {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;

  explicit ForceDynamics(const Integrator& integrator = Integrator{}) : integrator_(integrator) {}

  /// Whether the forces at hand belong to the bodies as they are.
  bool is_ready(std::size_t bodies) const { return loads_.size() == bodies; }
  void forget() { loads_.clear(); }

  void predict(Bodies<S>& bodies, const Vector& gravity, Scalar step) {
    integrator_.predict_configuration(bodies, std::span<const Twist>(loads_), gravity, step);
  }

  /// Forces of the contacts as the bodies stand; impulses become force x step.
  /// @param elapsed time since the last evaluation [s]: how far tangential springs stretched
  void evaluate(const Bodies<S>& bodies, const Materials<Law>& materials,
                const Contacts<S>& previous, Contacts<S>& contacts, Scalar step, Scalar elapsed,
                StepReport& report) {
    loads_.assign(bodies.size(), Twist::Zero());
    report.warm_started = carry(previous, contacts, memory_, next_);
    memory_.swap(next_);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const ContactMotion<S> motion = motion_of(bodies, contact, elapsed);
      const Vector force = materials.laws()[contact.law].force(motion, memory_[c]);
      contacts.impulses[c] = step * force;
      report.dissipation -= double(contacts.impulses[c].dot(motion.velocity));
      report.friction -= double(contacts.impulses[c].template tail<S::dim - 1>().dot(
          motion.velocity.template tail<S::dim - 1>()));
      apply(contact, contact.frame * force);
    }
  }

  void advance(Bodies<S>& bodies, const Vector& gravity, Scalar step) {
    integrator_.advance_configuration(bodies, std::span<const Twist>(loads_), gravity, step);
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(integrator_, loads_, memory_); }

  static ContactMotion<S> motion_of(const Bodies<S>& bodies, const Contact<S>& contact,
                                    Scalar elapsed) {
    const std::uint32_t a = contact.a, b = contact.b;
    const Scalar inverse_mass = inverse_mass_along(bodies, a, contact.frame.col(0)) +
                                inverse_mass_along(bodies, b, contact.frame.col(0));
    return {contact.gap,
            BodyDelassus<S>::relative_velocity(contact, bodies.velocity[a], bodies.velocity[b]),
            inverse_mass > 0 ? 1 / inverse_mass : Scalar(0),
            effective_radius(contact, bodies.rotates(a), bodies.rotates(b)), elapsed};
  }
  static Scalar inverse_mass_along(const Bodies<S>& bodies, std::uint32_t i, const Vector& n) {
    return (bodies.axes(i).transpose() * n).cwiseAbs2().dot(bodies.inverse_mass[i]);
  }
  void apply(const Contact<S>& contact, const Vector& force) {
    loads_[contact.b].template head<S::dim>() += force;
    loads_[contact.b].template tail<S::angular_dim>() += S::moment(contact.lever_b, force);
    loads_[contact.a].template head<S::dim>() -= force;
    loads_[contact.a].template tail<S::angular_dim>() -= S::moment(contact.lever_a, force);
  }

  Integrator integrator_;
  std::vector<Twist> loads_;           ///< of the contacts on every body
  std::vector<Vector> memory_, next_;  ///< the law's, one per contact, in its frame
};

}  // namespace detail
}  // namespace moreau
