// SPDX-License-Identifier: MIT
// Optional: a team of threads, see team.hpp. The only header of the library that needs threads:
// link Threads::Threads.
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

/// Returns once a value has changed. Spins at first, because the change mostly takes microseconds,
/// then sleeps, because there may be fewer cores than threads.
inline void await_change(const std::atomic<std::uint32_t>& value, std::uint32_t was) {
  constexpr int spins = 20000;
  for (int spin = 0; spin < spins; ++spin)
    if (value.load(std::memory_order_acquire) != was) return;
  value.wait(was, std::memory_order_acquire);
}

/// A barrier for the members of a team, to be used any number of times.
class Barrier {
 public:
  explicit Barrier(int size) : size_(size) {}
  /// Returns once all members have called it.
  void wait() {
    const std::uint32_t round = round_.load(std::memory_order_relaxed);
    if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
      waiting_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      round_.notify_all();
    } else {
      await_change(round_, round);
    }
  }

 private:
  const int size_;
  alignas(64) std::atomic<int> waiting_{0};
  alignas(64) std::atomic<std::uint32_t> round_{0};
};

/// Threads that wait for work until the pool is destroyed.
class ThreadPool {
 public:
  explicit ThreadPool(int size) : size_(size), barrier_(size) {
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
  /// The barrier of the members, as a function.
  auto wait() {
    return [this] { barrier_.wait(); };
  }

  template <class Work>
  void run(Work& work) {
    call_ = [](void* object, int rank, ThreadPool& pool) {
      (*static_cast<Work*>(object))(rank, pool.size_, pool.wait());
    };
    object_ = &work;
    start();
    call_(object_, 0, *this);
    barrier_.wait();
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
      barrier_.wait();
    }
  }

  const int size_;
  Barrier barrier_;
  void (*call_)(void*, int, ThreadPool&) = nullptr;
  void* object_ = nullptr;
  alignas(64) std::atomic<std::uint32_t> task_{0};
  std::vector<std::thread> threads_;
};

}  // namespace detail

/// A team of threads, the calling thread among them. Copies share the threads. They do one piece of
/// work at a time.
class ThreadTeam {
 public:
  /// Starts threads - 1 threads: the calling thread is a member.
  /// @throws std::invalid_argument for fewer than one thread
  explicit ThreadTeam(int threads = 1) {
    require(threads >= 1, "ThreadTeam", "threads", threads, "must be at least 1");
    pool_ = std::make_shared<detail::ThreadPool>(threads);
  }
  int size() const { return pool_->size(); }  ///< number of members, the calling thread included

  /// See Team.
  template <class Work>
  void run(Work&& work) const {
    if (size() == 1)
      work(0, 1, pool_->wait());
    else
      pool_->run(work);
  }

 private:
  std::shared_ptr<detail::ThreadPool> pool_;
};

/// ColouredGaussSeidel on several threads; the bits of the result do not depend on their number.
class ParallelGaussSeidel : public TeamGaussSeidel<ThreadTeam> {
 public:
  /// @param options of ColouredGaussSeidel
  /// @param threads at least 1; copies of the solver share them
  /// @throws std::invalid_argument as ColouredGaussSeidel, and for fewer than one thread
  explicit ParallelGaussSeidel(const Options& options = {}, int threads = 1)
      : TeamGaussSeidel(options, ThreadTeam(threads)) {}
};

}  // namespace moreau
