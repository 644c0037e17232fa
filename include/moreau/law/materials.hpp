// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/state.hpp"

namespace moreau {

/// Maps a pair of materials to the law between them. Symmetric; a frictionless wall is a material
/// of its own, so no code has to ask whether a body is a wall.
template <class Law>
class Materials {
 public:
  /// @param count    number of materials, at least 1
  /// @param fallback the law of every pair until set() says otherwise
  /// @throws std::invalid_argument if count is 0
  explicit Materials(std::size_t count, const Law& fallback = Law{})
      : count_(count), laws_(count * count, fallback) {
    require(count > 0, "Materials", "count", count, "must be at least 1");
  }

  /// Number of materials.
  std::size_t count() const { return count_; }

  /// Gives the law of the pairs (a, b) and (b, a).
  /// @throws std::invalid_argument for a material that does not exist
  void set(MaterialId a, MaterialId b, const Law& law) {
    require(a.index() < count_, "Materials::set", "a", a, "must be the id of a material");
    require(b.index() < count_, "Materials::set", "b", b, "must be the id of a material");
    laws_[law_index(a, b)] = law;
    laws_[law_index(b, a)] = law;
  }

  /// The law between two materials.
  const Law& operator()(MaterialId a, MaterialId b) const { return laws_[law_index(a, b)]; }
  /// Position of the pair's law in laws().
  std::size_t law_index(MaterialId a, MaterialId b) const { return a.index() * count_ + b.index(); }
  const std::vector<Law>& laws() const { return laws_; }  ///< of all pairs, see law_index()

 private:
  friend struct StateAccess;
  auto state() { return std::tie(count_, laws_); }
  void restored() const {
    require(count_ > 0 && laws_.size() / count_ == count_ && laws_.size() % count_ == 0,
            "Materials", "count", count_, "must be > 0, with a law for every pair");
  }

  std::size_t count_;
  std::vector<Law> laws_;
};

}  // namespace moreau
