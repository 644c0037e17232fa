// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "moreau/core/pose.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/rank_topology.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau::detail {

/// Gives ghosts the poses and velocities of the grains that they are copies of.
template <class S>
class GhostMotion {
 public:
  /// Communicates.
  void refresh(Bodies<S>& bodies, const RankTopology& topology, Communicator& processes) {
    out_.resize(std::size_t(processes.size()));
    in_.resize(out_.size());
    for (std::size_t rank = 0; rank < out_.size(); ++rank) {
      in_[rank].resize(topology.ghosts[rank].size() * (pose_bytes + twist_bytes));
      processes.receive(in_[rank].data(), in_[rank].size(), int(rank));
      out_[rank].resize(topology.lent[rank].size() * (pose_bytes + twist_bytes));
      char* to = out_[rank].data();
      for (const std::uint32_t i : topology.lent[rank]) {
        std::memcpy(to, static_cast<const void*>(&bodies.pose[i]), pose_bytes);
        to += pose_bytes;
        std::memcpy(to, static_cast<const void*>(&bodies.velocity[i]), twist_bytes);
        to += twist_bytes;
      }
      processes.send(out_[rank].data(), out_[rank].size(), int(rank));
    }
    processes.wait();
    for (std::size_t rank = 0; rank < in_.size(); ++rank) {
      const char* from = in_[rank].data();
      for (const std::uint32_t i : topology.ghosts[rank]) {
        std::memcpy(static_cast<void*>(&bodies.pose[i]), from, pose_bytes);
        from += pose_bytes;
        std::memcpy(static_cast<void*>(&bodies.velocity[i]), from, twist_bytes);
        from += twist_bytes;
      }
    }
  }

 private:
  static constexpr std::size_t pose_bytes = sizeof(Pose<S>);
  static constexpr std::size_t twist_bytes = sizeof(typename S::Twist);

  std::vector<std::string> out_, in_;  // one per rank
};

}  // namespace moreau::detail
