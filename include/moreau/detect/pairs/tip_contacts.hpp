// SPDX-License-Identifier: MIT
// Contacts of a convex shape with the tips of a mesh wall, the vertices at which convex ridges end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/mesh_pair.hpp"
#include "moreau/detect/pairs/mesh_scratch.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau::detail {

/// Contacts with tips.
template <class ShapeT>
class TipContacts {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Known = KnownContacts::Contact<Vector>;

  explicit TipContacts(MeshPair<ShapeT>& pair) : pair_(pair) {}

  /// Calls add(to_shape, gap, x, key) for the contacts of tips; collects the tips for touch_pierced().
  /// @param tolerance sine of the largest angle outside of the normal cone of a tip [-]
  template <class Add>
  void touch(T tolerance, const Add& add) {
    const auto& tips = pair_.scratch.tips;
    for (std::size_t k = 0; k < tips.size(); ++k)
      if (k == 0 || tips[k].first != tips[k - 1].first) touch_tip(k, tolerance, add);
  }
  /// The contacts of tips deep in the shape, if the normal of the nearest face of the shape is not in the normal
  /// cone of the tip: a crest is beyond the middle of a thin shape, or higher than its neighbours along this
  /// normal. The nearest face counts whose normal is in the cone, otherwise the nearest one that leads out of the
  /// facets at the tip.
  /// @param tips scratch.pierced, or scratch.pricked
  template <class Add>
  void touch_pierced(const std::vector<std::size_t>& tips, const Add& add) {
    for (const std::size_t first : tips) {
      const std::uint32_t v = pair_.scratch.tips[first].first;
      const Vector x = pair_.wall.vertex(v) - pair_.center;
      int best = 0;
      Known contact{x, x, -std::numeric_limits<T>::infinity(), FeatureKey()};
      pair_.core.for_each_face([&](std::uint32_t f, const Vector& outward, T offset) {
        const T gap = outward.dot(x) - offset;
        const int rank = rank_of(first, -outward);
        if (rank < std::max(best, 1) || (rank == best && !(gap > contact.gap))) return;
        best = rank;
        contact = {x - gap * outward, -outward, gap,
                   FeatureKey(vertex_on_face(S{}), v, f).swapped()};
      });
      const auto leads = [&](const Known& other) { return pair_.leads_off(other, x); };
      if (best > 0 && !pair_.scratch.known.frees(contact, pair_.near, leads))
        add(contact.to_shape, contact.gap, contact.x, contact.feature);
    }
  }

 private:
  template <class Add>
  void touch_tip(std::size_t first, T tolerance, const Add& add) {
    const std::uint32_t v = pair_.scratch.tips[first].first;
    const Vector x = pair_.wall.vertex(v) - pair_.center;
    if (!pair_.is_within(x, pair_.largest)) return;
    const auto found = pair_.core.distance(x, pair_.largest);
    if (!pair_.is_near(found.distance)) return;
    const Vector d = -found.outward;
    if (pair_.wall.is_top(v, d, tolerance) && pair_.wall.is_outward(v, d))
      return add(d, found.distance, Vector(x - found.distance * found.outward),
                 FeatureKey(found.feature.kind(), found.feature.a(), v));
    if (found.distance < -pair_.core.deepest() / 8)
      pair_.scratch.pierced.push_back(first);
    else if (found.distance < -pair_.near)
      pair_.scratch.pricked.push_back(first);
  }
  /// 2 if a direction is in the normal cone of a tip; 1 if it leads out of all facets at the tip that are near the
  /// shape, or of a surface with two sides out of the facet above which the centre is highest; otherwise 0.
  int rank_of(std::size_t first, const Vector& d) const {
    const std::uint32_t v = pair_.scratch.tips[first].first;
    if (pair_.wall.is_top(v, d, MeshPair<ShapeT>::aligned) && pair_.wall.is_outward(v, d)) return 2;
    T least = 1, highest = 0, of_highest = 0;  // cosines, and a height [m]
    for (std::size_t k = first; k < pair_.scratch.tips.size() && pair_.scratch.tips[k].first == v;
         ++k) {
      const auto& side = pair_.wall.side(pair_.scratch.tips[k].second);
      const T cosine = d.dot(side.normal), above = pair_.reference_height(side);
      least = std::min(least, cosine);
      if (above > highest) highest = above, of_highest = cosine;
    }
    return (pair_.wall.sides() == WallSides::both ? of_highest : least) >= T(0.5) ? 1 : 0;
  }

  MeshPair<ShapeT>& pair_;
};

}  // namespace moreau::detail
