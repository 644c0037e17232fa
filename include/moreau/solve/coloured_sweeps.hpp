// SPDX-License-Identifier: MIT
// The state and the sweeps of ColouredGaussSeidel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "moreau/solve/anderson_mixing.hpp"
#include "moreau/solve/contact_groups.hpp"
#include "moreau/solve/lane_velocities.hpp"
#include "moreau/solve/momentum.hpp"
#include "moreau/solve/sweep_change.hpp"
#include "moreau/solve/team.hpp"

namespace moreau::detail {

/// The state of one solution: groups of contacts, scaled body velocities, acceleration.
template <class Operator, class Law>
class ColouredSweeps {
 public:
  using Groups = ContactGroups<Operator, Law>;
  using S = typename Groups::S;
  using T = typename S::Scalar;
  using W = typename Groups::W;
  using Values = typename W::Values;
  using Vector = typename LaneBlock<S>::Vector;
  using Impulse = typename Operator::Vector;

  /// @param problem its operator carries the velocities that the impulses make
  void start(const ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
             bool accelerate) {
    groups_.build(problem, impulses);
    load_velocities(problem.delassus);
    accelerate_ = accelerate;
    momentum_ = Momentum();
    patience_ = Patience();
    mixing_ = false;
    changes_.assign(groups_.pairs.size(), Values{});
    all_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k) {
      all_.push_back(k);
      note_awake(groups_.pairs[k]);
    }
    find_phases(all_, phases_);
    list_awake();
    keep();
  }
  /// Body velocities of the operator; what the sweeps rounded off is gone. The next sweep starts
  /// from the impulses as they are, because no earlier velocities belong to these.
  void load_velocities(const Operator& op) {
    velocity_.reset(groups_.rows());
    for (std::size_t i = 0; i < op.body_count(); ++i) velocity_.set(i, op.scaled_velocity(i));
    velocity_.settle();
    beta_ = 0;
  }
  /// Remembers the impulses as they are.
  void keep() {
    kept_.clear();
    for (const auto& point : groups_.points)
      for (std::size_t d = 0; d < S::dim; ++d) kept_.push_back(point.impulse[d]);
  }
  /// Starts anew from the impulses that were kept, without acceleration at first.
  void go_back() {
    std::size_t i = 0;
    for (auto& point : groups_.points)
      for (std::size_t d = 0; d < S::dim; ++d) {
        point.impulse[d] = point.before[d] = kept_[i++];
      }
    remake_velocities();
    velocity_.settle();
    beta_ = 0;
    mixing_ = false;
  }
  void unpack(std::span<Impulse> impulses) const { groups_.unpack(impulses); }

  /// A sweep over the contacts that are awake, accelerated.
  template <class Team>
  void sweep(const Team& team) {
    if (mixing_) {
      mixed_sweep(team);
      return;
    }
    team.run([&](int rank, int size, auto&& meet) {
      velocity_.extrapolate(beta_, rank, size);
      meet();
      visit_awake(rank, size, meet);
    });
    set_momentum(awake_);
  }
  /// The same, over all contacts; wakes those that approach, lets go those that rest.
  template <class Team>
  void waking_sweep(const Team& team) {
    team.run([&](int rank, int size, auto&& meet) {
      velocity_.extrapolate(beta_, rank, size);
      meet();
      visit_all<false>(rank, size, meet);
    });
    list_awake();
    set_momentum(all_);
  }
  /// One plain sweep over all contacts; wakes those that approach, lets go those that rest.
  template <class Team>
  SweepChange plain_sweep(const Team& team) {
    velocity_.settle();
    beta_ = 0;
    measures_.assign(groups_.pairs.size(), {});
    team.run([&](int rank, int size, auto&& meet) { visit_all<true>(rank, size, meet); });
    list_awake();
    SweepChange change;
    for (const SweepChange& one : measures_) change.add(one);
    ++mixed_sweeps_;
    if (!mixing_) momentum_.check(std::sqrt(change.dv2));
    if (accelerate_ && patience_.exhausted(std::sqrt(change.dv2))) {
      mixing_ = !mixing_;
      if (mixing_) start_mixing();
    }
    set_momentum(all_);
    return change;
  }

 private:
  static constexpr int sweeps_per_mix = 4;
  using Velocities = LaneVelocities<S, W>;
  using BodyLanes = typename Velocities::BodyLanes;
  using Pairs = typename Groups::Pairs;
  using Points = typename Groups::Points;

  /// Runs of groups of one colour within a list of groups in their order, and where those begin
  /// that must be visited one after the other.
  struct Phases {
    std::vector<std::size_t> ends;
    std::size_t serial = 0, end = 0;
  };
  void find_phases(const std::vector<std::uint32_t>& list, Phases& phases) const {
    phases.ends.clear();
    phases.end = list.size();
    std::size_t i = 0;
    while (i < list.size() && groups_.pairs[list[i]].colour != PairColouring::colours) {
      const std::uint32_t colour = groups_.pairs[list[i]].colour;
      while (i < list.size() && groups_.pairs[list[i]].colour == colour) ++i;
      phases.ends.push_back(i);
    }
    phases.serial = i;
  }
  /// Calls f(k) for the groups of a list, those of a colour shared by the team.
  template <class Meet, class F>
  static void forward(const std::vector<std::uint32_t>& list, const Phases& phases, int rank,
                      int size, Meet&& meet, F&& f) {
    std::size_t begin = 0;
    for (const std::size_t end : phases.ends) {
      const Share share(end - begin, rank, size);
      for (std::size_t i = begin + share.begin; i < begin + share.end; ++i) f(list[i]);
      begin = end;
      meet();
    }
    if (rank == 0)
      for (std::size_t i = phases.serial; i < phases.end; ++i) f(list[i]);
  }
  template <class Meet, class F>
  static void backward(const std::vector<std::uint32_t>& list, const Phases& phases, int rank,
                       int size, Meet&& meet, F&& f) {
    if (rank == 0)
      for (std::size_t i = phases.end; i-- > phases.serial;) f(list[i]);
    for (std::size_t p = phases.ends.size(); p-- > 0;) {
      meet();
      const std::size_t begin = p > 0 ? phases.ends[p - 1] : 0;
      const Share share(phases.ends[p] - begin, rank, size);
      for (std::size_t i = begin + share.begin; i < begin + share.end; ++i) f(list[i]);
    }
  }

  template <class Meet>
  void visit_awake(int rank, int size, Meet&& meet) {
    forward(awake_, awake_phases_, rank, size, meet,
            [&](std::uint32_t k) { visit<false>(k, groups_.pairs[k].awake); });
  }
  template <bool Measure, class Meet>
  void visit_all(int rank, int size, Meet&& meet) {
    forward(all_, phases_, rank, size, meet, [&](std::uint32_t k) {
      Pairs& group = groups_.pairs[k];
      changes_[k] = Values{};
      if (group.awake == 0 && !approaches(group)) return;
      visit<Measure>(k, group.count);
      note_awake(group);
    });
  }
  /// Momentum from what the last sweep changed, added up in the order of the list.
  void set_momentum(const std::vector<std::uint32_t>& visited) {
    beta_ = 0;
    if (!accelerate_ || mixing_) return;
    Values change2{};
    for (const std::uint32_t k : visited) change2 += changes_[k];
    beta_ = static_cast<T>(momentum_.next(double(W::sum(change2))));
  }

  /// Backward and forward in turn, mixed after every few.
  template <class Team>
  void mixed_sweep(const Team& team) {
    if (mixed_sweeps_ > 0 && mixed_sweeps_ % sweeps_per_mix == 0) mix();
    velocity_.settle();
    const bool back = mixed_sweeps_++ % 2 == 0;
    team.run([&](int rank, int size, auto&& meet) {
      if (back)
        backward(awake_, awake_phases_, rank, size, meet,
                 [&](std::uint32_t k) { visit<false>(k, groups_.pairs[k].awake); });
      else
        visit_awake(rank, size, meet);
    });
  }
  /// The points that are awake now are those that are mixed.
  void start_mixing() {
    mixed_sweeps_ = 0;
    mixed_.clear();
    for (const std::uint32_t k : awake_) {
      const Pairs& group = groups_.pairs[k];
      for (std::uint32_t p = 0; p < group.awake; ++p) mixed_.push_back(group.first + p);
    }
    packed_.resize(Eigen::Index(mixed_.size() * S::dim * std::size_t{W::lanes}));
    pack_mixed();
    anderson_.start(packed_);
  }
  void pack_mixed() {
    T* to = packed_.data();
    for (const std::uint32_t p : mixed_)
      for (std::size_t d = 0; d < S::dim; ++d, to += W::lanes)
        std::memcpy(to, &groups_.points[p].impulse[d], sizeof(Values));
  }
  void mix() {
    pack_mixed();
    anderson_.mix(packed_);
    const T* from = packed_.data();
    for (const std::uint32_t p : mixed_)
      for (std::size_t d = 0; d < S::dim; ++d, from += W::lanes)
        groups_.points[p].impulse[d] = W::load(from);
    remake_velocities();
  }
  /// Velocities from the impulses alone.
  void remake_velocities() {
    velocity_.reset(groups_.rows());
    for (Pairs& group : groups_.pairs) {
      apply(group);
      note_awake(group);
    }
    list_awake();
  }
  /// Adds what the impulses of a group do to its bodies.
  void apply(const Pairs& group) {
    BodyLanes a = velocity_.gather(group.a), b = velocity_.gather(group.b);
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p)
      push(groups_.points[p], groups_.points[p].impulse, a, b);
    velocity_.scatter(group, a, b);
  }
  /// Impulses of a point on the velocities of its bodies.
  static void push(const Points& point, const Vector& impulse, BodyLanes& a, BodyLanes& b) {
    for (std::size_t k = 0; k < S::dofs; ++k)
      for (std::size_t d = 0; d < S::dim; ++d) {
        a[k] -= point.rows_a[k][d] * impulse[d];
        b[k] += point.rows_b[k][d] * impulse[d];
      }
  }

  void list_awake() {
    awake_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k)
      if (groups_.pairs[k].awake > 0) awake_.push_back(k);
    find_phases(awake_, awake_phases_);
  }
  /// Notes which points of a group carry an impulse or just let go of one.
  void note_awake(Pairs& group) const {
    group.awake = 0;
    for (std::uint32_t p = 0; p < group.count; ++p) {
      const Points& point = groups_.points[group.first + p];
      typename W::Indices some{};
      for (std::size_t d = 0; d < S::dim; ++d)
        some |= (point.impulse[d] != Values{}) | (point.before[d] != Values{});
      if (W::any(some)) group.awake = p + 1;
    }
  }
  bool approaches(const Pairs& group) const {
    const BodyLanes a = velocity_.gather(group.a), b = velocity_.gather(group.b);
    typename W::Indices some{};
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p) {
      const Points& point = groups_.points[p];
      Values u = point.free[0];
      for (std::size_t k = 0; k < S::dofs; ++k)
        u += point.rows_b[k][0] * b[k] - point.rows_a[k][0] * a[k];
      some |= u < Values{};
    }
    return W::any(some);
  }

  /// Solves the contacts of a group, points of a pair one after the other.
  template <bool Measure>
  void visit(std::uint32_t number, std::uint32_t count) {
    const Pairs& group = groups_.pairs[number];
    Values change2{};
    BodyLanes a = velocity_.gather(group.a), b = velocity_.gather(group.b);
    const Values beta = W::broadcast(beta_);
    for (std::uint32_t p = group.first; p < group.first + count; ++p) {
      Points& point = groups_.points[p];
      Vector guess;
      for (std::size_t d = 0; d < S::dim; ++d)
        guess[d] = point.impulse[d] + beta * (point.impulse[d] - point.before[d]);
      // Two sums side by side: half the latency.
      const Vector own = point.block * guess;
      Vector of_a, of_b;
      for (std::size_t d = 0; d < S::dim; ++d) {
        of_a[d] = own[d];
        of_b[d] = point.free[d];
      }
      for (std::size_t k = 0; k < S::dofs; ++k)
        for (std::size_t d = 0; d < S::dim; ++d) {
          of_a[d] += point.rows_a[k][d] * a[k];
          of_b[d] += point.rows_b[k][d] * b[k];
        }
      Vector u;
      for (std::size_t d = 0; d < S::dim; ++d) u[d] = of_b[d] - of_a[d];
      const Vector impulse = point.law.solve(point.block, u, guess, Measure);
      Vector change;
      for (std::size_t d = 0; d < S::dim; ++d) {
        change[d] = impulse[d] - guess[d];
        change2 += change[d] * change[d];
        point.before[d] = point.impulse[d];
        point.impulse[d] = impulse[d];
      }
      // The rows are read again from memory: kept, they would be spilled and read from there.
      asm volatile("" : : : "memory");
      push(point, change, a, b);
      if constexpr (Measure) add(measures_[number], point.block, change, impulse);
    }
    changes_[number] = change2;
    velocity_.scatter(group, a, b);
  }

  static void add(SweepChange& sum, const LaneBlock<S>& block, const Vector& change,
                  const Vector& impulse) {
    const Vector dv = block * change, wr = block * impulse;
    Values dv2{}, r2{}, wr2{}, rwr{};
    for (std::size_t d = 0; d < S::dim; ++d) {
      dv2 += dv[d] * dv[d];
      r2 += impulse[d] * impulse[d];
      wr2 += wr[d] * wr[d];
      rwr += impulse[d] * wr[d];
    }
    for (int l = 0; l < W::lanes; ++l)
      sum.add(double(dv2[l]), double(r2[l]), double(wr2[l]), double(rwr[l]));
  }

  Groups groups_;
  Velocities velocity_;
  std::vector<std::uint32_t> all_, awake_;  // groups
  Phases phases_, awake_phases_;
  std::vector<Values> kept_;           // impulses of all points
  std::vector<Values> changes_;        // of each group, |change of impulses|^2 of the last visit
  std::vector<SweepChange> measures_;  // of each group
  bool accelerate_ = true, mixing_ = false;
  Patience patience_;
  Momentum momentum_;
  T beta_ = 0;
  std::vector<std::uint32_t> mixed_;  // points
  Eigen::Matrix<T, Eigen::Dynamic, 1> packed_;
  AndersonMixing<T> anderson_;
  int mixed_sweeps_ = 0;
};

}  // namespace moreau::detail
