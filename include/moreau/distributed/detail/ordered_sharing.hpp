// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// A change of the velocity of a body by one of its contacts, in a phase of a sweep.
struct PhaseVisit {
  std::uint32_t phase, body;
};

/// Bodies that are shared without being split: at any time one process at most changes a body.
class OrderedSharing : public SharedBodies {
 public:
  /// The index of a body in the whole simulation.
  virtual std::uint32_t id(std::size_t body) const = 0;
  /// The walls that move under contacts of any process, ascending.
  virtual std::vector<std::uint32_t> moving_walls() const = 0;
  /// Replaces the numbers of every shared grain by the largest of its copies. Communicates.
  /// @param values `width` per body
  virtual void take_largest(std::span<std::uint64_t> values, std::size_t width) = 0;
  /// The same with the bits of all copies.
  virtual void unite_bits(std::span<std::uint64_t> values, std::size_t width) = 0;
  /// Adds up over all processes. Communicates.
  virtual void add(std::span<std::int64_t> values) = 0;
  /// Says which grains this process changes in which phase. Communicates.
  virtual void plan(std::span<const PhaseVisit> visits, std::size_t phases) = 0;
  /// Sends the velocities of the shared grains that were changed in a phase to all their copies.
  /// @param velocities `width` numbers per body, of which the first D + A are used
  virtual void pass_on(std::size_t phase, std::span<double> velocities, std::size_t width) = 0;
  virtual void pass_on(std::size_t phase, std::span<float> velocities, std::size_t width) = 0;
};

}  // namespace moreau::detail
