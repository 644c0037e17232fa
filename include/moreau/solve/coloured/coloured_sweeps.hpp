// SPDX-License-Identifier: MIT
// The sweeps of ColouredGaussSeidel. group_kernel.hpp has the local solutions, schedule.hpp the
// order of the groups, acceleration.hpp the start of each sweep.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/coloured/acceleration.hpp"
#include "moreau/solve/coloured/group_kernel.hpp"
#include "moreau/solve/coloured/schedule.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/sweep_change.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// The state of one solution and the sweeps that improve it. A sweep visits all groups, or the
/// active ones: those with an impulse at one of their points.
template <class Operator, class Law>
class ColouredSweeps {
 public:
  using Kernel = GroupKernel<Operator, Law>;
  using S = typename Kernel::S;
  using Impulse = typename Kernel::Impulse;

  /// The next start() is of another problem.
  /// @param again whether it differs from the last one by its free velocities alone: the groups and their order are kept
  void renew(bool again) {
    is_packed_ = is_packed_ && again;
    is_started_ = false;
  }
  /// @param problem out: its operator carries the velocities of the impulses
  /// @param shared  bodies that contact problems of other processes share; null: none
  void start(ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
             bool accelerate, const Team& team, SharedBodies* shared) {
    shared_ = shared;
    acceleration_ = Acceleration<T>(accelerate);
    if (is_packed_) {
      kernel_.restart(problem, impulses, team);
    } else {
      kernel_.start(problem, impulses, team);
      all_.assign(kernel_.groups(), [&](std::uint32_t k) { return kernel_.groups()[k].count; });
      is_packed_ = true;
    }
    is_started_ = true;
    if constexpr (!Kernel::is_fine) kernel_.set_unit(mean_diagonal(problem.delassus, shared));
    find_velocities(team);
    kernel_.end_packing();
    kernel_.give_velocities(problem.delassus, impulses, team, shared);
    update_active();
    save(team);
  }
  /// Writes the impulses in the order of the problem and computes their velocities anew, free of the
  /// rounding of the sweeps.
  void finish(Operator& op, std::span<Impulse> impulses, const Team& team) {
    kernel_.unpack(impulses, team);
    find_velocities(team);
    kernel_.give_velocities(op, impulses, team, shared_);
    acceleration_.interrupt();
  }
  /// measure_residual() after finish().
  void measure_residual(const ContactProblem<Operator, Law>& problem,
                        std::span<const Impulse> impulses, SolveReport& report, const Team& team) {
    if constexpr (MapsLanes<Law, S>) {
      const double scale = mean_diagonal(problem.delassus, shared_);
      auto sums = kernel_.residual(scale, team);
      if constexpr (AttractiveLaw<Law, S>) sums.relate_to_loads(problem, impulses, scale);
      sums.forgive_rounding(problem);
      if (shared_) sums.add_up(*shared_);
      sums.write(report);
    } else {
      moreau::measure_residual(problem, impulses, report, team, shared_);
    }
  }
  bool is_started() const { return is_started_; }  ///< after start(), until renew()
  /// Takes impulses that others have changed since start(), and gives the operator their velocities.
  void take(Operator& op, std::span<const Impulse> impulses, const Team& team) {
    kernel_.take(impulses, team);
    find_velocities(team);
    kernel_.give_velocities(op, impulses, team, shared_);
  }
  /// Takes velocities of bodies from the operator that are not those of the impulses.
  void take_velocities(const Operator& op) { kernel_.take_velocities(op); }
  void save(const Team& team) { copy_to(saved_, team); }  ///< saves the impulses
  /// Goes back to the saved impulses; the next sweep has no acceleration.
  void restore(const Team& team) {
    std::size_t i = 0;
    for (auto& point : kernel_.points())
      for (std::size_t d = 0; d < Kernel::rows; ++d)
        point.impulse[d] = point.before[d] = saved_[i++];
    recompute_velocities(team);
    kernel_.velocity().forget_change();
    acceleration_.restart();
  }
  bool is_mixing() const { return acceleration_.is_mixing(); }  ///< whether impulses are mixed
  void mark(const Team& team) { copy_to(marked_, team); }       ///< keeps the impulses for jump()
  /// Moves the impulses on by a multiple of their way since mark(); the next sweep has no acceleration.
  /// @returns false, and moves nothing, if the impulses have moved by as much as they were at mark()
  MOREAU_COLD bool jump(double factor, const Team& team) {
    double sums[] = {0, 0};  // of the squares of the way, and of the impulses at mark()
    std::size_t i = 0;
    for (const auto& point : kernel_.points())
      for (std::size_t d = 0; d < Kernel::rows; ++d, ++i)
        for (int l = 0; l < Kernel::Lanes::lanes; ++l) {
          const double from = double(marked_[i][l]), way = double(point.impulse[d][l]) - from;
          sums[0] += way * way;
          sums[1] += from * from;
        }
    if (shared_) shared_->sum(sums);
    const double most = std::sqrt(sums[1] / sums[0]) - 1;
    if (!(most > 0)) return false;
    i = 0;
    for (auto& point : kernel_.points())
      for (std::size_t d = 0; d < Kernel::rows; ++d, ++i) {
        point.impulse[d] +=
            Kernel::Lanes::broadcast(T(std::min(factor, most))) * (point.impulse[d] - marked_[i]);
        point.before[d] = point.impulse[d];
      }
    recompute_velocities(team);
    kernel_.velocity().forget_change();
    acceleration_.restart();
    return true;
  }
  /// Whether the sweeps that follow are accelerated.
  void accelerate(bool enabled) { acceleration_ = Acceleration<T>(enabled); }
  /// An accelerated sweep over the active groups. While impulses are mixed it has no extrapolation,
  /// and goes backward and forward in turn.
  void sweep_active(const Team& team) {
    const bool mixing = acceleration_.is_mixing();
    const bool back = mixing && mixed_sweeps_ % 2 == 0;
    if (mixing) mix(team);
    kernel_.begin_sweep(acceleration_.beta());
    run(TimedWork::sweep, team, [&](int rank, int size, const TeamBarrier& wait) {
      const auto visit = [this](std::uint32_t k) { kernel_.visit_active(k, acceleration_.beta()); };
      if (!mixing) {
        kernel_.velocity().extrapolate(acceleration_.beta(), rank, size);
        wait();
      }
      if (back)
        active_.backward(rank, size, wait, visit, settle_hub());
      else
        active_.forward(rank, size, wait, visit, settle_hub());
    });
    kernel_.end_sweep(active_.groups());
    average();
    if (!mixing) update_beta(active_);
  }
  /// An accelerated sweep over all groups; updates the active set.
  void sweep_all(const Team& team) {
    kernel_.begin_sweep(acceleration_.beta());
    run(TimedWork::full_sweep, team, [&](int rank, int size, const TeamBarrier& wait) {
      kernel_.velocity().extrapolate(acceleration_.beta(), rank, size);
      wait();
      const auto visit = [&](std::uint32_t k) {
        kernel_.template visit_all<false>(k, acceleration_.beta());
      };
      all_.forward(rank, size, wait, visit, settle_hub());
    });
    kernel_.end_sweep(all_.groups());
    average();
    update_active();
    update_beta(all_);
  }
  /// A sweep over all groups without acceleration; updates the active set.
  /// @returns its changes
  MOREAU_INLINED SweepChange plain_sweep(const Team& team) {
    kernel_.velocity().forget_change();
    acceleration_.interrupt();
    kernel_.clear_measures();
    kernel_.begin_sweep(0);
    run(TimedWork::full_sweep, team, [&](int rank, int size, const TeamBarrier& wait) {
      const auto visit = [&](std::uint32_t k) { kernel_.template visit_all<true>(k, 0); };
      all_.forward(rank, size, wait, visit, settle_hub());
    });
    kernel_.end_sweep(all_.groups());
    average();
    update_active();
    SweepChange change = kernel_.measures();
    if (shared_) change.add_up(*shared_);
    ++mixed_sweeps_;
    if (acceleration_.check(std::sqrt(change.dv2))) mix_unless_drifting();
    const int stalled = acceleration_.stalled_checks(), half = StagnationTest::checks / 2;
    if (stalled == half || stalled == half * 3 / 2)
      copy_to(stalled == half ? halfway_ : later_, team);
    update_beta(all_);
    return change;
  }

 private:
  using T = typename S::Scalar;
  static constexpr int sweeps_per_mix = 4;
  /// Packs of points below which a sweep takes less time than its barriers cost.
  static constexpr std::size_t least_points = 200;

  /// Runs a sweep: over the active groups, or over all.
  void run(TimedWork kind, const Team& team, const TeamThreads::Work& sweep) {
    const bool full = kind == TimedWork::full_sweep;
    team.run_timed(kind, full ? kernel_.points().size() : active_points_, least_points, sweep);
  }
  /// Copies the impulses of the points.
  MOREAU_COMPILED_ONCE void copy_to(List<typename Kernel::Values>& to, const Team& team) const {
    const auto& points = kernel_.points();
    to.resize(points.size() * Kernel::rows);
    team.share_each(points.size(), 256, [&](std::size_t p) {
      for (std::size_t d = 0; d < Kernel::rows; ++d)
        to[p * Kernel::rows + d] = points[p].impulse[d];
    });
  }
  /// Starts mixing, unless the impulses drift: of the checks without progress, the last quarter has moved them in about the
  /// direction of the quarter before.
  MOREAU_COLD void mix_unless_drifting() {
    constexpr double straight = 0.9;     // cosine
    typename Kernel::Values lanes[3]{};  // products and squares of both ways
    std::size_t i = 0;
    for (const auto& point : kernel_.points())
      for (std::size_t d = 0; d < Kernel::rows; ++d, ++i) {
        const auto before = kernel_.scaled(later_[i] - halfway_[i]),
                   way = kernel_.scaled(point.impulse[d] - later_[i]);
        lanes[0] += before * way;
        lanes[1] += before * before;
        lanes[2] += way * way;
      }
    double sums[3];
    for (int k = 0; k < 3; ++k) sums[k] = double(Kernel::Lanes::sum(lanes[k]));
    if (shared_) shared_->sum(sums);
    if (sums[0] > straight * std::sqrt(sums[1] * sums[2])) return;
    acceleration_.start_mixing();
    mixed_sweeps_ = 0;
    mixing_.start(kernel_, active_.groups());
  }
  auto settle_hub() {
    return [this](std::uint32_t k) { kernel_.settle_hub(k); };
  }
  /// Before a sweep while impulses are mixed: mixes them every few sweeps.
  void mix(const Team& team) {
    if (mixed_sweeps_ > 0 && mixed_sweeps_ % sweeps_per_mix == 0) {
      mixing_.mix(kernel_, shared_);
      recompute_velocities(team);
    }
    kernel_.velocity().forget_change();
    ++mixed_sweeps_;
  }
  MOREAU_COLD void recompute_velocities(const Team& team) {
    find_velocities(team);
    average();
    update_active();
  }
  /// Computes the velocities of the bodies and of the cell from the impulses of the points alone, and updates the
  /// active points of the groups.
  MOREAU_COMPILED_ONCE void find_velocities(const Team& team) {
    kernel_.begin_from_zero();
    const auto apply = [&](int rank, int size, const TeamBarrier& wait) {
      const auto visit = [this](std::uint32_t k) { kernel_.apply(k); };
      all_.forward(rank, size, wait, visit, settle_hub());
    };
    if (kernel_.points().size() < least_points)
      apply(0, 1, TeamBarrier());
    else
      team.run(apply);
    kernel_.end_sweep(all_.groups());
  }
  void update_active() {
    active_points_ = 0;
    active_.assign(kernel_.groups(), [&](std::uint32_t k) {
      active_points_ += kernel_.groups()[k].active;
      return kernel_.groups()[k].active;
    });
  }
  void update_beta(const Schedule& visited) {
    acceleration_.update_beta(
        [&] { return sum_over(shared_, kernel_.squared_change(visited.groups())); });
  }
  MOREAU_INLINED void average() {
    if (shared_) shared_->average(kernel_.velocity().scalars(), kernel_.velocity().width);
  }

  SharedBodies* shared_ = nullptr;
  bool is_packed_ = false, is_started_ = false;
  Kernel kernel_;
  Schedule all_, active_;
  Acceleration<T> acceleration_;
  ImpulseMixing<Kernel> mixing_;
  int mixed_sweeps_ = 0;           // since mixing started
  std::size_t active_points_ = 0;  // packs of them
  List<typename Kernel::Values> saved_, marked_, halfway_, later_;
};

}  // namespace moreau::detail
