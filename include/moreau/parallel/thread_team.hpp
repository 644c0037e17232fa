// SPDX-License-Identifier: MIT
// Optional: a team of threads, see team.hpp. The only header of the library that needs threads:
// link Threads::Threads.
//
// On a machine with other programs a member may not run while the others wait for it. So the team
// measures: it shares a kind of work only while this is faster. It starts with the calling thread
// alone and tries both ways on a few pieces of work; after a trial that sharing loses, it tries again
// after an interval, which doubles.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau {

namespace detail {

/// Returns once a value has changed. Spins at first, because the change mostly takes microseconds;
/// then lets other threads run, because there may be fewer cores than threads; then sleeps.
inline void await_change(const std::atomic<std::uint32_t>& value, std::uint32_t was) {
  constexpr int spins = 20000;  // some 20 microseconds
  for (int spin = 0; spin < spins; ++spin)
    if (value.load(std::memory_order_acquire) != was) return;
  using Clock = std::chrono::steady_clock;
  const auto sleep_at = Clock::now() + std::chrono::milliseconds(2);
  while (Clock::now() < sleep_at) {
    std::this_thread::yield();
    if (value.load(std::memory_order_acquire) != was) return;
  }
  value.wait(was, std::memory_order_acquire);
}

/// A barrier for the members of a team, to be used any number of times.
class Barrier {
 public:
  explicit Barrier(int size) : size_(size) {}
  /// Returns once all members have called it that have not left.
  void wait() {
    const std::uint32_t round = round_.load(std::memory_order_relaxed);
    if (!arrive()) await_change(round_, round);
  }
  /// Leaves: the others no longer wait for this member.
  void leave() {
    left_.fetch_add(1, std::memory_order_relaxed);
    arrive();
  }
  /// All members are back. Call it while none of them uses the barrier.
  void reset() {
    left_.store(0, std::memory_order_relaxed);
    waiting_.store(0, std::memory_order_relaxed);
  }

 private:
  /// @returns whether this was the last member, which releases the others
  bool arrive() {
    if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 < size_) return false;
    waiting_.store(left_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    // Not a plain store: notify_all() must not look for sleepers before it.
    round_.fetch_add(1, std::memory_order_seq_cst);
    round_.notify_all();
    return true;
  }

  const int size_;
  alignas(64) std::atomic<int> waiting_{0};
  std::atomic<int> left_{0};
  alignas(64) std::atomic<std::uint32_t> round_{0};
};

/// Decides whether to share one kind of work, from its times. In a trial, pieces of work are done
/// alone and shared in turn. If sharing wins, its mean time is watched, not its median: a thread that the system does not
/// run delays only a few pieces of work, but each of them by much more than a piece takes.
class ShareTuner {
 public:
  bool shares() const { return left_ > 0 ? left_ % 2 == 0 : shares_; }
  /// @param time per unit of the last piece of work, which was shared or not as shares() had answered
  void measured(double time) {
    if (left_ > 0)
      try_out(time);
    else if (shares_)
      watch(time);
    else if (--wait_ <= 0)
      start_trial();
  }

 private:
  static constexpr int pieces = 12, warm_up = 4, first = 4, shortest = 64, longest = 4096;
  static constexpr int windows_per_trial = 16;
  /// Times of pieces done in one way.
  struct Times {
    double sum = 0, most = 0;
    int count = 0;
    void add(double time) {
      sum += time;
      most = std::max(most, time);
      ++count;
    }
    /// The mean without the largest.
    double typical() const { return count > 1 ? (sum - most) / (count - 1) : sum; }
  };

  void start_trial() {
    left_ = pieces;
    alone_ = shared_ = Times{};
  }
  void try_out(double time) {
    const bool was_shared = shares();
    --left_;
    if (!was_shared) alone_.add(time);
    const bool stalled = was_shared && alone_.count > 0 && time > 10 * alone_.typical();
    if (was_shared && (stalled || left_ < pieces - warm_up)) shared_.add(time);
    if (stalled) left_ = 0;
    if (left_ > 0) return;
    shares_ = !stalled && shared_.typical() < alone_.typical();
    windows_ = 0;
    start_window();
    if (!shares_) stay_alone(shared_.sum - shared_.count * alone_.typical());
  }
  void watch(double time) {
    sum_ += time;
    ++count_;
    if (sum_ > shortest * alone_.typical()) {
      stay_alone(sum_ - count_ * alone_.typical());
    } else if (count_ == shortest) {
      interval_ = shortest;
      start_window();
      if (++windows_ == windows_per_trial) start_trial();
    }
  }
  void start_window() {
    sum_ = 0;
    count_ = 0;
  }
  /// @param loss time that sharing took more than working alone; it is at most 5 % of what follows
  void stay_alone(double loss) {
    shares_ = false;
    const double pieces_to_wait = std::min(1e6, 20 * loss / alone_.typical());
    wait_ = std::max(interval_, static_cast<int>(pieces_to_wait));
    interval_ = std::min(2 * interval_, longest);
  }

  bool shares_ = false;
  int left_ = 0, wait_ = first, interval_ = shortest, count_ = 0, windows_ = 0;
  double sum_ = 0;
  Times alone_, shared_;
};

/// Threads that wait for work until the pool is destroyed.
class ThreadPool final : public TeamThreads {
 public:
  explicit ThreadPool(int size)
      : size_(size), barrier_(size), end_(size), errors_(std::size_t(size)) {
    try {
      for (int rank = 1; rank < size; ++rank)
        threads_.emplace_back([this, rank] { await_work(rank); });
    } catch (...) {
      end_threads();
      throw;
    }
  }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool() override { end_threads(); }

  int size() const override { return size_; }

  void run(const Work& work) override {
    if (size_ == 1 || busy_.exchange(true, std::memory_order_acquire)) {
      work(0, 1, TeamBarrier());
      return;
    }
    work_ = &work;
    barrier_.reset();
    start();
    take_part(0);
    end_.wait();
    // That of the lowest rank, which has the first part of the work: the error of one thread.
    std::exception_ptr first;
    for (std::exception_ptr& error : errors_) {
      if (!first) first = error;
      error = nullptr;
    }
    busy_.store(false, std::memory_order_release);  // last: another simulation may begin
    if (first) std::rethrow_exception(first);
  }

  /// Times the work of one thread at a time; that of other simulations is done alone meanwhile.
  bool begin(TimedWork kind) override {
    if (size_ == 1) return false;
    std::thread::id nobody;
    if (!timed_.compare_exchange_strong(nobody, std::this_thread::get_id())) return false;
    began_ = Clock::now();
    return tuners_[std::size_t(kind)].shares();
  }
  void end(TimedWork kind, std::size_t amount) override {
    if (timed_.load() != std::this_thread::get_id()) return;
    const std::chrono::duration<double> time = Clock::now() - began_;
    tuners_[std::size_t(kind)].measured(time.count() / double(std::max<std::size_t>(1, amount)));
    timed_.store(std::thread::id());
  }

 private:
  using Clock = std::chrono::steady_clock;

  void start() {
    task_.fetch_add(1, std::memory_order_release);
    task_.notify_all();
  }
  void end_threads() {
    work_ = nullptr;
    start();
    for (std::thread& thread : threads_) thread.join();
  }
  void take_part(int rank) {
    try {
      (*work_)(rank, size_, TeamBarrier(&barrier_, [](void* barrier) {
                 static_cast<Barrier*>(barrier)->wait();
               }));
    } catch (...) {
      errors_[std::size_t(rank)] = std::current_exception();
      barrier_.leave();
    }
  }
  void await_work(int rank) {
    std::uint32_t seen = 0;
    while (true) {
      await_change(task_, seen);
      ++seen;
      if (!work_) return;
      take_part(rank);
      end_.wait();
    }
  }

  const int size_;
  Barrier barrier_, end_;
  std::vector<std::exception_ptr> errors_;
  const Work* work_ = nullptr;  // null: the threads end
  std::atomic<bool> busy_{false};
  std::array<ShareTuner, std::size_t(TimedWork::full_sweep) + 1> tuners_;  // one per TimedWork
  std::atomic<std::thread::id> timed_{std::thread::id()};  // whose work is timed; default: nobody's
  Clock::time_point began_;
  alignas(64) std::atomic<std::uint32_t> task_{0};
  std::vector<std::thread> threads_;
};

}  // namespace detail

/// A team of threads, the calling thread among them. Give it to Simulation::set_team, or to a solver
/// that is used by itself. Results have the same bits for any number of threads. Copies share the
/// threads, see Team.
class ThreadTeam : public Team {
 public:
  /// Starts threads - 1 threads: the calling thread is a member.
  /// @param threads at least 1; as many as there are cores, or fewer
  /// @throws std::invalid_argument for fewer than one thread, std::system_error if a thread cannot
  ///         be started
  explicit ThreadTeam(int threads) : Team(pool(threads)) {}

 private:
  static std::shared_ptr<TeamThreads> pool(int threads) {
    require(threads >= 1, "ThreadTeam", "threads", threads, "must be at least 1");
    if (threads == 1) return nullptr;
    try {
      return std::make_shared<detail::ThreadPool>(threads);
    } catch (const std::system_error& error) {
      throw std::system_error(error.code(), "ThreadTeam: threads = " + std::to_string(threads));
    }
  }
};

}  // namespace moreau
