// SPDX-License-Identifier: MIT
// The bonds of a simulation over a step. A bond is one contact in the list of contacts, in place of those that
// detection has found for its pair:
//
//   1. place() writes the bonds to the list of contacts
//   2. start() gives their contacts the variant with a bond, offset() adds to b what they are stretched and the chords of
//      the arcs of their points, and refer() tells the solver that p is measured from the strength
//   3. find_strengths(), soften() let the strength of those that yield fall, and the problem is solved again until it stays
//   4. yield() and end_step() let them yield and break
//
// The memory of a bond is the geometry. Let d be the vector from its point on a to that on b less the slip where it has
// yielded, and t the rotation of b against a likewise, both in the contact frame. With springs in series
// (law/compliant.hpp) of the compliance c the law is that of p = r + h T n and
//
//     u + (d, R t) / h + c r,
//
// whose normal entry is the velocity of the points in the next detection: to u belongs the chord E(w_b) X_b - E(w_a) X_a of
// the arcs on which the points of the bodies move over the step (chord_velocities.hpp).
//
// A rigid bond has (1 - h / H) w - (h / H) rate (d, R t) / H with a rate of a fifth in place of what springs add: it corrects what the
// solver and the overlap correction leave, in the time H (bond_relaxation.hpp, corrected_bonds.hpp).
//
// The first detection comes after a part of a step, in which the bodies move along tangents. Bodies that turn together
// then have a stretch of second order in the step, which is the memory of a new bond: to correct it would add to the
// force of the bond what does not vanish with the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/detail/bonds/bond_arcs.hpp"
#include "moreau/world/detail/bonds/bond_relaxation.hpp"
#include "moreau/world/detail/bonds/bond_yield.hpp"
#include "moreau/world/detail/bonds/corrected_bonds.hpp"
#include "moreau/world/detail/contact_losses.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// In place of the bonds of a law that has none.
struct NoBonds {
  static void start(const auto&) {}
  static void hide(const auto&, const auto& use) { use(); }
  static void offset(const auto&, auto&, const auto&, const auto&, const auto&) {}
};

/// The bonds of a simulation, sorted by their bodies, and the list of breakages.
template <class S, class Law>
class BondList {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  const std::vector<Bond<S>>& bonds() const { return bonds_; }  ///< sorted by their bodies
  /// The bonds that broke, in the order of time.
  const std::vector<Breakage>& breakages() const { return breakages_; }

  /// Bonds pairs that touch and have no bond yet, at the middle of their contact points.
  /// @param touching contacts in the present configuration
  /// @param keeps    function: contact points of a pair -> whether it is bonded
  /// @returns how many bonds were made
  std::size_t add(const Bodies<S>& bodies, const PeriodicCell<S>& cell,
                  const ContactsOf<Law, S>& touching, const auto& keeps) {
    const std::size_t before = bonds_.size();
    for (std::size_t first = 0, last; first < touching.size(); first = last) {
      last = end_of_pair(touching, first);
      const auto points = std::span(touching.points).subspan(first, last - first);
      const BodyId a = bodies.id[points[0].a], b = bodies.id[points[0].b];
      if (keeps(points) && !has(a, b, before)) bonds_.push_back(bond_of<S>(points, bodies, cell));
    }
    std::sort(bonds_.begin(), bonds_.end(), [](const Bond<S>& l, const Bond<S>& r) {
      return std::pair(l.a, l.b) < std::pair(r.a, r.b);
    });
    return bonds_.size() - before;
  }
  /// Simulation::missed_gap() [m].
  Scalar missed_gap() const { return missed_gap_; }
  /// Simulation::missed_points().
  std::size_t missed_points() const { return missed_points_; }
  /// Sets both.
  void note_missed(Scalar gap, std::size_t points) { missed_gap_ = gap, missed_points_ = points; }
  /// Erases the bonds of removed bodies.
  /// @param removed one per body: not 0 if it is removed
  void erase(std::span<const unsigned char> removed) {
    erase_at(bonds_, [&](std::size_t i) {
      return removed[bonds_[i].a.index()] != 0 || removed[bonds_[i].b.index()] != 0;
    });
    contact_of_.clear();
  }
  /// Replaces the bonds, between two steps.
  /// @param bonds sorted by their bodies
  void set_bonds(std::vector<Bond<S>> bonds) {
    bonds_ = std::move(bonds);
    contact_of_.clear();
  }
  /// Replaces the list of breakages.
  void set_breakages(std::vector<Breakage> breakages) { breakages_ = std::move(breakages); }
  /// Whether the bonds, read from a file, are of bodies that exist, and sorted.
  bool are_valid(const Bodies<S>& bodies) const {
    const auto exists = [&](BodyId id) {
      return id.index() < bodies.size() && bodies.id[id.index()] == id;
    };
    for (std::size_t i = 0; i < bonds_.size(); ++i)
      if (!exists(bonds_[i].a) || !exists(bonds_[i].b) ||
          (i > 0 &&
           std::pair(bonds_[i - 1].a, bonds_[i - 1].b) >= std::pair(bonds_[i].a, bonds_[i].b)))
        return false;
    return relaxation_.is_valid();
  }

  /// The cell, a lattice, has other vectors of the same lattice: counts the cells of each bond by these.
  /// @param before vectors of the cell so far, world axes [m]
  void recount_cells(const typename S::Matrix& before, const PeriodicCell<S>& cell) {
    for (Bond<S>& bond : bonds_) bond.cells = cell.cells(product(before, bond.cells));
  }
  /// Replaces the contacts of bonded pairs by those of the bonds.
  /// @param contacts sorted, as detected
  /// @param before   the part of the step before the detection [s]
  void place(const Bodies<S>& bodies, const PeriodicCell<S>& cell, ContactsOf<Law, S>& contacts,
             Scalar before) {
    contact_of_.assign(bonds_.size(), none);
    places_.resize(bonds_.size());
    softening_.assign(bonds_.size(), {});
    drifts_.resize(bonds_.size());
    undetected_ = 0;
    if (bonds_.empty()) return;
    merged_.clear();
    std::size_t c = 0;
    for (std::size_t i = 0; i < bonds_.size(); ++i) {
      Bond<S>& bond = bonds_[i];
      const std::pair pair(bond.a.value, bond.b.value);
      for (; c < contacts.size() && contacts.keys[c].bodies() < pair; ++c) copy(contacts, c);
      const std::size_t detected = c;
      while (c < contacts.size() && contacts.keys[c].bodies() == pair) ++c;
      if (bodies.is_prescribed(bond.a.index()) && bodies.is_prescribed(bond.b.index())) continue;
      contact_of_[i] = merged_.size();
      if (!cell.is_open()) count_cells(bond, bodies, cell);
      undetected_ += c == detected;
      const Vector shift = cell.shift(bond.cells);
      places_[i] = place_of(bond, bodies, shift);
      if (bond.is_new)
        bond.slip =
            transposed_product(places_[i].frame, stretch_on_arcs(bond, places_[i], bodies, before));
      add_contact(pair.first, pair.second, places_[i]);
    }
    for (; c < contacts.size(); ++c) copy(contacts, c);
    std::swap(contacts, merged_);
  }
  /// Bonds of the last place() for whose pairs detection had no contact.
  std::size_t undetected() const { return undetected_; }
  /// Gives the contacts of bonds the variant with a bond, and all others that without.
  void start(ContactsOf<Law, S>& contacts) const {
    contacts.variants.assign(contacts.size(), 0);
    for_each([&](std::size_t, std::size_t c) { contacts.variants[c] = 1; });
  }
  /// Sets the impulses of bonds to 0 during `use`: the springs of a bond follow from its stretch, not from its impulse.
  void hide(std::span<Row> impulses, const auto& use) {
    hidden_.clear();
    for_each([&](std::size_t, std::size_t c) {
      hidden_.push_back(impulses[c]);
      impulses[c].setZero();
    });
    use();
    std::size_t k = 0;
    for_each([&](std::size_t, std::size_t c) { impulses[c] = hidden_[k++]; });
  }
  /// The attraction of contacts: the tensile strength of bonds that is left [N].
  void attractions(const Materials<Law>& materials, const ContactsOf<Law, S>& contacts,
                   List<Scalar>& forces) const {
    forces.assign(contacts.size(), 0);
    for_each([&](std::size_t i, std::size_t c) {
      forces[c] =
          bonds_[i].strength_left * materials.laws()[contacts.points[c].law].strength().tension;
    });
  }
  /// Adds to b the stretch of the bonds divided by h, and the chords of their points.
  /// @param context StepContext of the step
  /// @param pulls   h T of each contact [N s]
  /// @param before  velocities before the step, in the configuration of the contacts [m/s, rad/s]
  /// @param shared  bodies that other processes share; null: none
  void offset(const auto& context, Operator& op, std::span<const Scalar> pulls,
              std::span<const typename S::Twist> before, [[maybe_unused]] SharedBodies* shared) {
    if constexpr (!is_compliant) {
      relaxation_.start(context.step, largest_rounding(op, shared));
      find_corrected(context.bodies, shared);
    }
    for_each([&](std::size_t i, std::size_t c) {
      const Strain strain = strain_of(i);
      const typename S::Inertia spin_frame = S::angular_frame(op.frame(c));
      Row row;
      linear<S>(row) = op.frame(c).transpose() * strain.stretch;
      angular<S>(row) = op.radius(c) * (spin_frame.transpose() * strain.turn);
      if constexpr (is_compliant) {
        row /= context.step;
        drifts_[i].setZero();
      } else {
        row *= relaxation_.factor() * corrected_.share(context.bodies, bonds_[i]);
        if (const Scalar now = relaxation_.share_of_step(); now < 1)
          row += (now - 1) * left_before(i, c, op);
        drifts_[i] = row;
      }
      linear<S>(row) += transposed_product(
          op.frame(c), chord_of_bond<S>(context.contacts.points[c], before, context.step));
      if constexpr (is_compliant) row[0] -= op.compliance(c)[0] * pulls[c];
      op.offset(c, row);
    });
  }
  /// Tells the solver from which impulses those of bonds are measured.
  /// @param pulls       impulses of the attraction [N s]
  /// @param velocity_of function: contact -> its velocity if no bond bears anything [m/s]
  void refer(const Operator& op, std::span<const Scalar> pulls, const auto& velocity_of,
             ProblemAttraction<Scalar>& attraction) const {
    attraction.pulls.clear();
    attraction.velocity2 = attraction.rounding2 = 0;
    if (bonds_.empty()) return;
    attraction.pulls.assign(pulls.begin(), pulls.end());
    for_each([&](std::size_t i, std::size_t c) {
      attraction.velocity2 += double(Row(velocity_of(c) + drifts_[i]).squaredNorm());
      if constexpr (!is_compliant) {
        const double factor = double(relaxation_.factor()),
                     stretch = factor * double(places_[i].measured),
                     turn = factor * double(rounding_of_turn * op.radius(c));
        attraction.rounding2 += stretch * stretch + turn * turn;
      }
    });
  }

  /// Finds the strength in the step of bonds that yield, after the contact problem was solved with the present
  /// attraction.
  /// @param pushes p of the solution, see pushes.hpp [N s]
  /// @param pulls  impulses of the attraction in the solution [N s]
  /// @returns the sum over the bonds of the squares of h (strength - attraction in the solution) [N^2 s^2]
  double find_strengths(const Materials<Law>& materials, const Operator& op,
                        const ContactsOf<Law, S>& contacts, std::span<const Row> pushes,
                        std::span<const Scalar> pulls, Scalar step) {
    double sum = 0;
    farthest_ = 0;
    for_each([&](std::size_t i, std::size_t c) {
      const LoadedBond<S, Law> bond = loaded(i, c, materials, op, contacts, pushes, step);
      const Scalar strength = bonds_[i].strength_left, full = step * bond.law.strength().tension;
      const double lacks =
          double(softening_[i].go_on(pulls[c], full, bond.strength_in_step(strength), strength));
      sum += lacks * lacks;
      if (lacks != 0) farthest_ = std::max(farthest_, std::abs(lacks) / double(full * strength));
    });
    return sum;
  }
  /// The largest difference of find_strengths() for a bond, as a share of the strength that it has left [-].
  double farthest() const { return farthest_; }
  /// Lets the attraction of the bonds fall to the strengths found.
  /// @param change function: (contact, change of the impulse of its attraction [N s])
  void soften(const auto& change) const {
    for_each([&](std::size_t i, std::size_t c) {
      if (softening_[i].change != 0) change(c, softening_[i].change);
    });
  }
  /// Most solutions of a step in which bonds yield.
  static constexpr int max_solutions = 30;

  /// StepReport::bond_load.
  /// @param pushes   p of every contact, see pushes.hpp [N s]
  /// @param pulls    impulses of the attraction [N s]
  /// @param shared   bodies that other processes share; null: none
  double load([[maybe_unused]] const Operator& op, std::span<const Row> pushes,
              std::span<const Scalar> pulls, [[maybe_unused]] Scalar step, SharedBodies* shared) {
    // Of the squares of what acts on the bodies, of p, and of the velocities of bond_relaxation.hpp; bonds.
    double sums[] = {0, 0, 0, 0};
    for_each([&](std::size_t, std::size_t c) {
      Row bears = pushes[c];
      bears[0] -= pulls[c];
      sums[0] += bears.template cast<double>().squaredNorm();
      sums[1] += pushes[c].template cast<double>().squaredNorm();
      if constexpr (!is_compliant) {
        const Scalar velocity =
            std::max(linear<S>(bears).norm(), relaxation_.least_load * pulls[c]) * op.normal(c);
        sums[2] += double(velocity) * double(velocity);
        sums[3] += 1;
      }
    });
    if (shared) shared->sum(sums);
    if constexpr (!is_compliant)
      relaxation_.bear(sums[3] > 0 ? Scalar(std::sqrt(sums[2] / sums[3]) / double(step))
                                   : Scalar(0));
    return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
  }
  /// StepReport::bond_error.
  static double error(double load, double residual) {
    const double rounding = 32 * double(std::numeric_limits<Scalar>::epsilon());
    return load > 0 ? std::min(1., std::max(residual, rounding / load)) : 0;
  }
  /// Finds out how the bonds yield, which end_step() lets them do, and which of them break.
  /// @param op       with the velocities of the impulses
  /// @param pushes   p of every contact, see pushes.hpp [N s]
  /// @param step     h [s]
  void yield(const Materials<Law>& materials, const Operator& op,
             const ContactsOf<Law, S>& contacts, std::span<const Row> pushes, Scalar step) {
    broken_.assign(bonds_.size(), 0);
    yields_.assign(bonds_.size(), {});
    for_each([&](std::size_t i, std::size_t c) {
      yields_[i] = yield_of(loaded(i, c, materials, op, contacts, pushes, step), places_[i].frame);
      broken_[i] = yields_[i].loss != 0 && !(bonds_[i].strength_left > yields_[i].loss);
    });
  }
  /// Applies the yielding of the step to the bonds, and removes those that broke. StepReport::fracture is what bonds took that
  /// yielded, and what springs release. What other bonds take, in impacts and by the damping of their springs, is
  /// neither friction nor rolling: of several impulses at once each alone can do work of either sign.
  /// @param losses  function: contact c -> its ContactLosses
  /// @param springs ContactSprings or NoSprings
  void end_step(ContactsOf<Law, S>& contacts, const auto& losses, auto& springs,
                StepReport& report) {
    for_each([&](std::size_t i, std::size_t c) {
      Bond<S>& bond = bonds_[i];
      bond.is_new = false;
      bond.strength_left = broken_[i] ? Scalar(0) : Scalar(bond.strength_left - yields_[i].loss);
      bond.slip += yields_[i].slip;
      bond.bend += yields_[i].bend;
      bond.opening = yields_[i].opening;
      bond.turning = yields_[i].turning;
      const ContactLosses one = losses(c);
      double taken = one.dissipation + bond.elastic;
      if constexpr (CompliantLaw<Law, S>) taken -= springs.energy_after(c);
      taken = yields_[i].loss > 0 ? std::max(0., taken) : 0;
      if constexpr (CompliantLaw<Law, S>) {
        if (broken_[i]) taken += springs.release(c, report);
        bond.elastic = springs.energy_after(c);
      }
      report.friction -= one.friction;
      report.rolling -= one.rolling;
      report.fracture += taken;
      bond.dissipated += taken;
      if (!broken_[i]) return;
      contacts.variants[c] = 0;
      breakages_.push_back({0, bond.a, bond.b, bond.dissipated});
      ++new_breakages_;
    });
    if constexpr (!is_compliant) relaxation_.end_step();
    report.broken_bonds = new_breakages_;
    report.bonds = bonds_.size() - new_breakages_;
    if (new_breakages_ == 0) return;
    erase_at(bonds_, [&](std::size_t i) { return broken_[i] != 0; });
  }
  /// Gives the breakages of the last step their time [s].
  void stamp(double time) {
    for (; new_breakages_ > 0; --new_breakages_)
      breakages_[breakages_.size() - new_breakages_].time = time;
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(bonds_, breakages_, relaxation_); }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  static constexpr bool is_compliant = CompliantLaw<Law, S>;
  // Of t: the axes of both bodies, and their products with the two frames of the bond [rad].
  static constexpr Scalar rounding_of_turn = 4 * std::numeric_limits<Scalar>::epsilon();
  /// d and t of a bond, world axes.
  struct Strain {
    Vector stretch;            ///< [m]
    typename S::Angular turn;  ///< [rad]
  };

  LoadedBond<S, Law> loaded(std::size_t i, std::size_t c, const Materials<Law>& materials,
                            const Operator& op, const ContactsOf<Law, S>& contacts,
                            std::span<const Row> pushes, Scalar step) const {
    return {materials.laws()[contacts.points[c].law], op, c, pushes[c], drifts_[i], step};
  }
  Strain strain_of(std::size_t i) const {
    const BondPlace<S>& at = places_[i];
    return {at.stretch - at.frame * bonds_[i].slip,
            at.turn - S::angular_frame(at.frame) * bonds_[i].bend};
  }
  /// Of the stretches and rotations of all bonds [m].
  Scalar largest_rounding(const Operator& op, SharedBodies* shared) const {
    double rounding = 0;
    for_each([&](std::size_t i, std::size_t c) {
      rounding = std::max(
          {rounding, double(places_[i].rounding), double(rounding_of_turn * op.radius(c))});
    });
    if (shared) shared->largest({&rounding, 1});
    return Scalar(rounding);
  }
  /// w of the step before, as a row of the operator [m/s].
  Row left_before(std::size_t i, std::size_t c, const Operator& op) const {
    const auto& axes = places_[i].frame;
    Row row;
    linear<S>(row) = transposed_product(op.frame(c), Vector(axes * bonds_[i].opening));
    angular<S>(row) = op.radius(c) * (S::angular_frame(op.frame(c)).transpose() *
                                      (S::angular_frame(axes) * bonds_[i].turning));
    return row;
  }
  void find_corrected(const Bodies<S>& bodies, SharedBodies* shared) {
    if (bonds_.empty() && !shared) return;
    corrected_.start(bodies.size());
    for_each([&](std::size_t i, std::size_t) { corrected_.connect(bodies, bonds_[i]); });
    for_each([&](std::size_t i, std::size_t) {
      const Strain strain = strain_of(i);
      corrected_.add(bodies, bonds_[i], places_[i].rounding / strain.stretch.norm());
      corrected_.add(bodies, bonds_[i], rounding_of_turn / strain.turn.norm());
    });
    corrected_.end(shared);
  }
  /// Calls use(index of the bond, index of its contact).
  void for_each(const auto& use) const {
    for (std::size_t i = 0; i < contact_of_.size(); ++i)
      if (contact_of_[i] != none) use(i, contact_of_[i]);
  }
  /// @param count of the bonds that are sorted
  bool has(BodyId a, BodyId b, std::size_t count) const {
    const auto end = bonds_.begin() + std::ptrdiff_t(count);
    const auto at =
        std::lower_bound(bonds_.begin(), end, std::pair(a, b),
                         [](const Bond<S>& bond, const std::pair<BodyId, BodyId>& pair) {
                           return std::pair(bond.a, bond.b) < pair;
                         });
    return at != end && at->a == a && at->b == b;
  }
  void copy(const ContactsOf<Law, S>& from, std::size_t c) {
    merged_.points.push_back(from.points[c]);
    merged_.keys.push_back(from.keys[c]);
    merged_.classes.push_back(from.classes[c]);
    merged_.impulses.push_back(from.impulses[c]);
    merged_.variants.push_back(from.variants[c]);
  }
  void add_contact(std::uint32_t a, std::uint32_t b, const BondPlace<S>& at) {
    merged_.points.push_back({a, b, 0, Scalar(0), at.frame, at.middle_a, at.middle_b});
    merged_.keys.push_back({a, b, bond_feature});
    merged_.classes.push_back(ContactClass::vertex_vertex);
    merged_.impulses.push_back(Row::Zero());
    merged_.variants.push_back(1);
  }

  std::vector<Bond<S>> bonds_;
  std::vector<Breakage> breakages_;
  Scalar missed_gap_ = -1;
  std::size_t missed_points_ = 0;
  // Of the step.
  List<std::size_t> contact_of_;       // of each bond, or none
  List<BondPlace<S>> places_;          // of each bond
  List<Row> drifts_;                   // of each bond: the correction in its offset, see offset()
  CorrectedBonds<S> corrected_;        // of rigid bonds
  List<unsigned char> broken_;         // of each bond
  List<BondYield<S>> yields_;          // of each bond
  List<Softening<Scalar>> softening_;  // of each bond
  List<Row> hidden_;
  ContactsOf<Law, S> merged_;
  std::size_t undetected_ = 0;
  std::size_t new_breakages_ = 0;
  double farthest_ = 0;                // see farthest()
  BondRelaxation<Scalar> relaxation_;  // of rigid bonds
};

}  // namespace moreau::detail
