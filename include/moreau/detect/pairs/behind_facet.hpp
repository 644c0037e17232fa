// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/detect/pairs/nearest_on_facet.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau::detail {

/// A facet behind which a point lies.
struct Behind {
  std::uint32_t place = 0;  ///< of the facet, as in MeshWall::side()
  bool is = false;          ///< whether there is one
};

/// Finds the facet nearest to a point, and whether the point lies behind its inside by more than a length.
/// @param x     in the frame of the wall [m]
/// @param reach farther facets do not count [m]
/// @param least smallest depth that counts [m]
template <class S>
MOREAU_INLINED inline Behind find_behind(const MeshWall<S>& wall, const typename S::Vector& x,
                                         typename S::Scalar reach, typename S::Scalar least) {
  using Scalar = typename S::Scalar;
  Behind found;
  Scalar nearest = reach;
  wall.tree().query([&](const Aabb<S>& box)
                        MOREAU_INLINED_LAMBDA { return box.inflated(nearest).contains(x); },
                    [&](std::uint32_t place) MOREAU_INLINED_LAMBDA {
                      const auto& side = wall.side(place);
                      const typename S::Matrix corners = side.corners.colwise() - x;
                      const Scalar distance = nearest_on_facet(corners).norm();
                      if (!(distance < nearest)) return;
                      nearest = distance;
                      // Where the nearest point is not the projection onto the plane of the facet, it lies on a rim or a ridge:
                      // the side is not known.
                      const Scalar depth = side.offset - side.normal.dot(x);
                      found = {place, depth > least && distance <= Scalar(1.001) * depth};
                    });
  return found;
}

}  // namespace moreau::detail
