// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/space.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau::detail {

/// The boxes for which the broad phase lists pairs: those of the grains, enlarged so that the list stays
/// valid while they move. A grain without a pair is alone. If such a grain leaves its box, its next one is
/// longer in the direction of its motion, twice as long each time. So a lost grain makes the list new a
/// number of times that grows as the logarithm of its way, however fast it is. Grains that are all placed far away
/// by the user have boxes that are longer by a few margins and skins only, so that few of them overlap.
template <class S>
class EnlargedBoxes {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Finds the grains that are alone.
  void find_pairs_of(std::size_t grains, const std::vector<IndexPair>& pairs) {
    has_pair_.assign(grains, 0);
    for (const IndexPair& pair : pairs) has_pair_[pair.first] = has_pair_[pair.second] = 1;
  }
  /// Whether grain k has no pair in the list that find_pairs_of() was given.
  bool is_alone(std::size_t k) const { return has_pair_[k] == 0; }

  /// The next enlarged box of a grain that is alone.
  /// @param box   of the grain
  /// @param old   its enlarged box so far
  /// @param reach by which `box` is enlarged at least [m]
  /// @param skin  by which it is enlarged in addition [m]
  static Aabb<S> next(const Aabb<S>& box, const Aabb<S>& old, Scalar reach, Scalar skin) {
    Aabb<S> plain = box.inflated(reach + skin);
    const Vector longer = (old.upper - old.lower) - (plain.upper - plain.lower);
    if (old.contains(box.inflated(reach))) return longer.maxCoeff() > skin ? old : plain;
    // Four times the way from the middle of the old box: twice as long as before. Not more after a jump.
    const Scalar most = 4 * (std::max(longer.maxCoeff(), Scalar(0)) + reach + skin);
    Vector way = 2 * (box.lower + box.upper - old.lower - old.upper);
    way *= std::min(Scalar(1), most / way.cwiseAbs().maxCoeff());
    for (int k = 0; k < S::dim; ++k) (way[k] < 0 ? plain.lower : plain.upper)[k] += way[k];
    return plain;
  }

 private:
  List<unsigned char> has_pair_;  // one per grain
};

}  // namespace moreau::detail
