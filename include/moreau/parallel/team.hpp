// SPDX-License-Identifier: MIT
// The threads that share the work of a step. A team runs a piece of work on all its members at
// once:
//
//     team.run([&](int rank, int size, const TeamBarrier& wait) { ... });
//
// rank is 0 .. size - 1. wait() is a barrier: it returns once all members have called it. run()
// returns when all members are done. No result may depend on the size of the team: members write to
// different places, and what they add up is added in an order that does not depend on them. The calling
// thread alone runs the same machine code as the members, and share_each() the same for every element,
// wherever the part of a member begins (core/compiled_once.hpp).
//
// This header needs no thread library; parallel/thread_team.hpp has the team with threads.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>

#include "moreau/core/compiled_once.hpp"

namespace moreau {

/// Refers to a function object without keeping it. As a parameter it takes any function of the
/// signature; it must not outlive the call. All calls run the same machine code.
template <class Signature>
class FunctionRef;
/// For functions without a result.
template <class... Arguments>
class FunctionRef<void(Arguments...)> {
 public:
  /// Refers to `function`.
  template <class Function>
  requires(!std::same_as<Function, FunctionRef>) FunctionRef(const Function& function)
      : function_(&function), call_([](const void* f, Arguments... arguments) {
          (*static_cast<const Function*>(f))(arguments...);
        }) {}
  /// Calls it.
  void operator()(Arguments... arguments) const { detail::unknown(call_)(function_, arguments...); }

 private:
  const void* function_;
  void (*call_)(const void*, Arguments...);
};

/// The barrier of a team, as a function.
class TeamBarrier {
 public:
  TeamBarrier() = default;  ///< of the calling thread alone: returns at once
  /// @param wait called with `barrier` by every member; returns once all members have called it
  TeamBarrier(void* barrier, void (*wait)(void*)) : barrier_(barrier), wait_(wait) {}
  /// Returns once all members of the team have called it.
  void operator()() const {
    if (wait_) wait_(barrier_);
  }

 private:
  void* barrier_ = nullptr;
  void (*wait_)(void*) = nullptr;
};

/// Kinds of work that are timed, see Team::run_timed().
enum class TimedWork { detection, correction, sweep, full_sweep };

/// The threads of a team; derive from it for threads of your own.
class TeamThreads {
 public:
  /// Work that a team shares: work(rank, size, wait) is the piece of one member.
  using Work = FunctionRef<void(int, int, const TeamBarrier&)>;

  virtual ~TeamThreads() = default;
  virtual int size() const = 0;  ///< number of members, the calling thread included
  /// Calls work(rank, size, wait) once on each member and returns when all are done. If members
  /// throw, the exception of the lowest rank is thrown again here; a member that has thrown leaves the
  /// barrier (std::barrier::arrive_and_drop()), so that the others do not wait for it. If run() is
  /// called while the members work, by a member or by another simulation on a thread of its own,
  /// work(0, 1, {}) is called on the calling thread alone.
  virtual void run(const Work& work) = 0;
  /// Called before a piece of work that is timed.
  /// @returns whether the members should share it
  virtual bool begin(TimedWork kind) = 0;
  /// Called after this piece of work, on the same thread, also if the work throws.
  /// @param amount of work, in the unit of its kind
  virtual void end(TimedWork kind, std::size_t amount) = 0;

  std::atomic<bool> shares{false};  ///< whether work is shared until the next work that is timed
};

namespace detail {

/// The part of 0 .. count - 1 for one member of a team.
struct Share {
  std::size_t begin, end;
  Share(std::size_t count, int rank, int size)
      : begin(count * std::size_t(rank) / std::size_t(size)),
        end(count * std::size_t(rank + 1) / std::size_t(size)) {}
};

}  // namespace detail

/// Threads that share the work of a step; without threads, the calling thread alone. Copies share
/// the threads. Simulations may run at the same time with one team: while it works for one of them, the
/// others work alone. With a team each they do not hinder each other.
class Team {
 public:
  Team() = default;  ///< the calling thread alone
  /// A team with threads.
  explicit Team(std::shared_ptr<TeamThreads> threads) : threads_(std::move(threads)) {}

  int size() const { return threads_ ? threads_->size() : 1; }  ///< number of members
  /// Whether work is shared at present, see run_timed().
  bool shares() const { return threads_ && threads_->shares.load(std::memory_order_relaxed); }

  /// Runs work(rank, size, wait) on all members. If members throw, the exception of the lowest rank
  /// is thrown again here.
  void run(const TeamThreads::Work& work) const {
    if (shares())
      threads_->run(work);
    else
      work(0, 1, TeamBarrier());
  }
  /// Runs work(begin, end) on all members, each with a part of 0 .. count - 1. A loop over a part need not be
  /// the same code for all elements: where it multiplies, call share_each().
  /// @param least with fewer than 2 least the calling thread works alone
  void share(std::size_t count, std::size_t least,
             const FunctionRef<void(std::size_t, std::size_t)>& work) const {
    if (!shares() || count < 2 * least) {
      if (count > 0) work(0, count);
      return;
    }
    threads_->run([&](int rank, int size, const TeamBarrier&) {
      const detail::Share part(count, rank, size);
      if (part.begin < part.end) work(part.begin, part.end);
    });
  }
  /// Calls work(i) for i = 0 .. count - 1, shared by all members; `least` as for share(). All elements run
  /// the same machine code.
  void share_each(std::size_t count, std::size_t least,
                  const FunctionRef<void(std::size_t)>& work) const {
    share(count, least, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  }

  /// Runs work(rank, size, wait) and measures the time. The work is shared if this is faster, and so
  /// is what follows until the next work that is timed; what follows a correction is shared as before.
  /// @param amount of work, in a unit that is the same for all work of the kind
  /// @param least  amount below which the work is neither shared nor timed
  void run_timed(TimedWork kind, std::size_t amount, std::size_t least,
                 const TeamThreads::Work& work) const {
    if (!threads_) return run(work);
    const bool is_timed = amount >= least, shared = shares();
    threads_->shares.store(is_timed && threads_->begin(kind), std::memory_order_relaxed);
    {
      const EndOfWork end{is_timed ? threads_.get() : nullptr, kind, amount};
      run(work);
    }
    if (kind == TimedWork::correction) threads_->shares.store(shared, std::memory_order_relaxed);
  }

 private:
  /// Calls end() when it is destroyed, so also after an exception.
  struct EndOfWork {
    TeamThreads* threads;  // null: the work is not timed
    TimedWork kind;
    std::size_t amount;
    ~EndOfWork() {
      if (threads) threads->end(kind, amount);
    }
  };

  std::shared_ptr<TeamThreads> threads_;
};

namespace detail {

/// A sum over 0 .. count - 1 whose bits do not depend on the team: parts, whose number depends on
/// count alone, are summed each by itself, then in their order.
/// @tparam Sum  has add(Sum); Sum{} is the empty sum
/// @param  part function: part(begin, end) returns the sum over begin .. end - 1
template <class Sum, class Part>
Sum sum_of_parts(const Team& team, std::size_t count, const Part& part) {
  constexpr int most = 16;
  const int parts = count < 1024 ? 1 : most;
  std::array<Sum, std::size_t(most)> sums{};
  team.share_each(std::size_t(parts), 1, [&](std::size_t p) {
    const Share share(count, int(p), parts);
    sums[p] = part(share.begin, share.end);
  });
  for (std::size_t p = 1; p < std::size_t(parts); ++p) sums[0].add(sums[p]);
  return sums[0];
}
/// The same.
/// @param add function: add(sum, i) adds what belongs to i
template <class Sum, class Add>
Sum sum_of(const Team& team, std::size_t count, const Add& add) {
  return sum_of_parts<Sum>(team, count, [&](std::size_t begin, std::size_t end) {
    Sum sum{};
    for (std::size_t i = begin; i < end; ++i) detail::call(add, sum, i);
    return sum;
  });
}

}  // namespace detail

}  // namespace moreau
