// SPDX-License-Identifier: MIT
// The laws of the contacts in a step: stages 6 and 7 of impulse_dynamics.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/world/detail/cell/cell_jumps.hpp"
#include "moreau/world/detail/chord_velocities.hpp"
#include "moreau/world/detail/closing_contacts.hpp"
#include "moreau/world/detail/restitution_limit.hpp"
#include "moreau/world/detail/sliding_points.hpp"
#include "moreau/world/detail/step_context.hpp"

namespace moreau::detail {

/// Which law each contact has in a step, and what the laws add to the relative velocities.
template <class S, class Law>
class ContactLaws {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;
  using Problem = ContactProblem<Operator, Law>;
  using Context = StepContext<S, Law>;

  /// Fills the table of laws: the variants of the first law of the materials, then those of the second, ...
  /// It stays from step to step: the materials have a law for each pair of materials.
  void list_variants(const Context& context, Problem& problem) {
    problem.law_of.resize(context.contacts.size());
    if (is_listed_ && !problem.laws.empty()) return;
    is_listed_ = true;
    problem.laws.clear();
    const auto& laws = context.materials.laws();
    if constexpr (StaticFrictionLaw<Law, S>)
      has_static_friction_ = std::any_of(laws.begin(), laws.end(),
                                         [](const Law& law) { return law.has_static_friction(); });
    for (const Law& law : laws)
      if constexpr (stateful)
        for (std::size_t k = 0; k < Law::variants; ++k) problem.laws.push_back(law.variant(k));
      else
        problem.laws.push_back(law);
  }
  /// The next list_variants() fills the table again: the materials are others.
  void forget_variants() { is_listed_ = false; }
  /// Chooses the law of each contact, computes the relative velocities before the step and adds the
  /// offsets of the laws to b.
  /// @param velocities of the bodies before the step, in the configuration of the contacts [m/s, rad/s]
  /// @param pushes   p, see pushes.hpp; out: 0 where the law says that the contact cannot act
  /// @param gap_of   function: contact -> its gap, with the overlap correction [m]
  /// @param jumps    of the cell, if it deforms
  /// @returns the largest approach velocity before the step, >= 0 [m/s]
  Scalar offset_velocities(const Context& context, std::span<const typename S::Twist> velocities,
                           Problem& problem, std::span<Row> pushes, const auto& gap_of,
                           const CellJumps<S>& jumps, const Team& team) {
    before_.resize(context.contacts.size());
    limit_.resize(context.contacts.size());
    [[maybe_unused]] Scalar* gap_velocity = nullptr;
    if constexpr (has_gap_velocity) {
      problem.gap_velocity.resize(context.contacts.size());
      gap_velocity = problem.gap_velocity.data();
    }
    // By value: a reference would be read again for every contact.
    const Contact<S>* const points = context.contacts.points.data();
    const Law* const laws = context.materials.laws().data();
    Vector* const velocity_before = before_.data();
    const CellJumps<S>* const cell = context.deforms() ? &jumps : nullptr;
    return sum_of<Largest>(
               team, context.contacts.size(),
               [=, this, &context, &problem, &gap_of](Largest& fastest, std::size_t c) {
                 const Contact<S>& contact = points[c];
                 const Law& law = laws[contact.law];
                 problem.law_of[c] = law_of(context.contacts, c);
                 Vector before =
                     relative_velocity(contact, velocities[contact.a], velocities[contact.b]);
                 if (cell) before += (*cell)[c];
                 velocity_before[c] = before;
                 fastest.add({-before[0]});
                 const Scalar approach =
                     before[0] - add_chord(problem.delassus, context, c, before);
                 const Scalar free = problem.delassus.free_velocity(c)[0];
                 const auto closing = closing_of(context, gap_of, c, law, approach, free);
                 const Scalar offset =
                     law.velocity_offset(closing.gap, approach, context.step) + closing.offset;
                 limit_.set(c, law, closing.gap, approach, context.step, offset - closing.offset,
                            closing.offset);
                 if constexpr (TangentialRestitutionLaw<Law, S>)
                   bounce_aside(problem, c, law, closing.gap, approach);
                 if (!std::isfinite(offset)) pushes[c].setZero();
                 if constexpr (has_gap_velocity) gap_velocity[c] = std::max(Scalar(0), offset);
                 problem.delassus.offset_normal(c, offset);
               })
        .value;
  }
  /// Chooses the variants of the next step.
  /// @param pushes   p of the solution, see pushes.hpp
  /// @param accuracy tolerance of the solver; 0: it does not say
  template <
      class Contacts>  // clang would instantiate a function that is no template with the class
  void choose_variants([[maybe_unused]] const Problem& problem, const Materials<Law>& materials,
                       Contacts& contacts, [[maybe_unused]] std::span<const Row> pushes,
                       [[maybe_unused]] double accuracy) const {
    if constexpr (stateful) {
      const std::span<const Law> laws(materials.laws());
      for (std::size_t c = 0; c < contacts.size(); ++c)
        contacts.variants[c] =
            static_cast<std::uint32_t>(laws[contacts.points[c].law].variant_after(
                contacts.variants[c], Vector(pushes[c].template head<S::dim>())));
      if constexpr (StaticFrictionLaw<Law, S>)
        if (has_static_friction_) hold(problem, laws, contacts, pushes, accuracy);
    }
  }

  /// Relative velocity of each contact before the step, with that of the cell, contact frame [m/s].
  std::span<const Vector> velocities_before() const { return before_; }
  /// Adds the velocities of the cell to velocities_before() once more.
  void add_jumps(const CellJumps<S>& jumps) {
    for (std::size_t c = 0; c < before_.size(); ++c) before_[c] += jumps[c];
  }
  /// The limit of the restitution, for the offsets of the step.
  RestitutionLimit<S, Law>& limit() { return limit_; }

 private:
  static constexpr bool stateful = StatefulLaw<Law, S>;
  static constexpr bool has_gap_velocity = CoulombLaw<Law, S> || RollingCoulombLaw<Law, S>;
  struct Largest {
    Scalar value = 0;
    void add(const Largest& other) { value = std::max(value, other.value); }
  };

  /// Gives the contacts that do not slide the variant at rest.
  template <class Contacts>
  MOREAU_COLD static void hold(const Problem& problem, std::span<const Law> laws,
                               Contacts& contacts, std::span<const Row> pushes, double accuracy) {
    const auto at_rest = [&](std::size_t c) {
      return static_cast<std::uint32_t>(
          laws[contacts.points[c].law].variant_at_rest(contacts.variants[c]));
    };
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      last = end_of_pair(contacts, first);
      std::size_t c = first;
      while (c < last && contacts.variants[c] == at_rest(c)) ++c;
      if (c == last) continue;
      const SlidingPoints<Operator, Law> points(problem, pushes, accuracy, first, last);
      for (; c < last; ++c)
        if (!points.slides(contacts, c)) contacts.variants[c] = at_rest(c);
    }
  }
  /// Index into the table of laws.
  static std::uint32_t law_of(const ContactsOf<Law, S>& contacts, std::size_t c) {
    const std::uint32_t law = contacts.points[c].law;
    if constexpr (stateful)
      return law * static_cast<std::uint32_t>(Law::variants) + contacts.variants[c];
    else
      return law;
  }
  /// Adds beta0 u_t^- of an impact to u_t.
  /// @param approach u_n before the step, without the chord of a turning wall [m/s]
  template <class L>  // explicit instantiations would instantiate a function that is no template
  void bounce_aside(Problem& problem, std::size_t c, const L& law, Scalar gap, Scalar approach) {
    Row aside = law.tangential_share(gap, approach) * problem.delassus.turned(c, before_[c]);
    aside[0] = 0;
    problem.delassus.offset(c, aside);
    limit_.set_aside(c, aside);
  }

  RestitutionLimit<S, Law> limit_;
  List<Vector> before_;     // one per contact
  bool is_listed_ = false;  // whether the problem has the table of the present materials
  bool has_static_friction_ = false;
};

}  // namespace moreau::detail
