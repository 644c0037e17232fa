// SPDX-License-Identifier: MIT
// The part of a step around the contacts, for laws that give forces (molecular dynamics):
//
//   1. predict the configuration at the end of the step; Simulation then detects the contacts
//   2. evaluate the forces of the contacts
//   3. advance the velocities to the end of the step
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>

#include "moreau/contact/effective_mass.hpp"
#include "moreau/contact/effective_radius.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

namespace detail {

template <class S, class Law, class Integrator>
class ForceDynamics {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;

  explicit ForceDynamics(const Integrator& integrator = Integrator{}) : integrator_(integrator) {}
  void set_integrator(const Integrator& integrator) { integrator_ = integrator; }

  /// Whether forces have been evaluated for as many bodies.
  bool has_loads_of(std::size_t bodies) const { return loads_.size() == bodies; }
  /// Removes the memory of contacts with removed grains.
  /// @param is_gone function: index of a contact -> whether it is removed
  void erase(const auto& is_gone) { erase_at(memory_, is_gone); }
  /// Whether the memory is that of as many contacts, after it was read from a file.
  bool is_valid(std::size_t contacts, std::size_t) const { return memory_.size() == contacts; }

  void predict(Bodies<S>& bodies, const Vector& gravity, Scalar step) {
    integrator_.predict_configuration(bodies, std::span<const Twist>(loads_), gravity, step);
  }

  /// Evaluates the forces of the contacts in the present configuration; writes force x step to the
  /// impulses of the contacts.
  /// @param elapsed time since the last evaluation [s], in which tangential springs stretched
  /// @param report  out: warm_started, approach; dissipation and friction are added to
  void evaluate(const StepContext<S, Law>& context, Scalar elapsed, StepReport& report) {
    const Bodies<S>& bodies = context.bodies;
    ContactsOf<Law, S>& contacts = context.contacts;
    loads_.assign(bodies.size(), Twist::Zero());
    const SpringTurn<S> turn{bodies.velocity, elapsed};
    report.warm_started = carry(context.previous, contacts, memory_, next_, turn);
    hand_over_stretches(context.previous, contacts, memory_, next_, turn);
    memory_.swap(next_);
    masses_.resize(contacts.size());
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      last = end_of_pair(contacts, first);
      find_effective_masses<S>(bodies, std::span(contacts.points).subspan(first, last - first),
                               std::span(masses_).subspan(first, last - first));
    }
    Scalar approach = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      ContactMotion<S> motion = motion_of(bodies, contact, masses_[c], elapsed);
      if (!context.chords.empty())
        motion.velocity += transposed_product(contact.frame, context.chords[c]);
      approach = std::max(approach, -motion.velocity[0]);
      const Vector force = context.materials.laws()[contact.law].force(motion, memory_[c]);
      contacts.impulses[c] = context.step * force;
      report.dissipation -= double(contacts.impulses[c].dot(motion.velocity));
      report.friction -= double(contacts.impulses[c].template tail<S::dim - 1>().dot(
          motion.velocity.template tail<S::dim - 1>()));
      apply(contact, contact.frame * force);
    }
    report.approach = double(approach * context.step / context.margin);
  }

  void advance(const StepContext<S, Law>& context) {
    integrator_.advance_configuration(context.bodies, std::span<const Twist>(loads_),
                                      context.gravity, context.step);
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(integrator_, loads_, memory_); }

  static ContactMotion<S> motion_of(const Bodies<S>& bodies, const Contact<S>& contact, Scalar mass,
                                    Scalar elapsed) {
    const std::uint32_t a = contact.a, b = contact.b;
    return {contact.gap, relative_velocity(contact, bodies.velocity[a], bodies.velocity[b]), mass,
            effective_radius(contact, bodies.grain_mass[a] > 0, bodies.grain_mass[b] > 0), elapsed};
  }
  void apply(const Contact<S>& contact, const Vector& force) {
    linear<S>(loads_[contact.b]) += force;
    angular<S>(loads_[contact.b]) += S::moment(contact.lever_b, force);
    linear<S>(loads_[contact.a]) -= force;
    angular<S>(loads_[contact.a]) -= S::moment(contact.lever_a, force);
  }

  Integrator integrator_;
  List<Twist> loads_;           ///< of the contacts on every body
  List<Scalar> masses_;         ///< effective mass of every contact [kg]
  List<Vector> memory_, next_;  ///< the law's, one per contact, in its frame
};

}  // namespace detail
}  // namespace moreau
