// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/serialize.hpp"

namespace moreau {

/// Maps a pair of materials to the law between them; symmetric. A wall with another law, for
/// example without friction, has a material of its own.
template <class Law>
class Materials {
 public:
  /// @param count    number of materials, at least 1
  /// @param fallback the law of every pair until set() says otherwise
  /// @throws std::invalid_argument if count is 0 or above 65535
  explicit Materials(std::size_t count, const Law& fallback = Law{}) : count_(count) {
    // The index of a law has 32 bits.
    require(count > 0 && count <= 65535, "Materials", "count", count, "must lie in [1, 65535]");
    laws_.assign(count * count, fallback);
  }
  /// One material. Not explicit, so that a law can be given in place of materials.
  Materials(const Law& law) : Materials(1, law) {}  // NOLINT(google-explicit-constructor)
  /// The first argument is the number of materials, not a coefficient of friction.
  explicit Materials(std::floating_point auto, const Law& = Law{}) = delete;

  /// Gives the law of the pairs (a, b) and (b, a).
  /// @throws std::invalid_argument for a material that does not exist
  void set(MaterialId a, MaterialId b, const Law& law) {
    require_pair(a, b, "Materials::set");
    laws_[law_index(a, b)] = law;
    laws_[law_index(b, a)] = law;
  }

  /// Number of materials.
  std::size_t count() const { return count_; }
  /// Index into laws() of the law between two materials that exist, which is not checked.
  std::size_t law_index(MaterialId a, MaterialId b) const { return a.index() * count_ + b.index(); }
  /// The law between two materials. laws()[law_index(a, b)] is the same without a check.
  /// @throws std::invalid_argument for a material that does not exist
  const Law& operator()(MaterialId a, MaterialId b) const {
    require_pair(a, b, "Materials::operator()");
    return laws_[law_index(a, b)];
  }
  const std::vector<Law>& laws() const { return laws_; }  ///< count()^2, see law_index()

 private:
  void require_pair(MaterialId a, MaterialId b, const char* function) const {
    require(a.index() < count(), function, "a", a, "must be the id of a material");
    require(b.index() < count(), function, "b", b, "must be the id of a material");
  }

  friend struct SerializationAccess;
  Materials() = default;
  auto serialized_members() { return std::tie(count_, laws_); }
  void deserialized() const {
    require(count_ > 0 && laws_.size() / count_ == count_ && laws_.size() % count_ == 0,
            "Materials", "count", count_, "must be > 0, with a law for every pair");
  }

  std::size_t count_ = 0;  ///< number of materials
  std::vector<Law> laws_;
};

}  // namespace moreau
