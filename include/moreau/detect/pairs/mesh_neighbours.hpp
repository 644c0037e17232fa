// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau {

/// A facet of a mesh wall. Ordered by face.
struct NearFacet {
  std::uint32_t face;   ///< MeshWall::Side::face
  std::uint32_t place;  ///< k of MeshWall::side(k)
  bool is_plain;        ///< whether the facet has neither a convex ridge nor a tip
  bool has_concave;     ///< whether the facet has a concave ridge

  // By face and place: a place has one facet.
  friend constexpr auto operator<=>(const NearFacet& a, const NearFacet& b) {
    return a.key() <=> b.key();
  }
  friend constexpr bool operator==(const NearFacet& a, const NearFacet& b) {
    return a.key() == b.key();
  }

 private:
  constexpr std::uint64_t key() const { return std::uint64_t{face} << 32 | place; }
};

namespace detail {

/// Sorts a list, and leaves out what it has twice. Most lists are short: they are sorted by insertion.
template <class X>
void sort_short(std::vector<X>& list) {
  if (list.size() > 64) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const X item = list[i];
    std::size_t at = count;
    while (at > 0 && item < list[at - 1]) --at;
    if (at > 0 && list[at - 1] == item) continue;
    std::move_backward(list.begin() + std::ptrdiff_t(at), list.begin() + std::ptrdiff_t(count),
                       list.begin() + std::ptrdiff_t(count + 1));
    list[at] = item;
    ++count;
  }
  list.erase(list.begin() + std::ptrdiff_t(count), list.end());
}

/// Finds the facets whose boxes overlap a box, face after face.
template <class S>
void find_facets(const MeshWall<S>& wall, const Aabb<S>& box, std::vector<NearFacet>& facets) {
  facets.clear();
  wall.tree().query(
      [&](const Aabb<S>& node) { return node.overlaps(box); },
      [&](std::uint32_t k) {
        if (wall.box(k).overlaps(box))
          facets.push_back({wall.side(k).face, k, wall.is_plain(k), wall.has_concave(k)});
      });
  sort_short(facets);
}

/// Takes those of a list of facets whose boxes overlap a box.
template <class S>
void select_facets(const MeshWall<S>& wall, const Aabb<S>& box, std::span<const NearFacet> list,
                   std::vector<NearFacet>& facets) {
  facets.clear();
  for (const NearFacet& facet : list)
    if (wall.box(facet.place).overlaps(box)) facets.push_back(facet);
}

}  // namespace detail

/// The facets of a mesh wall near a grain, kept from step to step. They are searched again only when the
/// grain has left the box in which they were searched, so that a step hardly depends on the number of
/// facets of the wall. Contacts do not depend on it.
template <EuclideanSpace S>
class MeshNeighbours {
 public:
  /// Makes the list complete for a box.
  /// @param box in the frame of the wall [m]
  void update(const MeshWall<S>& wall, const Aabb<S>& box) {
    if (box_.contains(box)) return;
    box_ = box.inflated(skin * (box.upper - box.lower).maxCoeff());
    detail::find_facets(wall, box_, facets_);
  }
  /// At least the facets whose boxes overlap the box, face after face.
  std::span<const NearFacet> facets() const { return facets_; }

 private:
  /// How far a grain moves until the next search, in lengths of its box.
  static constexpr auto skin = typename S::Scalar(0.1);
  Aabb<S> box_;  // empty before the first update()
  std::vector<NearFacet> facets_;
};

}  // namespace moreau
