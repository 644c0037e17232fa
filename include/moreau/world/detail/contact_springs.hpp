// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/contact/warm_start.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/detail/cell/cell_jumps.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/step_report.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau::detail {

/// In place of the springs of a law that has none.
struct NoSprings {
  /// 0, of any row and of a scalar.
  struct Zero {
    template <class Row>
    operator Row() const {
      return Row::Zero();
    }
  };
  static Zero relaxation(std::size_t) { return {}; }
  static double energy_before(std::size_t) { return 0; }
  /// An empty span of any rows.
  struct NoRows {
    template <class Row>
    operator std::span<const Row>() const {
      return {};
    }
  };
  template <class S, class Law>
  static NoRows compliances(const StepContext<S, Law>&) {
    return {};
  }
  template <class S, class Law>
  static SpringTurn<S> turn(const StepContext<S, Law>&, const auto&) {
    return {};
  }
};

/// The springs of compliant contacts over a step: their compliance in units of the solver, their
/// memory of the step before, their energy. law/compliant.hpp has the equations.
template <class S, class Law>
class ContactSprings {
 public:
  using Scalar = typename S::Scalar;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  /// c = C / h^2 of every contact [1/kg]. The points of a pair share its stiffness: C is that of the
  /// pair times the number of its points. A point that is open by the gap g counts as 1 - g / l, so
  /// that the stiffness does not jump when a point comes near; l is the default margin (Tolerances), or
  /// the margin of the simulation if it is smaller.
  std::span<const Row> compliances(const StepContext<S, Law>& context) {
    const ContactsOf<Law, S>& contacts = context.contacts;
    compliance_.resize(contacts.size());
    const Scalar length = open_length(context);
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      const Contact<S>& point = contacts.points[first];
      const Scalar count = count_pair(contacts, first, last, length);
      const Law& law = context.materials.laws()[point.law];
      const Scalar share = count / (context.step * context.step);
      Row row = Row::Constant(share * law.tangential_compliance());
      row[0] = share * law.normal_compliance();
      std::fill(compliance_.begin() + std::ptrdiff_t(first),
                compliance_.begin() + std::ptrdiff_t(last), row);
    }
    return compliance_;
  }

  Scalar last_step() const {
    return last_step_;
  }  ///< length of the step before; 0 before the first [s]
  /// The integrator of a step, at most as far ahead of the start of the step as law/compliant.hpp says: with a larger
  /// theta where the step grows. One without with_theta() stays as it is.
  template <class Integrator>
  Integrator for_step(const Integrator& integrator, Scalar step) const {
    if constexpr (requires { integrator.with_theta(integrator.theta()); }) {
      const Scalar most = ahead_ + last_step_ / 2;
      if (last_step_ > 0 && (1 - Scalar(integrator.theta())) * step > most)
        return integrator.with_theta(1 - double(most) / double(step));
    }
    return integrator;
  }
  /// How springs turn since the detection of the step before: at the velocity after that step, over the rest of that step
  /// and the part of this one before its detection.
  /// @param theta of the integrator in this step
  SpringTurn<S> turn(const StepContext<S, Law>& context, Scalar theta) const {
    const Scalar rest = last_step_ > 0 ? last_step_ - ahead_ : Scalar(0);
    return {context.bodies.velocity, rest + (1 - theta) * context.step};
  }
  /// Makes the impulses of the step before those of the same forces over this step. With restitution, whose
  /// memory is the impulse, the springs of a pair keep their energy if their number changes, and so their
  /// stiffness: a force that stayed the same would make energy.
  /// @param impulses in: of the step before; out: s [N s]
  /// @param theta    of the integrator in this step
  void scale(const StepContext<S, Law>& context, std::span<Row> impulses, Scalar theta) {
    const Scalar ratio = last_step_ > 0 ? context.step / last_step_ : Scalar(1);
    const Scalar ahead = (1 - theta) * context.step;
    const bool changes = last_step_ > 0 && ahead != ahead_;
    now_ = changes ? ahead / context.step : Scalar(0);
    then_ = changes ? ahead_ / context.step : Scalar(0);
    last_step_ = context.step;
    ahead_ = ahead;
    for (Row& impulse : impulses) impulse *= ratio;
    const ContactsOf<Law, S>&now = context.contacts, &before = context.previous;
    const Scalar length = open_length(context);
    std::size_t old = 0, end = 0;
    for (std::size_t first = 0, last; first < now.size(); first = last) {
      const Scalar count = count_pair(now, first, last, length);
      while (old < before.size() && before.keys[old].bodies() < now.keys[first].bodies()) ++old;
      if (old == before.size() || before.keys[old].bodies() != now.keys[first].bodies()) continue;
      if (!context.materials.laws()[now.points[first].law].keeps_normal_impulse()) continue;
      const Scalar kept = std::sqrt(count_pair(before, old, end, length) / count);
      for (std::size_t c = first; c < last; ++c) impulses[c] *= kept;
    }
  }
  /// Adds to b the relaxation of the springs, -c s, and d / h, the correction for a step of another length
  /// (law/compliant.hpp).
  /// @param impulses s, attraction included [N s]
  /// @param jumps    of the cell, if it deforms; null: none
  void relax(const StepContext<S, Law>& context, std::span<const Row> impulses,
             const CellJumps<S>* jumps, Operator& op) {
    // Bodies that were added since have no springs yet.
    for (std::size_t i = last_.size(); i < context.bodies.size(); ++i)
      last_.push_back(context.bodies.velocity[i]);
    relaxation_.resize(impulses.size());
    before_.resize(impulses.size());
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      relaxation_[c] = relaxation_of(compliance_[c], impulses[c]);
      if ((now_ != 0 || then_ != 0) && !impulses[c].isZero(0))
        relaxation_[c] += missed_motion(context, c, jumps, op);
      const Contact<S>& point = context.contacts.points[c];
      Row stretch = relaxation_[c];
      if (!context.materials.laws()[point.law].keeps_normal_impulse()) {
        relaxation_[c][0] = 0;
        stretch[0] = std::min(Scalar(0), point.gap) / context.step;
      }
      before_[c] = double(stretch.dot(stretch.cwiseQuotient(compliance_[c]))) / 2;
      op.offset(c, relaxation_[c]);
    }
  }
  /// Ends the step.
  /// @param velocities of the bodies after the step [m/s, rad/s]
  void remember(const List<typename S::Twist>& velocities) { last_ = velocities; }
  /// -c s + d / h, part of b [m/s].
  const Row& relaxation(std::size_t c) const { return relaxation_[c]; }
  /// Energy of the springs of a contact before the step, with the stiffness of this one [J].
  double energy_before(std::size_t c) const { return before_[c]; }

  /// Energy of the springs, their largest compression, and the residual of the law without springs.
  /// @param problem  as solved
  /// @param impulses its solution [N s]
  /// @param pulls    impulse of the attraction of each contact [N s]: the springs of bonds bear what acts on the bodies
  /// @param shared   bodies that other processes share: rigid_residual is that of all contacts
  void measure(const StepContext<S, Law>& context, const ContactProblem<Operator, Law>& problem,
               std::span<const Row> impulses, std::span<const Scalar> pulls, StepReport& report,
               SharedBodies* shared = nullptr) {
    Energy energy;
    energies_.resize(impulses.size());
    if constexpr (BondingLaw<Law, S>) compressions_.resize(impulses.size());
    double sums[] = {0, 0};
    auto& [map, norm] = sums;
    const auto scale = static_cast<Scalar>(mean_diagonal(problem.delassus, shared));
    double stiffest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      const Contact<S>& point = context.contacts.points[c];
      const bool bonded = is_bonded(context.contacts, c);
      Row r = impulses[c];
      if (bonded) r[0] -= pulls[c];
      const Row stretch = compliance_[c].cwiseProduct(r);
      energies_[c] = Energy::of(r.cwiseProduct(stretch));
      if (bonded) {
        compressions_[c] = r[0] > 0 ? energies_[c].normal : 0;
        energies_[c] = {energies_[c].total(), 0, 0};
      }
      energy.add(energies_[c]);
      report.max_elastic_overlap =
          std::max(report.max_elastic_overlap, double(stretch[0] * context.step));
      Row u = problem.delassus.velocity(c) - stretch - relaxation_[c];
      if (!std::isfinite(u[0])) continue;
      if (r[0] > 0 || bonded) {
        const Scalar own = compliance_[c][0];
        // The difference of two near numbers, where springs are soft.
        const Scalar normal = problem.delassus.normal(c);
        const Scalar w = std::max(normal - own, std::numeric_limits<Scalar>::epsilon() * normal);
        stiffest = std::min(stiffest, double(own / w));
      }
      if (bonded) continue;
      if (!problem.law(c).keeps_normal_impulse())
        u[0] -= std::min(Scalar(0), point.gap) / context.step;
      if (r[0] == 0 && u[0] >= 0) continue;
      const Row scaled = r * scale;
      map += double(natural_map(problem.law(c), u, scaled, scale).squaredNorm());
      norm += double(scaled.squaredNorm());
    }
    if (shared) shared->sum(sums);
    report.rigid_residual = norm > 0 ? std::sqrt(map / norm) : std::sqrt(map);
    report.relative_compliance = std::isfinite(stiffest) ? stiffest : 0;
    report.elastic_energy = energy.total();
    report.elastic_work = energy.total() - energy_.total();
    report.friction -= energy.tangential - energy_.tangential;
    report.rolling -= energy.rolling - energy_.rolling;
    report.dissipation -= report.elastic_work;
    energy_ = energy;
  }

  double energy_after(std::size_t c) const { return energies_[c].total(); }  ///< of measure() [J]
  /// Removes the springs of a bond that broke in the step: their energy is dissipated, but that of a compression, which
  /// the contact of the pair takes over.
  /// @returns what is dissipated [J]
  double release(std::size_t c, StepReport& report) {
    const double energy = energies_[c].total() - compressions_[c];
    energies_[c] = {compressions_[c], 0, 0};
    energy_.normal -= energy;
    report.elastic_energy -= energy;
    report.elastic_work -= energy;
    report.dissipation += energy;
    return energy;
  }
  /// Removes the springs of contacts with removed grains: their energy leaves with the grains.
  /// @param is_gone function: index of a contact -> whether it is removed
  void erase(const auto& is_gone) {
    erase_at(energies_, is_gone);
    sum_energies();
  }
  /// Whether the springs are those of as many contacts, after they were read from a file.
  /// @param bodies how many there are
  bool are_valid(std::size_t contacts, std::size_t bodies) const {
    return energies_.size() == contacts && last_.size() <= bodies;
  }

 private:
  /// Energy of normal springs, of tangential springs and of those of rolling [J].
  struct Energy {
    double normal = 0, tangential = 0, rolling = 0;

    double total() const { return normal + tangential + rolling; }
    /// @param work impulse x stretch of one contact, by its rows
    MOREAU_COMPILED_ONCE static Energy of(const Row& work) {
      Energy energy;
      energy.normal = double(work[0]) / 2;
      energy.tangential = double(work.template segment<S::dim - 1>(1).sum()) / 2;
      if constexpr (RollingLaw<Law, S>) energy.rolling = double(angular<S>(work).sum()) / 2;
      return energy;
    }
    void add(const Energy& other) {
      normal += other.normal;
      tangential += other.tangential;
      rolling += other.rolling;
    }
    auto serialized_members() { return std::tie(normal, tangential, rolling); }
  };

  static bool is_bonded([[maybe_unused]] const ContactsOf<Law, S>& contacts,
                        [[maybe_unused]] std::size_t c) {
    if constexpr (BondingLaw<Law, S>)
      return Law::is_bonded(contacts.variants[c]);
    else
      return false;
  }
  /// The gap at which a point no longer counts as a spring of its pair [m].
  static Scalar open_length(const StepContext<S, Law>& context) {
    return std::min(context.margin, Tolerances{}.lengths(context.grain_size).margin);
  }
  /// How many springs a pair has, at least 1; open points count in part.
  /// @param first its first contact
  /// @param last  out: the one after its last contact
  static Scalar count_pair(const DetectedContacts<S>& contacts, std::size_t first,
                           std::size_t& last, Scalar length) {
    Scalar count = 0;
    last = end_of_pair(contacts, first);
    for (std::size_t c = first; c < last; ++c) {
      const Scalar open = std::max(Scalar(0), contacts.points[c].gap) / length;
      count += std::max(Scalar(0), 1 - open);
    }
    return std::max(Scalar(1), count);
  }
  MOREAU_COMPILED_ONCE static Row relaxation_of(const Row& compliance, const Row& impulse) {
    return -compliance.cwiseProduct(impulse);
  }
  /// d / h of a contact; law/compliant.hpp has the equation [m/s].
  Row missed_motion(const StepContext<S, Law>& context, std::size_t c, const CellJumps<S>* jumps,
                    const Operator& op) const {
    const Contact<S>& point = context.contacts.points[c];
    const auto change = [&](std::uint32_t body) ->
        typename S::Twist { return now_ * context.bodies.velocity[body] - then_ * last_[body]; };
    const typename S::Twist a = change(point.a), b = change(point.b);
    typename S::Vector velocity = relative_velocity(point, a, b);
    if (jumps) velocity += (now_ - then_) * (*jumps)[c];
    return op.row(c, velocity, angular<S>(b) - angular<S>(a));
  }
  friend struct moreau::SerializationAccess;
  friend struct StateAccess;
  auto serialized_members() { return std::tie(last_step_, ahead_, energies_, last_); }
  void deserialized() { sum_energies(); }

  void sum_energies() {
    energy_ = {};
    for (const Energy& energy : energies_) energy_.add(energy);
  }

  List<typename S::Twist> last_;  // velocities of the bodies after the step before [m/s, rad/s]
  List<Row> compliance_;          // c [1/kg]
  List<Row> relaxation_;          // what the memory adds to b [m/s]
  List<double> before_;           // energy before the step, one per contact [J]
  Scalar last_step_ = 0;          // h of the step before [s]
  Scalar ahead_ = 0;              // its part before detection, a [s]
  Scalar now_ = 0, then_ = 0;  // a of this step and of the step before over h; 0 if they are equal
  List<Energy> energies_;      // one per contact, after the step before
  List<double> compressions_;  // one per contact: the part of it by a bond that is pressed [J]
  Energy energy_;              // their sum
};

}  // namespace moreau::detail
