// SPDX-License-Identifier: MIT
// The part of check() that looks for grains behind mesh walls with one side: the corners of the facets are in the wrong
// order, or a grain was faster than the step allows. From behind a grain passes such a wall without a contact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/pairs/nearest_on_facet.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/concepts.hpp"

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
                      // The nearest point lies inside the facet if it is the foot of the normal. Beside a ridge the side is not known.
                      const Scalar depth = side.offset - side.normal.dot(x);
                      found = {place, depth > least && distance <= Scalar(1.001) * depth};
                    });
  return found;
}

/// Names a grain whose centre lies behind the facet that is nearest to it. The centre of a compound grain can lie there although
/// the grain is in front.
template <class Simulation>
MOREAU_INLINED inline void check_meshes([[maybe_unused]] Findings& found,
                                        [[maybe_unused]] const Simulation& simulation) {
  using Shape = std::remove_cvref_t<decltype(simulation.shape_of_grain(0))>;
  if constexpr (!CompoundShape<Shape>) {
    using S = typename Simulation::S;
    const auto& bodies = simulation.bodies();
    const auto resolution = simulation.tolerances().lengths(simulation.grain_size()).resolution;
    // A polytope less deep than its inradius is still held.
    const auto least = [&](const Shape& shape) {
      if constexpr (Polytope<Shape>) return std::max(resolution, shape.inradius());
      return resolution;
    };
    for (const auto& mesh : simulation.mesh_walls()) {
      if (mesh.shape.sides() == WallSides::both) continue;
      for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
        const std::size_t i = simulation.grain(k).index();
        if (bodies.is_prescribed(i)) continue;
        const typename S::Vector x =
            bodies.pose[mesh.body.index()].to_body(bodies.pose[i].position);
        const Shape& shape = simulation.shape_of_grain(k);
        const Behind behind = find_behind<S>(mesh.shape, x, circumradius(shape), least(shape));
        if (!behind.is) continue;
        return found.say(
            "grain % lies behind facet % of mesh wall %, which holds grains on one side: from "
            "behind they pass. If they shall be held there, turn the order of the corners of the "
            "facets round, or take WallSides::both; if the grain has passed, it was too fast for "
            "the step or was added there",
            {double(i), double(mesh.shape.tree().order()[behind.place]),
             double(mesh.body.index())});
      }
    }
  }
}

}  // namespace moreau::detail
