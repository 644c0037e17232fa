// SPDX-License-Identifier: MIT
// The bodies that the processes of a distributed simulation share in a step, and the exchange of
// their velocities.
//
// A grain is shared by the ranks that have contacts with it. Its owner takes part, too, even if it
// has none, because it moves the grain. Each rank with contacts sends its velocity to all that take
// part, and each of them computes the mean in the order of the ranks: one message to each neighbour
// per sweep, and the same bits everywhere. Walls that move under contacts are shared by all ranks; the
// mean of their velocities is made on rank 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/rank_topology.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// @tparam S    space of the bodies
/// @tparam Base SharedBodies, or a class derived from it
template <class S, class Base = SharedBodies>
class RankSharing : public Base {
 public:
  /// @param processes must outlive the object
  explicit RankSharing(Communicator& processes)
      : processes_(processes), peers_(std::size_t(processes.size())) {}

  /// The topology, which may be changed between two steps.
  RankTopology topology;

  void find(std::span<const unsigned char> touched) override {
    copies_.assign(touched.size(), 1);
    for (Peer& peer : peers_) peer.send.clear(), peer.receive.clear();
    shared_.clear();
    sources_.clear();
    find_grains(touched);
    find_walls(touched);
  }
  int copies(std::size_t body) const override { return copies_[body]; }
  bool owns(std::size_t body) const override {
    const int owner = topology.owner[body];
    return owner == RankTopology::everywhere ? topology.rank == 0 : owner == topology.rank;
  }
  void average(std::span<double> velocities, std::size_t width) override {
    average_all(velocities, width);
  }
  void average(std::span<float> velocities, std::size_t width) override {
    average_all(velocities, width);
  }
  void sum(std::span<double> values) override { processes_.sum(values); }
  void largest(std::span<double> values) override { processes_.largest(values); }

  /// Number of grains of which this process has a copy that it averages.
  std::size_t shared_grains() const { return shared_.size(); }

 protected:
  using Flags = std::vector<unsigned char>;
  /// The data that are exchanged with one rank.
  struct Peer {
    std::vector<std::uint32_t> send, receive;  // bodies, ascending
    // Whether the other rank touches each grain that this rank lends it, and this rank each ghost.
    Flags lent_touched, ghosts_touched;
    // For each of these that is touched: the number of ranks that touch it, and the ranks.
    std::vector<std::int32_t> sent_ranks, received_ranks;
    std::uint32_t sent_count, received_count;  // their lengths
    std::vector<unsigned char> out, in;
  };
  /// A shared grain.
  struct Shared {
    std::uint32_t body, first;  // its first source
    std::int32_t copies;
  };
  /// Where the velocity of a copy comes from: the n-th grain that a rank sends, or this rank.
  struct Source {
    std::int32_t rank;
    std::uint32_t number;
  };

  /// The owner of every grain learns which ranks touch it, and tells them.
  void find_grains(std::span<const unsigned char> touched) {
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      peer.ghosts_touched.clear();
      for (const std::uint32_t i : topology.ghosts[other])
        peer.ghosts_touched.push_back(touched[i]);
      peer.lent_touched.resize(topology.lent[other].size());
      processes_.receive(peer.lent_touched.data(), peer.lent_touched.size(), int(other));
      processes_.send(peer.ghosts_touched.data(), peer.ghosts_touched.size(), int(other));
    }
    processes_.wait();
    gather_ranks(touched);
    send_ranks();
    for (std::size_t g = 0; g < grains_.size(); ++g)
      share(grains_[g].first,
            std::span(ranks_).subspan(grains_[g].second.first, grains_[g].second.second),
            topology.rank);
    take_ranks();
    // Bodies in ascending order, so that both sides of a message agree about its content.
    std::sort(shared_.begin(), shared_.end(),
              [](const Shared& a, const Shared& b) { return a.body < b.body; });
    for (const Shared& one : shared_) list(one);
  }
  /// Lists the ranks with contacts of every grain of this rank that another rank touches.
  void gather_ranks(std::span<const unsigned char> touched) {
    touching_.clear();
    for (std::size_t other = 0; other < peers_.size(); ++other)
      for (std::size_t k = 0; k < topology.lent[other].size(); ++k)
        if (peers_[other].lent_touched[k])
          touching_.push_back({topology.lent[other][k], std::int32_t(other)});
    const std::size_t others = touching_.size();
    for (std::size_t k = 0; k < others; ++k)
      if (touched[touching_[k].first])
        touching_.push_back({touching_[k].first, std::int32_t(topology.rank)});
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
    grains_.clear();
    ranks_.clear();
    for (const auto& [body, rank] : touching_) {
      if (grains_.empty() || grains_.back().first != body)
        grains_.push_back({body, {ranks_.size(), 0}});
      ++grains_.back().second.second;
      ranks_.push_back(rank);
    }
  }
  /// Tells each rank that touches a grain of this rank which other ranks do.
  void send_ranks() {
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      peer.sent_ranks.clear();
      for (std::size_t k = 0; k < topology.lent[other].size(); ++k) {
        if (!peer.lent_touched[k]) continue;
        const auto grain =
            std::lower_bound(grains_.begin(), grains_.end(), topology.lent[other][k],
                             [](const auto& one, std::uint32_t body) { return one.first < body; });
        const auto [first, count] = grain->second;
        peer.sent_ranks.push_back(std::int32_t(count));
        peer.sent_ranks.insert(peer.sent_ranks.end(), ranks_.begin() + std::ptrdiff_t(first),
                               ranks_.begin() + std::ptrdiff_t(first + count));
      }
    }
    // First how many numbers there are, then the numbers.
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      peer.sent_count = std::uint32_t(peer.sent_ranks.size());
      peer.received_count = 0;
      if (!topology.ghosts[other].empty())
        processes_.receive(&peer.received_count, sizeof peer.received_count, int(other));
      if (!topology.lent[other].empty())
        processes_.send(&peer.sent_count, sizeof peer.sent_count, int(other));
    }
    processes_.wait();
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      peer.received_ranks.resize(peer.received_count);
      processes_.receive(peer.received_ranks.data(),
                         peer.received_ranks.size() * sizeof(std::int32_t), int(other));
      processes_.send(peer.sent_ranks.data(), peer.sent_ranks.size() * sizeof(std::int32_t),
                      int(other));
    }
    processes_.wait();
  }
  /// Shares the ghosts that this rank touches with the ranks that their owners have sent.
  void take_ranks() {
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      const Peer& peer = peers_[other];
      std::size_t at = 0;
      for (std::size_t k = 0; k < topology.ghosts[other].size(); ++k) {
        if (!peer.ghosts_touched[k]) continue;
        const auto count = std::size_t(peer.received_ranks[at++]);
        share(topology.ghosts[other][k], std::span(peer.received_ranks).subspan(at, count),
              int(other));
        at += count;
      }
    }
  }
  /// Notes that a grain has copies on some ranks.
  void share(std::uint32_t body, std::span<const std::int32_t> ranks, int owner) {
    copies_[body] = int(ranks.size());
    if (ranks.size() == 1 && ranks[0] == owner) return;
    shared_.push_back({body, std::uint32_t(sources_.size()), std::int32_t(ranks.size())});
    for (const std::int32_t rank : ranks) sources_.push_back({rank, 0});
  }
  /// Lists a shared grain in the messages.
  void list(const Shared& one) {
    const auto sources = std::span(sources_).subspan(one.first, std::size_t(one.copies));
    const std::int32_t self = topology.rank, owner = topology.owner[one.body];
    bool sends = false, owner_has = false;
    for (const Source& source : sources) {
      sends = sends || source.rank == self;
      owner_has = owner_has || source.rank == owner;
    }
    for (Source& source : sources) {
      if (source.rank == self) continue;
      Peer& peer = peers_[std::size_t(source.rank)];
      source.number = std::uint32_t(peer.receive.size());
      peer.receive.push_back(one.body);
      if (sends) peer.send.push_back(one.body);
    }
    if (sends && !owner_has && owner != self) peers_[std::size_t(owner)].send.push_back(one.body);
  }

  void find_walls(std::span<const unsigned char> touched) {
    walls_.clear();
    if (topology.walls.empty()) return;
    wall_counts_.clear();
    for (const std::uint32_t wall : topology.walls) wall_counts_.push_back(touched[wall]);
    processes_.sum(std::span(wall_counts_));
    for (std::size_t k = 0; k < wall_counts_.size(); ++k) {
      if (wall_counts_[k] == 0) continue;
      const std::uint32_t wall = topology.walls[k];
      copies_[wall] = int(wall_counts_[k]);
      walls_.push_back({wall, touched[wall] != 0});
    }
  }

  /// Sends the values of the bodies in the list `send` of each rank, and receives those of the bodies
  /// in its list `receive`, which then lie in `in`, one after another.
  /// @param width number of values per body, the distance of two bodies in `values`
  /// @param bytes how much of the values of a body is exchanged
  template <class T>
  void exchange(std::span<const T> values, std::size_t width, std::size_t bytes) {
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      peer.in.resize(peer.receive.size() * bytes);
      peer.out.resize(peer.send.size() * bytes);
      processes_.receive(peer.in.data(), peer.in.size(), int(other));
      for (std::size_t k = 0; k < peer.send.size(); ++k)
        std::memcpy(peer.out.data() + k * bytes, &values[peer.send[k] * width], bytes);
      processes_.send(peer.out.data(), peer.out.size(), int(other));
    }
    processes_.wait();
  }
  template <class T>
  void average_all(std::span<T> velocities, std::size_t width) {
    constexpr std::size_t entries = S::dofs, bytes = entries * sizeof(T);
    exchange(std::span<const T>(velocities), width, bytes);
    for (const Shared& one : shared_) {
      std::array<T, entries> sum{}, copy{};
      T* own = &velocities[one.body * width];
      for (std::int32_t k = 0; k < one.copies; ++k) {
        const Source& source = sources_[one.first + std::uint32_t(k)];
        const bool here = source.rank == topology.rank;
        std::memcpy(copy.data(),
                    here ? static_cast<const void*>(own)
                         : peers_[std::size_t(source.rank)].in.data() + source.number * bytes,
                    bytes);
        for (std::size_t e = 0; e < entries; ++e) sum[e] += copy[e];
      }
      for (std::size_t e = 0; e < entries; ++e) own[e] = sum[e] / T(one.copies);
    }
    average_walls(velocities, width);
  }
  template <class T>
  void average_walls(std::span<T> velocities, std::size_t width) {
    if (walls_.empty()) return;
    constexpr std::size_t entries = S::dofs;
    auto& sums = std::get<std::vector<T>>(wall_sums_);
    sums.assign(walls_.size() * entries, 0);
    for (std::size_t k = 0; k < walls_.size(); ++k)
      if (walls_[k].second)
        std::copy_n(&velocities[walls_[k].first * width], entries, &sums[k * entries]);
    processes_.sum(std::span(sums));
    for (std::size_t k = 0; k < walls_.size(); ++k)
      for (std::size_t e = 0; e < entries; ++e)
        velocities[walls_[k].first * width + e] =
            sums[k * entries + e] / T(copies_[walls_[k].first]);
  }

  Communicator& processes_;
  std::vector<int> copies_;  // one per body
  std::vector<Peer> peers_;  // one per rank
  std::vector<Shared> shared_;
  std::vector<Source> sources_;
  std::vector<std::pair<std::uint32_t, bool>>
      walls_;                        // moving walls, and whether this rank has contacts
  std::vector<double> wall_counts_;  // ranks that touch each wall
  std::tuple<std::vector<double>, std::vector<float>> wall_sums_;  // velocities
  // Grains of this rank that others touch: (body, (first, count) in ranks_).
  std::vector<std::pair<std::uint32_t, std::pair<std::size_t, std::size_t>>> grains_;
  std::vector<std::int32_t> ranks_;
  std::vector<std::pair<std::uint32_t, std::int32_t>> touching_;  // (body, rank)
};

}  // namespace moreau::detail
