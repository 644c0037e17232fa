// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/coloured/contact_groups.hpp"
#include "moreau/solve/coloured/lane_cell.hpp"
#include "moreau/solve/coloured/lane_residual.hpp"
#include "moreau/solve/coloured/lane_velocities.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/sweep_change.hpp"

namespace moreau::detail {

/// The visits of the sweeps to a group: the contact points of one pair of bodies per lane of a SIMD
/// register. The pairs of a group share no body that can move, except a hub (contact_groups.hpp).
/// visit() takes the points of a pair one after another. It computes the relative velocity of b with
/// respect to a without the impulse of the point itself, in the contact frame [m/s], asks the law for
/// the new impulse [N s], and adds what its change does to the velocities of both bodies
/// (lane_masses.hpp). The velocities are the changes by the impulses alone.
template <class Operator, class Law>
class GroupKernel {
 public:
  using Groups = ContactGroups<Operator, Law>;
  using S = typename Groups::S;
  using T = typename S::Scalar;
  using Lanes = typename Groups::Lanes;
  using Values = typename Lanes::Values;
  using Vector = typename LaneBlock<S>::Vector;
  using Row = typename Groups::Points::Row;
  static constexpr std::size_t rows = Groups::rows_of_point;  ///< of a contact
  /// Whether squares of impulses can be represented.
  static constexpr bool is_fine = std::is_same_v<T, double>;
  using Impulse = typename Operator::Vector;
  using Group = typename Groups::Group;
  using Points = typename Groups::Points;

  /// Groups the contacts; the bodies have no velocities yet. The groups are packed by the next apply() of each, by the
  /// thread that visits it: the points then go through its cache once, not twice.
  /// @param problem,impulses must outlive these calls of apply()
  /// @param team threads that share the work
  void start(const ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
             const Team& team) {
    contacts_.lay_out(problem.delassus, impulses, team);
    source_ = {&problem, impulses};
    is_large_ = contacts_.velocities() * sizeof(BodyLanes) / Lanes::lanes > near_cache;
    changes_.assign(contacts_.groups.size(), Values{});
    hub_changes_.resize(contacts_.groups.size());
    if (problem.delassus.has_cell()) [[unlikely]]
      pack_all();  // a cell asks for the points of all groups
    cell_.start(problem.delassus, contacts_);
    has_extras_ = is_large_ || cell_.moves();
    if (cell_.moves())
      for (Group& group : contacts_.groups) group.is_simple = false;
  }
  /// The same for a problem that differs from that of start() by its free velocities alone.
  void restart(const ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
               const Team& team) {
    contacts_.refill(problem, impulses, team);
    changes_.assign(contacts_.groups.size(), Values{});
  }
  /// Before the sweeps of a problem: a power of two near the velocity [m/s] that an impulse [N s] makes.
  void set_unit(double velocity) requires(!is_fine) { unit_ = reciprocal_power(T(1 / velocity)); }
  /// Sets the velocities of the bodies and of the cell to zero: apply() of all groups and end_sweep() then compute them
  /// from the impulses of the points alone.
  void begin_from_zero() {
    velocity_.reset(contacts_.velocities(), contacts_.bodies());
    if (cell_.moves()) cell_.begin_from_zero();
  }
  /// Adds what the impulses of group k do to its bodies; updates its active points. After start(), the groups are packed.
  MOREAU_COMPILED_ONCE void apply(std::uint32_t k) {
    if (source_.problem) contacts_.pack(*source_.problem, source_.impulses, k);
    Group& group = contacts_.groups[k];
    update_active(group);
    if (group.delays_hub()) hub_changes_[k] = {};
    if (group.active == 0) {
      if (cell_.moves()) cell_.skip(k);
      return;
    }
    // While groups are packed, another thread may be writing the bodies of later ones.
    if (is_large_ && source_.problem == nullptr) prefetch_from(k + ahead);
    BodyLanes a = velocity_.gather(group.a), b = velocity_.gather(group.b);
    if (cell_.moves()) cell_.enter(k, b);
    for (std::uint32_t p = group.first; p < group.first + group.active; ++p)
      push(k, contacts_.points[p], contacts_.points[p].impulse, a, b);
    if (cell_.moves()) cell_.leave(k, b);
    if (group.delays_hub())
      hub_changes_[k] = velocity_.scatter_partners(group, a, b);
    else
      velocity_.scatter(group, a, b);
  }
  /// After apply() of all groups: they are packed.
  void end_packing() { source_ = {}; }
  /// Gives the operator the velocities of the impulses, from which the next sweep starts.
  /// @param impulses those of the points, in the order of the problem
  void give_velocities(Operator& op, std::span<const Impulse> impulses, const Team& team,
                       SharedBodies* shared) {
    op.set_changes(
        impulses, [this](std::size_t i) { return velocity_.of(i); }, team);
    if (shared) {
      shared->average(op.velocity_changes(), Operator::width);
      take_velocities(op);
    }
    velocity_.forget_change();
    if (cell_.moves()) cell_.set_rate(op.cell_change());
  }
  /// Takes other impulses of the points than those of start().
  void take(std::span<const Impulse> impulses, const Team& team) {
    contacts_.refill(impulses, team);
  }
  /// Takes the velocities of the bodies from the operator.
  MOREAU_COMPILED_ONCE void take_velocities(const Operator& op) {
    for (std::size_t i = 0; i < op.body_count(); ++i) velocity_.set(i, op.velocity_change(i));
  }
  void unpack(std::span<Impulse> impulses, const Team& team) const {
    contacts_.unpack(impulses, team);
  }
  /// The sums of measure_residual() after give_velocities(). A sweep without extrapolation, or begin_from_zero(), is next.
  /// @param scale makes velocities of impulses [1/kg]
  ResidualSums<Operator, Law> residual(double scale, const Team& team) requires MapsLanes<Law, S> {
    begin_sweep(0);
    return sum_of<LaneResidual<Points>>(team, contacts_.groups.size(),
                                        [&](LaneResidual<Points>& sum, std::size_t k) {
                                          add_residual(sum, std::uint32_t(k), T(scale));
                                        })
        .template sums<ResidualSums<Operator, Law>>(scale);
  }

  const List<Group>& groups() const { return contacts_.groups; }
  List<Points>& points() { return contacts_.points; }
  const List<Points>& points() const { return contacts_.points; }
  LaneVelocities<S, Lanes>& velocity() { return velocity_; }

  /// Visits the active points of group k.
  /// @param beta impulses start from r + beta (r - r of the last visit)
  void visit_active(std::uint32_t k, T beta) { visit<false>(k, contacts_.groups[k].active, beta); }
  /// Visits all points of group k, unless none is active and none approaches; updates the active
  /// points.
  /// @tparam Measure whether it takes the measures of its changes
  template <bool Measure>
  void visit_all(std::uint32_t k, T beta) {
    Group& group = contacts_.groups[k];
    changes_[k] = Values{};
    if (group.delays_hub()) hub_changes_[k] = {};
    if (group.active == 0 && !approaches(k)) {
      if (cell_.moves()) cell_.skip(k);
      return;
    }
    visit<Measure>(k, group.count, beta);
    update_active(group);
  }

  /// Before a sweep: gives a cell that moves by its stress the velocity of the impulses from which the sweep starts.
  /// @param beta of the sweep
  void begin_sweep(T beta) {
    if (cell_.moves()) cell_.begin_sweep(contacts_, beta);
  }
  /// After a sweep: gives such a cell the velocity of the impulses.
  /// @param groups of the sweep
  void end_sweep(const List<std::uint32_t>& groups) {
    if (cell_.moves()) cell_.end_sweep(groups, contacts_);
  }
  /// After a phase of groups of a hub: adds to the velocity of the hub what the visits of a group
  /// have changed.
  void settle_hub(std::uint32_t k) { velocity_.add(contacts_.groups[k], hub_changes_[k]); }

  /// What is squared of an impulse, for sums of which only ratios count: in single precision a multiple of it, because
  /// squares of impulses of grains of 1e-6 m or 1e4 m cannot be represented.
  Values scaled(const Values& impulse) const {
    if constexpr (is_fine)
      return impulse;
    else
      return impulse * unit_;
  }

  /// Squared change of impulses in the last visits of some groups, added up in their order.
  double squared_change(const List<std::uint32_t>& groups) const {
    Values change2{};
    for (const std::uint32_t k : groups) change2 += changes_[k];
    return double(Lanes::sum(change2));
  }
  void clear_measures() { measures_.assign(contacts_.groups.size(), {}); }
  SweepChange measures() const {
    SweepChange change;
    for (const SweepChange& one : measures_) change.add(one);
    return change;
  }

 private:
  /// What apply() packs; null: all groups are packed.
  struct Source {
    const ContactProblem<Operator, Law>* problem = nullptr;
    std::span<const Impulse> impulses{};
  };
  MOREAU_INLINED void pack_all() {
    for (std::size_t k = 0; k < contacts_.groups.size(); ++k)
      contacts_.pack(*source_.problem, source_.impulses, k);
    end_packing();
  }

  using BodyLanes = typename LaneVelocities<S, Lanes>::BodyLanes;
  using Algebra = LaneAlgebra<S, Values>;
  using Angular = std::array<Values, Algebra::angular>;

  /// Groups between the present one and that whose velocities are loaded into the cache: more than
  /// memory takes to answer. The groups of a colour are visited in their order, but their bodies lie
  /// anywhere.
  static constexpr std::uint32_t ahead = 4;
  /// Velocities that the processor's own cache holds are not loaded ahead [bytes].
  static constexpr std::size_t near_cache = std::size_t{1} << 18;
  void prefetch_from(std::uint32_t number) const {
    if (number >= contacts_.groups.size()) return;
    velocity_.prefetch(contacts_.groups[number].a);
    velocity_.prefetch(contacts_.groups[number].b);
  }

  /// LaneVelocities::gather(), for all but the visits.
  MOREAU_COMPILED_ONCE BodyLanes
  gathered(const typename LaneVelocities<S, Lanes>::Bodies& bodies) const {
    return velocity_.gather(bodies);
  }
  /// Adds what impulses at a point of group `number` do to the velocities of its bodies.
  void push(std::size_t number, const Points& point, const Row& impulse, BodyLanes& a,
            BodyLanes& b) const {
    Vector p;
    for (std::size_t k = 0; k < S::dim; ++k) {
      p[k] = point.frame[k][0] * impulse[0];
      for (std::size_t d = 1; d < S::dim; ++d) p[k] += point.frame[k][d] * impulse[d];
    }
    const auto& [mass_a, mass_b] = contacts_.masses[number];
    auto moment_a = Algebra::moment(point.lever_a, p), moment_b = Algebra::moment(point.lever_b, p);
    if constexpr (Rolls<Law>) add_couple(point, impulse, moment_a, moment_b);
    const auto turn_a = Algebra::template product<Algebra::angular>(mass_a.angular, moment_a);
    const auto turn_b = Algebra::template product<Algebra::angular>(mass_b.angular, moment_b);
    const std::uint32_t matrices = contacts_.groups[number].matrices;
    if (matrices == Group::isotropic) {
      for (std::size_t k = 0; k < S::dim; ++k) {
        a[k] -= mass_a.linear * p[k];
        b[k] += mass_b.linear * p[k];
      }
    } else {
      const auto& masses = contacts_.mass_matrices[matrices];
      const auto of_a = Algebra::template product<Algebra::dim>(masses.a, p);
      const auto of_b = Algebra::template product<Algebra::dim>(masses.b, p);
      for (std::size_t k = 0; k < S::dim; ++k) {
        a[k] -= of_a[k];
        b[k] += of_b[k];
      }
    }
    for (std::size_t k = 0; k < Algebra::angular; ++k) {
      a[S::dim + k] -= turn_a[k];
      b[S::dim + k] += turn_b[k];
    }
  }
  /// Adds the couple of impulses at a point to their moments about the bodies, world axes [N m s].
  static void add_couple(const Points& point, const Row& impulse, Angular& moment_a,
                         Angular& moment_b) {
    const Angular couple = Algebra::to_world(point.frame, Points::Block::angular(impulse));
    for (std::size_t k = 0; k < Algebra::angular; ++k) {
      moment_a[k] += point.radius * couple[k];
      moment_b[k] += point.radius * couple[k];
    }
  }
  /// Adds R times the spin of b with respect to a to the last rows of u, in the frame [m/s].
  static void add_spin(const Points& point, const BodyLanes& a, const BodyLanes& b, Row& u) {
    Angular between;
    for (std::size_t k = 0; k < Algebra::angular; ++k)
      between[k] = point.radius * (b[S::dim + k] - a[S::dim + k]);
    const Angular spin = Algebra::to_frame(point.frame, between);
    for (std::size_t k = 0; k < Algebra::angular; ++k) u[S::dim + k] += spin[k];
  }
  /// Relative velocity of b with respect to a at a point, world axes [m/s].
  static Vector relative(const Points& point, const BodyLanes& a, const BodyLanes& b) {
    return relative_velocity_of_lanes<Algebra>(a, point.lever_a, b, point.lever_b);
  }

  /// A point is active if it has an impulse or had one before its last visit; the points of a group
  /// up to its last active one are visited.
  void update_active(Group& group) const {
    group.active = 0;
    for (std::uint32_t p = 0; p < group.count; ++p) {
      const Points& point = contacts_.points[group.first + p];
      typename Lanes::Indices some{};
      for (std::size_t d = 0; d < rows; ++d)
        some |= (point.impulse[d] != Values{}) | (point.before[d] != Values{});
      if (Lanes::any(some)) group.active = p + 1;
    }
  }
  /// Whether u_n < 0 at a point of the group.
  MOREAU_COMPILED_ONCE bool approaches(std::uint32_t number) const {
    const Group& group = contacts_.groups[number];
    const BodyLanes a = gathered(group.a);
    BodyLanes b = gathered(group.b);
    if (cell_.moves()) cell_.add_velocity(number, b);
    typename Lanes::Indices some{};
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p) {
      const Points& point = contacts_.points[p];
      const Vector between = relative(point, a, b);
      Values u = point.free[0];
      for (std::size_t k = 0; k < S::dim; ++k) u += point.frame[k][0] * between[k];
      some |= u < Values{};
    }
    return Lanes::any(some);
  }

  MOREAU_INLINED void add_residual(LaneResidual<Points>& sum, std::uint32_t number, T scale) const {
    const Group& group = contacts_.groups[number];
    const BodyLanes a = gathered(group.a);
    BodyLanes b = gathered(group.b);
    if (cell_.moves()) cell_.add_velocity(number, b);
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p) {
      const Points& point = contacts_.points[p];
      const Vector between = relative(point, a, b);
      Row u = point.free;
      for (std::size_t k = 0; k < S::dim; ++k)
        for (std::size_t d = 0; d < S::dim; ++d) u[d] += point.frame[k][d] * between[k];
      if constexpr (CompliantLaw<Law, S>)
        for (std::size_t d = 0; d < rows; ++d) u[d] += point.compliance[d] * point.impulse[d];
      sum.add(point, u, scale);
    }
  }

  /// Solves the first `count` contacts of each pair in the group, one after the other.
  template <bool Measure>
  MOREAU_COMPILED_ONCE void visit(std::uint32_t number, std::uint32_t count, T extrapolation) {
    const Group& group = contacts_.groups[number];
    Values change2{};
    BodyLanes a = velocity_.gather(group.a), b = velocity_.gather(group.b);
    if (has_extras_) {
      if (is_large_) prefetch_from(number + ahead);
      if (cell_.moves()) cell_.enter(number, b);
    }
    const Values beta = Lanes::broadcast(extrapolation);
    for (std::uint32_t p = group.first; p < group.first + count; ++p) {
      Points& point = contacts_.points[p];
      Row guess;
      for (std::size_t d = 0; d < rows; ++d)
        guess[d] = point.impulse[d] + beta * (point.impulse[d] - point.before[d]);
      const Row own = point.block * guess;
      const Vector between = relative(point, a, b);
      Row without_own;  // b of the law
      for (std::size_t d = 0; d < rows; ++d) {
        without_own[d] = point.free[d] - own[d];
        if constexpr (CompliantLaw<Law, S>) without_own[d] += point.compliance[d] * guess[d];
      }
      for (std::size_t k = 0; k < S::dim; ++k)
        for (std::size_t d = 0; d < S::dim; ++d) without_own[d] += point.frame[k][d] * between[k];
      if constexpr (Rolls<Law>) add_spin(point, a, b, without_own);
      // Before a stopping test impulses are put onto the cone.
      const Row impulse = point.law.solve(point.block, without_own, guess, /*polish=*/Measure);
      Row change;
      for (std::size_t d = 0; d < rows; ++d) {
        change[d] = impulse[d] - guess[d];
        const Values counted = scaled(change[d]);
        change2 += counted * counted;
        point.before[d] = point.impulse[d];
        point.impulse[d] = impulse[d];
      }
      // A compiler barrier: the frame is read again from memory. Kept in registers it would be
      // spilled and read from there.
      asm volatile("" : : : "memory");
      push(number, point, change, a, b);
      if constexpr (Measure) measure(measures_[number], point.block, change, impulse);
    }
    changes_[number] = change2;
    if (!group.is_simple) {
      if (cell_.moves()) cell_.leave(number, b);
      if (group.delays_hub()) {
        hub_changes_[number] = velocity_.scatter_partners(group, a, b);
        return;
      }
    }
    velocity_.scatter(group, a, b);
  }
  void measure(SweepChange& sum, const typename Points::Block& block, const Row& change,
               const Row& impulse) const {
    const Row dv = block * change, wr = block * impulse;
    Values dv2{}, r2{}, wr2{}, rwr{};
    for (std::size_t d = 0; d < rows; ++d) {
      const Values counted = scaled(impulse[d]);
      dv2 += dv[d] * dv[d];
      r2 += counted * counted;
      wr2 += wr[d] * wr[d];
      rwr += counted * wr[d];
    }
    for (int l = 0; l < Lanes::lanes; ++l)
      sum.add(double(dv2[l]), double(r2[l]), double(wr2[l]), double(rwr[l]));
  }

  Groups contacts_;
  Source source_;
  LaneCell<Operator, Points> cell_;
  LaneVelocities<S, Lanes> velocity_;
  T unit_ = 1;               // of squared impulses, see scaled()
  bool is_large_ = false;    // whether velocities are loaded ahead
  bool has_extras_ = false;  // whether a visit begins with more than loading its bodies
  // One entry per group.
  List<Values> changes_;  // |change of impulses|^2 of the last visit, in each lane
  List<SweepChange> measures_;
  List<typename LaneVelocities<S, Lanes>::Change> hub_changes_;  // of groups that delay them
};

}  // namespace moreau::detail
