// SPDX-License-Identifier: MIT
// Optional: a team of threads (see team.hpp). The only header of the library that needs a library
// of threads: link Threads::Threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/team.hpp"

namespace moreau {

namespace detail {

/// Returns once a value is no longer what it was: turns for a while, because that is mostly
/// microseconds away, then sleeps, because there may be fewer cores than threads.
inline void await_change(const std::atomic<std::uint32_t>& value, std::uint32_t was) {
  constexpr int turns = 20000;
  for (int turn = 0; turn < turns; ++turn)
    if (value.load(std::memory_order_acquire) != was) return;
  value.wait(was, std::memory_order_acquire);
}

/// A place where the members of a team wait for one another, any number of times.
class MeetingPoint {
 public:
  explicit MeetingPoint(int size) : size_(size) {}
  void operator()() {
    const std::uint32_t round = round_.load(std::memory_order_relaxed);
    if (here_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
      here_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      round_.notify_all();
    } else {
      await_change(round_, round);
    }
  }

 private:
  const int size_;
  alignas(64) std::atomic<int> here_{0};
  alignas(64) std::atomic<std::uint32_t> round_{0};
};

/// Threads that wait for work until they are destroyed.
class ThreadPool {
 public:
  explicit ThreadPool(int size) : size_(size), meeting_(size) {
    for (int rank = 1; rank < size; ++rank) threads_.emplace_back([this, rank] { work(rank); });
  }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool() {
    call_ = nullptr;
    start();
    for (std::thread& thread : threads_) thread.join();
  }

  int size() const { return size_; }
  MeetingPoint& meeting() { return meeting_; }

  template <class Work>
  void run(Work& work) {
    call_ = [](void* object, int rank, ThreadPool& pool) {
      (*static_cast<Work*>(object))(rank, pool.size_, pool.meeting_);
    };
    object_ = &work;
    start();
    work(0, size_, meeting_);
    meeting_();
  }

 private:
  void start() {
    task_.fetch_add(1, std::memory_order_release);
    task_.notify_all();
  }
  void work(int rank) {
    std::uint32_t seen = 0;
    while (true) {
      await_change(task_, seen);
      ++seen;
      if (!call_) return;
      call_(object_, rank, *this);
      meeting_();
    }
  }

  const int size_;
  MeetingPoint meeting_;
  void (*call_)(void*, int, ThreadPool&) = nullptr;
  void* object_ = nullptr;
  alignas(64) std::atomic<std::uint32_t> task_{0};
  std::vector<std::thread> threads_;
};

}  // namespace detail

/// A team of threads, the caller's own among them. Copies share the threads; one piece of work at a
/// time.
class ThreadTeam {
 public:
  /// Starts the threads, one fewer than said: the caller's own is one of them.
  /// @throws std::invalid_argument for less than one thread
  explicit ThreadTeam(int threads = 1) {
    require(threads >= 1, "ThreadTeam", "threads", threads, "must be at least 1");
    pool_ = std::make_shared<detail::ThreadPool>(threads);
  }
  int size() const { return pool_->size(); }  ///< members, the calling thread included

  /// See Team.
  template <class Work>
  void run(Work&& work) const {
    if (size() == 1)
      work(0, 1, pool_->meeting());
    else
      pool_->run(work);
  }

 private:
  std::shared_ptr<detail::ThreadPool> pool_;
};

/// ColouredGaussSeidel by several threads: the same bits, whatever their number.
class ParallelGaussSeidel : public TeamGaussSeidel<ThreadTeam> {
 public:
  /// @param options as ColouredGaussSeidel's
  /// @param threads at least 1; copies of the solver share them
  /// @throws std::invalid_argument as ColouredGaussSeidel, and for less than one thread
  explicit ParallelGaussSeidel(const Options& options = {}, int threads = 1)
      : TeamGaussSeidel(options, ThreadTeam(threads)) {}
};

}  // namespace moreau
