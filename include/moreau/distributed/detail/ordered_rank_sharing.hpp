// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/ordered_sharing.hpp"
#include "moreau/distributed/detail/rank_sharing.hpp"

namespace moreau::detail {

/// Bodies that the ranks share without splitting them; see OrderedSharing.
template <class S>
class OrderedRankSharing : public RankSharing<S, OrderedSharing> {
  using Base = RankSharing<S, OrderedSharing>;

 public:
  using Base::Base;
  using Base::topology;

  int copies(std::size_t) const override { return 1; }
  std::uint32_t id(std::size_t body) const override { return topology.ids[body].value; }

  std::vector<std::uint32_t> moving_walls() const override {
    std::vector<std::uint32_t> moving;
    for (const auto& [wall, touched] : walls_) moving.push_back(wall);
    return moving;
  }
  void take_largest(std::span<std::uint64_t> values, std::size_t width) override {
    combine(values, width, [](std::uint64_t a, std::uint64_t b) { return std::max(a, b); });
  }
  void unite_bits(std::span<std::uint64_t> values, std::size_t width) override {
    combine(values, width, [](std::uint64_t a, std::uint64_t b) { return a | b; });
  }
  void add(std::span<std::int64_t> values) override { processes_.sum(values); }

  void plan(std::span<const PhaseVisit> visits, std::size_t) override {
    std::vector<std::string> out;
    outgoing_.assign(peers_.size(), {});
    incoming_.assign(peers_.size(), {});
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      // (phase, number in the list of grains that go to this rank), ascending.
      std::vector<PhaseVisit>& list = outgoing_[other];
      const std::vector<std::uint32_t>& send = peers_[other].send;
      for (const PhaseVisit& visit : visits) {
        const auto found = std::lower_bound(send.begin(), send.end(), visit.body);
        if (found != send.end() && *found == visit.body)
          list.push_back({visit.phase, std::uint32_t(found - send.begin())});
      }
      std::sort(list.begin(), list.end(), before);
      out.emplace_back(reinterpret_cast<const char*>(list.data()), list.size() * sizeof list[0]);
    }
    const std::vector<std::string> in = processes_.exchange(std::move(out));
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      incoming_[other].resize(in[other].size() / sizeof(PhaseVisit));
      std::memcpy(incoming_[other].data(), in[other].data(), in[other].size());
      for (PhaseVisit& visit : outgoing_[other]) visit.body = peers_[other].send[visit.body];
      for (PhaseVisit& visit : incoming_[other]) visit.body = peers_[other].receive[visit.body];
    }
  }
  void pass_on(std::size_t phase, std::span<double> velocities, std::size_t width) override {
    pass(phase, velocities, width);
  }
  void pass_on(std::size_t phase, std::span<float> velocities, std::size_t width) override {
    pass(phase, velocities, width);
  }

 private:
  using Base::peers_;
  using Base::processes_;
  using Base::walls_;
  using typename Base::Peer;

  static bool before(const PhaseVisit& a, const PhaseVisit& b) {
    return a.phase != b.phase ? a.phase < b.phase : a.body < b.body;
  }
  /// The entries of one phase.
  static std::span<const PhaseVisit> of_phase(const std::vector<PhaseVisit>& list,
                                              std::size_t phase) {
    const auto earlier = [](const PhaseVisit& visit, std::size_t p) { return visit.phase < p; };
    const auto first = std::lower_bound(list.begin(), list.end(), phase, earlier);
    const auto last = std::lower_bound(first, list.end(), phase + 1, earlier);
    return {first, last};
  }

  template <class Combine>
  void combine(std::span<std::uint64_t> values, std::size_t width, const Combine& both) {
    const std::size_t bytes = width * sizeof values[0];
    this->exchange(std::span<const std::uint64_t>(values), width, bytes);
    for (Peer& peer : peers_)
      for (std::size_t k = 0; k < peer.receive.size(); ++k)
        for (std::size_t e = 0; e < width; ++e) {
          std::uint64_t other = 0;
          std::memcpy(&other, peer.in.data() + k * bytes + e * sizeof other, sizeof other);
          std::uint64_t& own = values[peer.receive[k] * width + e];
          own = both(own, other);
        }
  }
  template <class T>
  void pass(std::size_t phase, std::span<T> velocities, std::size_t width) {
    constexpr std::size_t bytes = S::dofs * sizeof(T);
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      Peer& peer = peers_[other];
      const auto coming = of_phase(incoming_[other], phase);
      const auto going = of_phase(outgoing_[other], phase);
      peer.in.resize(coming.size() * bytes);
      peer.out.resize(going.size() * bytes);
      processes_.receive(peer.in.data(), peer.in.size(), int(other));
      for (std::size_t k = 0; k < going.size(); ++k)
        std::memcpy(peer.out.data() + k * bytes, &velocities[going[k].body * width], bytes);
      processes_.send(peer.out.data(), peer.out.size(), int(other));
    }
    processes_.wait();
    for (std::size_t other = 0; other < peers_.size(); ++other) {
      const auto coming = of_phase(incoming_[other], phase);
      for (std::size_t k = 0; k < coming.size(); ++k)
        std::memcpy(&velocities[coming[k].body * width], peers_[other].in.data() + k * bytes,
                    bytes);
    }
  }

  std::vector<std::vector<PhaseVisit>> outgoing_, incoming_;  // one per rank
};

}  // namespace moreau::detail
