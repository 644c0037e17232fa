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
// the arcs on which the points of the bodies move over the step (chord_velocities.hpp). A rigid bond has rate (d, R t) / h
// with a rate of a fifth, which corrects what the solver and the overlap correction leave. Of d and t it corrects what
// exceeds the rounding of the positions: in a closed row of bonds no motion corrects that, and the forces would grow from
// sweep to sweep.
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
#include "moreau/world/detail/chord_velocities.hpp"
#include "moreau/world/detail/contact_losses.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// In place of the bonds of a law that has none.
struct NoBonds {
  static void start(const auto&) {}
  static void hide(const auto&, const auto& use) { use(); }
  static void offset(const auto&, auto&, const auto&, const auto&) {}
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
  /// @param keeps    function: contact -> whether its pair is bonded
  /// @returns how many bonds were made
  std::size_t add(const Bodies<S>& bodies, const PeriodicCell<S>& cell,
                  const ContactsOf<Law, S>& touching, const auto& keeps) {
    const std::size_t before = bonds_.size();
    for (std::size_t first = 0, last; first < touching.size(); first = last) {
      last = end_of_pair(touching, first);
      const auto points = std::span(touching.points).subspan(first, last - first);
      const BodyId a = bodies.id[points[0].a], b = bodies.id[points[0].b];
      if (std::any_of(points.begin(), points.end(), keeps) && !has(a, b, before))
        bonds_.push_back(made(bodies, cell, points));
    }
    std::sort(bonds_.begin(), bonds_.end(), [](const Bond<S>& l, const Bond<S>& r) {
      return std::pair(l.a, l.b) < std::pair(r.a, r.b);
    });
    return bonds_.size() - before;
  }
  /// Simulation::missed_gap() [m].
  Scalar missed_gap() const { return missed_gap_; }
  void note_missed(Scalar gap) { missed_gap_ = gap; }  ///< sets it
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
    return true;
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
        bond.slip = transposed_product(places_[i].frame, stretch_on_arcs(i, bodies, before));
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
  /// Hides the impulses of bonds, of which springs have no memory, while `use` is called.
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
  /// Adds to b what bonds are stretched, and the chords of their points.
  /// @param context StepContext of the step
  /// @param pulls   h T of each contact [N s]
  /// @param before  velocities before the step, in the configuration of the contacts [m/s, rad/s]
  void offset(const auto& context, Operator& op, std::span<const Scalar> pulls,
              std::span<const typename S::Twist> before) {
    for_each([&](std::size_t i, std::size_t c) {
      const BondPlace<S>& at = places_[i];
      const typename S::Inertia spin_frame = S::angular_frame(op.frame(c));
      Vector stretch = at.stretch - at.frame * bonds_[i].slip;
      typename S::Angular turn = at.turn - S::angular_frame(at.frame) * bonds_[i].bend;
      if constexpr (!is_compliant) {
        stretch = beyond(stretch, at.rounding);
        turn = beyond(turn, rounding_of_turn);
      }
      Row row;
      linear<S>(row) = op.frame(c).transpose() * stretch;
      angular<S>(row) = op.radius(c) * (spin_frame.transpose() * turn);
      row *= (is_compliant ? 1 : rate) / context.step;
      drifts_[i] = is_compliant ? Row(Row::Zero()) : row;
      linear<S>(row) += transposed_product(op.frame(c), chord_of(c, context, before));
      if constexpr (is_compliant) row[0] -= op.compliance(c)[0] * pulls[c];
      op.offset(c, row);
    });
  }
  /// Tells the solver from which impulses those of bonds are measured.
  /// @param pulls       impulses of the attraction [N s]
  /// @param velocity_of function: contact -> its velocity if no bond bears anything [m/s]
  void refer(const Operator& op, std::span<const Scalar> pulls, Scalar step,
             const auto& velocity_of, ProblemBonds<Scalar>& bonds) const {
    bonds.pulls.clear();
    bonds.velocity2 = bonds.rounding2 = 0;
    if (bonds_.empty()) return;
    bonds.pulls.assign(pulls.begin(), pulls.end());
    for_each([&](std::size_t i, std::size_t c) {
      bonds.velocity2 += double(Row(velocity_of(c) + drifts_[i]).squaredNorm());
      if constexpr (!is_compliant) {
        const double stretch = double(rate / step * places_[i].rounding),
                     turn = double(rate / step * rounding_of_turn * op.radius(c));
        bonds.rounding2 += stretch * stretch + turn * turn;
      }
    });
  }

  /// Finds the strength in the step of bonds that yield, after the contact problem was solved with the present
  /// attraction. Let x be the share that a bond loses in the step by its velocity. Its strength in the step is the mean
  /// over the opening, s - x / 2, or s^2 / (2 x) if it breaks: it dissipates the area under the line of softening,
  /// whatever the step. A secant step per bond makes the iteration for one bond end after two solutions.
  /// @param pulls impulses of the attraction in the solution [N s]
  /// @returns the sum of the squares of the impulses that these strengths differ from the attraction by
  double find_strengths(const Materials<Law>& materials, const Operator& op,
                        const ContactsOf<Law, S>& contacts, std::span<const Row> impulses,
                        std::span<const Scalar> pulls, Scalar step) {
    double sum = 0;
    for_each([&](std::size_t i, std::size_t c) {
      const Law& law = materials.laws()[contacts.points[c].law];
      const Scalar full = step * law.strength().tension, now = pulls[c] / full;
      Softening& last = softening_[i];
      Scalar found = strength_in_step(i, law, op, c, impulses[c], step);
      // Equal to rounding: T h s, divided by T h, is not s to the last bit.
      const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon() * bonds_[i].strength_left;
      if (std::abs(found - now) <= rounding) found = now;
      const Scalar slope =
          last.found < 0 || now == last.now ? Scalar(0) : (found - last.found) / (now - last.now);
      const Scalar next = now + (found - now) / (1 - std::clamp(slope, Scalar(0), Scalar(0.9)));
      const Scalar kept = std::clamp(next, Scalar(0), bonds_[i].strength_left);
      last = {now, found, found == now ? Scalar(0) : full * (kept - now)};
      sum += double(full * (found - now)) * double(full * (found - now));
    });
    return sum;
  }
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
  /// @param impulses p of every contact [N s]
  /// @param pulls    impulses of the attraction [N s]
  /// @param shared   bodies that other processes share; null: none
  double load(std::span<const Row> impulses, std::span<const Scalar> pulls,
              SharedBodies* shared) const {
    double sums[] = {0, 0};  // of the squares of what acts on the bodies, and of p
    for_each([&](std::size_t, std::size_t c) {
      Row bears = impulses[c];
      bears[0] -= pulls[c];
      sums[0] += bears.template cast<double>().squaredNorm();
      sums[1] += impulses[c].template cast<double>().squaredNorm();
    });
    if (shared) shared->sum(sums);
    return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
  }
  /// StepReport::bond_error.
  static double error(double load, double residual) {
    const double rounding = 32 * double(std::numeric_limits<Scalar>::epsilon());
    return load > 0 ? std::max(residual, rounding / load) : 0;
  }
  /// Finds out how the bonds yield, which end_step() lets them do, and which of them break.
  /// @param op       with the velocities of the impulses
  /// @param impulses p of every contact [N s]
  /// @param step     h [s]
  void yield(const Materials<Law>& materials, const Operator& op,
             const ContactsOf<Law, S>& contacts, std::span<const Row> impulses, Scalar step) {
    broken_.assign(bonds_.size(), 0);
    yields_.assign(bonds_.size(), {});
    for_each([&](std::size_t i, std::size_t c) {
      const Contact<S>& contact = contacts.points[c];
      const Law& law = materials.laws()[contact.law];
      const Row p = pushes(law, impulses[c], step);
      if (!law.yields(p)) return;
      const Row w = yielding(law, op, i, c, p);
      Yield& yield = yields_[i];
      yield.loss = step * law.softening(w);
      broken_[i] = !(bonds_[i].strength_left > yield.loss);
      const typename S::Matrix frame = places_[i].frame.transpose() * op.frame(c);
      yield.slip = step * (frame * linear<S>(w));
      yield.bend = step / op.radius(c) *
                   (S::angular_frame(places_[i].frame).transpose() *
                    (S::angular_frame(op.frame(c)) * angular<S>(w)));
    });
  }
  /// Lets the bonds yield. Moves the energy that they took in the step from friction and rolling to StepReport::fracture, and removes
  /// those that broke.
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
      const ContactLosses one = losses(c);
      double taken = one.dissipation + bond.elastic;
      if constexpr (CompliantLaw<Law, S>) {
        bond.elastic = broken_[i] ? 0 : springs.energy_after(c);
        if (broken_[i]) springs.release(c, report);
      }
      taken -= bond.elastic;
      report.friction -= one.friction;
      report.rolling -= one.rolling;
      report.fracture += taken;
      bond.dissipated += taken;
      if (!broken_[i]) return;
      contacts.variants[c] = 0;
      breakages_.push_back({0, bond.a, bond.b, bond.dissipated});
      ++new_breakages_;
    });
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
  auto serialized_members() { return std::tie(bonds_, breakages_); }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  static constexpr bool is_compliant = CompliantLaw<Law, S>;
  static constexpr Scalar rate = Scalar(0.2);
  static constexpr Scalar rounding_of_turn = std::numeric_limits<Scalar>::epsilon();  // [rad]

  /// A strength in the step that the problem was solved with, that of find_strengths() for its solution; < 0: none.
  struct Softening {
    Scalar now = -1, found = -1;
    Scalar change = 0;  ///< of the impulse of the attraction, for the next solution [N s]
  };
  /// How a bond yields in a step: a step that is repeated with more contacts must not have changed it.
  struct Yield {
    Scalar loss = 0;                                // of strength_left [-]
    Vector slip = Vector::Zero();                   // [m]
    typename S::Angular bend = S::Angular::Zero();  // [rad]
  };
  /// The velocity at which a bond yields: that of its bodies, less that of its springs, without the correction of a
  /// rigid bond, which counts the motion up to detection as an error. Where the bond does not yield, the correction goes on.
  Row yielding(const Law& law, const Operator& op, std::size_t i, std::size_t c,
               const Row& p) const {
    return law.yielding(p, Row(op.velocity(c) - drifts_[i]));
  }
  /// The impulse of a bond, without what is rounding beside its strength.
  static Row pushes(const Law& law, Row p, Scalar step) {
    const Scalar small = std::sqrt(std::numeric_limits<Scalar>::epsilon());
    if (p[0] <= small * step * law.strength().tension) p[0] = 0;
    return p;
  }
  Scalar strength_in_step(std::size_t i, const Law& law, const Operator& op, std::size_t c,
                          const Row& impulse, Scalar step) const {
    const Scalar s = bonds_[i].strength_left;
    const Row p = pushes(law, impulse, step);
    if (!law.yields(p)) return s;
    const Scalar x = step * law.softening(yielding(law, op, i, c, p));
    return !std::isfinite(x) ? s : x < s ? s - x / 2 : s * s / (2 * x);
  }
  /// The part of a vector that is longer than its rounding.
  static auto beyond(const auto& x, Scalar rounding) {
    const Scalar length = x.norm();
    return std::decay_t<decltype(x)>(x * (length > rounding ? 1 - rounding / length : Scalar(0)));
  }
  /// The chord of the arcs on which the points of a bond move over the step, b minus a [m/s].
  static Vector chord_of(std::size_t c, const auto& context,
                         std::span<const typename S::Twist> before) {
    const Contact<S>& contact = context.contacts.points[c];
    return chord_excess<S>(angular<S>(before[contact.b]), contact.lever_b, context.step) -
           chord_excess<S>(angular<S>(before[contact.a]), contact.lever_a, context.step);
  }
  /// The stretch of a bond whose bodies have moved along tangents and turned for a while, of which its points at the
  /// beginning had the same velocity [m].
  Vector stretch_on_arcs(std::size_t i, const Bodies<S>& bodies, Scalar time) const {
    const auto excess = [&](BodyId body, const Vector& lever) {
      const typename S::Angular spin = angular<S>(bodies.velocity[body.index()]);
      const Vector back = time * (chord_excess<S>(spin, lever, -time) + S::spin(spin, lever));
      return Vector(time * chord_excess<S>(spin, Vector(lever - back), time));
    };
    if (!(time > 0)) return Vector::Zero();
    const BondPlace<S>& at = places_[i];
    return excess(bonds_[i].b, at.middle_b + at.stretch / 2) -
           excess(bonds_[i].a, at.middle_a - at.stretch / 2);
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
  static Bond<S> made(const Bodies<S>& bodies, const PeriodicCell<S>& cell,
                      std::span<const Contact<S>> points) {
    Bond<S> bond;
    Vector lever_a = Vector::Zero(), lever_b = Vector::Zero(), normal = Vector::Zero();
    for (const Contact<S>& point : points) {
      lever_a += point.lever_a;
      lever_b += point.lever_b;
      normal += point.frame.col(0);
    }
    lever_a /= Scalar(points.size());
    lever_b /= Scalar(points.size());
    // Normals of several parts that cancel: any will do.
    normal = normal.norm() > Scalar(0.1) ? normal.normalized() : Vector(points[0].frame.col(0));
    const std::uint32_t a = points[0].a, b = points[0].b;
    const typename S::Matrix axes_a = bodies.axes(a), axes_b = bodies.axes(b),
                             frame = S::contact_frame(normal);
    bond.a = bodies.id[a];
    bond.b = bodies.id[b];
    bond.anchor_a = axes_a.transpose() * lever_a;
    bond.anchor_b = axes_b.transpose() * lever_b;
    bond.frame_a = axes_a.transpose() * frame;
    bond.frame_b = axes_b.transpose() * frame;
    count_cells(bond, bodies, cell);
    return bond;
  }
  /// Counts the cells to the image of b at a: a user may have moved bodies by whole cells, or set another cell.
  MOREAU_COLD static void count_cells(Bond<S>& bond, const Bodies<S>& bodies,
                                      const PeriodicCell<S>& cell) {
    const std::size_t a = bond.a.index(), b = bond.b.index();
    const Vector at_a = bodies.pose[a].position + bodies.axes(a) * bond.anchor_a,
                 at_b = bodies.pose[b].position + bodies.axes(b) * bond.anchor_b;
    bond.cells = cell.cells(Vector(at_a - at_b));
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
  // Of the step.
  List<std::size_t> contact_of_;  // of each bond, or none
  List<BondPlace<S>> places_;     // of each bond
  List<Row> drifts_;              // of each bond: the correction in its offset, see offset()
  List<unsigned char> broken_;    // of each bond
  List<Yield> yields_;            // of each bond
  List<Softening> softening_;     // of each bond
  List<Row> hidden_;
  ContactsOf<Law, S> merged_;
  std::size_t undetected_ = 0;
  std::size_t new_breakages_ = 0;
};

}  // namespace moreau::detail
