// SPDX-License-Identifier: MIT
// The processes of a distributed simulation: the ranks of an MPI communicator. Needs MPI.
//
// Sums are made on rank 0 and sent to all, so that all ranks get the same bits and take the same
// decisions.
#pragma once

#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mpi.h>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"

namespace moreau {

/// Starts MPI in its constructor, unless it runs already, and ends it in its destructor. Make one at
/// the beginning of main().
class MpiSession {
 public:
  /// @param argc,argv the arguments of main(); MPI can take its own options out of them
  MpiSession(int& argc, char**& argv) {
    int runs = 0;
    MPI_Initialized(&runs);
    mine_ = runs == 0;
    // Threads of a team share the work of a step; the thread of main() alone sends messages.
    int given = 0;  // level of threads; FUNNELED is the least that a threaded program can have
    if (mine_) MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
  }
  ~MpiSession() {
    if (mine_) MPI_Finalize();
  }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

 private:
  bool mine_ = false;
};

/// Messages between processes that this process has sent, and operations that all processes take part
/// in.
struct Traffic {
  std::uint64_t messages = 0;     ///< from this process to one other
  std::uint64_t bytes = 0;        ///< in these messages
  std::uint64_t collectives = 0;  ///< sums, largest values, broadcasts, exchanges
  double seconds = 0;  ///< in messages and operations, with the time of waiting for others

  /// The traffic since `before`.
  Traffic operator-(const Traffic& before) const {
    return {messages - before.messages, bytes - before.bytes, collectives - before.collectives,
            seconds - before.seconds};
  }
};

/// A communicator of its own with the processes of another one. All processes call its functions in
/// the same order. It must end before MPI does (MpiSession).
class Communicator {
 public:
  /// Duplicates `processes`, so that messages do not meet those of the user. All processes call it.
  explicit Communicator(MPI_Comm processes = MPI_COMM_WORLD) {
    MPI_Comm_dup(processes, &handle_);
    MPI_Comm_rank(handle_, &rank_);
    MPI_Comm_size(handle_, &size_);
  }
  ~Communicator() { MPI_Comm_free(&handle_); }
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }                   ///< of this process, 0 .. size() - 1
  int size() const { return size_; }                   ///< number of processes
  MPI_Comm handle() const { return handle_; }          ///< for functions of MPI
  const Traffic& traffic() const { return traffic_; }  ///< since the construction

  /// Replaces each value by its sum over all processes.
  void sum(std::span<double> values) { combine(values, MPI_SUM); }
  void sum(std::span<float> values) { combine(values, MPI_SUM); }         ///< the same
  void sum(std::span<std::int64_t> values) { combine(values, MPI_SUM); }  ///< the same
  /// Replaces each value by its largest over all processes.
  void largest(std::span<double> values) { combine(values, MPI_MAX); }
  /// The largest of one value per process.
  double largest(double value) {
    largest(std::span(&value, 1));
    return value;
  }
  /// The sum of one value per process.
  double sum(double value) {
    sum(std::span(&value, 1));
    return value;
  }

  /// Sends the bytes of rank 0 to all processes.
  void broadcast(std::string& bytes) {
    const Watch watch(traffic_.seconds);
    auto count = static_cast<std::uint64_t>(bytes.size());
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, handle_);
    bytes.resize(count);
    for (std::size_t k = 0; k < bytes.size(); k += chunk)
      MPI_Bcast(bytes.data() + k, int(std::min(chunk, bytes.size() - k)), MPI_BYTE, 0, handle_);
    ++traffic_.collectives;
  }
  /// Sends bytes from every process to every other one.
  /// @param out one string per rank: size() of them
  /// @returns what each rank has sent to this one
  std::vector<std::string> exchange(std::vector<std::string> out) {
    MOREAU_ASSERT(out.size() == std::size_t(size_));
    std::vector<std::uint64_t> sizes, coming(out.size());
    for (const std::string& one : out) sizes.push_back(one.size());
    {
      const Watch watch(traffic_.seconds);
      MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, handle_);
    }
    ++traffic_.collectives;
    std::vector<std::string> in(out.size());
    in[std::size_t(rank_)] = std::move(out[std::size_t(rank_)]);
    for (int other = 0; other < size_; ++other) {
      if (other == rank_) continue;
      std::string& bytes = in[std::size_t(other)];
      bytes.resize(coming[std::size_t(other)]);
      receive(bytes.data(), bytes.size(), other);
    }
    for (int other = 0; other < size_; ++other)
      if (other != rank_)
        send(out[std::size_t(other)].data(), out[std::size_t(other)].size(), other);
    wait();
    return in;
  }
  /// The bytes of all ranks, on rank 0; an empty list on the others.
  std::vector<std::string> gather(std::string bytes) {
    std::vector<std::string> out{std::size_t(size_)};
    out[0] = std::move(bytes);
    std::vector<std::string> in = exchange(std::move(out));
    return rank_ == 0 ? std::move(in) : std::vector<std::string>();
  }

  /// Begins to send `count` bytes to another rank; they must stay until wait() returns.
  void send(const void* bytes, std::size_t count, int to) {
    for (std::size_t k = 0; k < count; k += chunk) {
      MPI_Isend(static_cast<const char*>(bytes) + k, int(std::min(chunk, count - k)), MPI_BYTE, to,
                tag, handle_, &requests_.emplace_back());
      ++traffic_.messages;
    }
    traffic_.bytes += count;
  }
  /// Begins to receive `count` bytes from another rank.
  void receive(void* bytes, std::size_t count, int from) {
    for (std::size_t k = 0; k < count; k += chunk)
      MPI_Irecv(static_cast<char*>(bytes) + k, int(std::min(chunk, count - k)), MPI_BYTE, from, tag,
                handle_, &requests_.emplace_back());
  }
  /// Returns when all that was begun is done.
  void wait() {
    const Watch watch(traffic_.seconds);
    MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    requests_.clear();
  }

  /// Ends all processes after one message, which names this rank.
  [[noreturn]] void end_all(const std::string& message) const {
    std::fprintf(stderr, "moreau: rank %d of %d: %s\n", rank_, size_, message.c_str());
    std::fflush(stderr);
    MPI_Abort(handle_, 1);
    std::abort();
  }

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 30;  // MPI counts in int
  static constexpr int tag = 1;

  /// Adds the time of its life to a sum [s].
  class Watch {
   public:
    explicit Watch(double& sum) : sum_(sum), begin_(MPI_Wtime()) {}
    ~Watch() { sum_ += MPI_Wtime() - begin_; }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    double& sum_;
    double begin_;
  };

  template <class T>
  void combine(std::span<T> values, MPI_Op operation) {
    const Watch watch(traffic_.seconds);
    const MPI_Datatype type = std::is_same_v<T, double>  ? MPI_DOUBLE
                              : std::is_same_v<T, float> ? MPI_FLOAT
                                                         : MPI_INT64_T;
    const auto count = static_cast<int>(values.size());
    if (rank_ == 0)
      MPI_Reduce(MPI_IN_PLACE, values.data(), count, type, operation, 0, handle_);
    else
      MPI_Reduce(values.data(), nullptr, count, type, operation, 0, handle_);
    MPI_Bcast(values.data(), count, type, 0, handle_);
    ++traffic_.collectives;
  }

  MPI_Comm handle_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  std::vector<MPI_Request> requests_;
  Traffic traffic_;
};

}  // namespace moreau
