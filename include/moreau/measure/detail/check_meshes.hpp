// SPDX-License-Identifier: MIT
// The part of check() that looks for grains behind mesh walls with one side: the corners of the facets are in the wrong
// order, or a grain was faster than the step allows. From behind a grain passes such a wall without a contact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/pairs/behind_facet.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The mesh wall with one side that has the deepest overlap of a step; -1 if no such wall has it.
template <class Simulation>
[[gnu::cold]] double one_sided_wall(const Simulation& simulation, const StepReport& report) {
  for (const auto& mesh : simulation.mesh_walls())
    if (const std::size_t i = mesh.body.index();
        mesh.shape.sides() != WallSides::both && (i == report.deepest_a || i == report.deepest_b))
      return double(i);
  return -1;
}

/// Names a mesh wall around grains that is hundreds of grain sizes long along every axis, if all free grains lie in a thousandth
/// of it about its origin.
template <class Simulation>
MOREAU_INLINED inline void check_mesh_units(Findings& found, const Simulation& simulation) {
  using S = typename Simulation::S;
  using Scalar = typename S::Scalar;
  const auto& bodies = simulation.bodies();
  for (const auto& mesh : simulation.mesh_walls()) {
    const Aabb<S> bounds = mesh.shape.tree().bounds();
    const typename S::Vector length = bounds.upper - bounds.lower;
    bool inside = length.minCoeff() > 300 * simulation.grain_size(), any = false;
    const Aabb<S> box = Aabb<S>(Scalar(1e-3) * bounds.lower, Scalar(1e-3) * bounds.upper)
                            .inflated(simulation.grain_size());
    for (const BodyId grain : simulation.grains()) {
      if (!inside) break;
      const std::size_t i = grain.index();
      if (bodies.is_prescribed(i)) continue;
      inside = box.contains(bodies.pose[mesh.body.index()].to_body(bodies.pose[i].position));
      any = true;
    }
    if (inside && any)
      return found.say(
          "mesh wall % is % m long, and all grains lie in a thousandth of it. If it is in mm, add "
          "scaled(mesh, 0.001)",
          {double(mesh.body.index()), double(length.maxCoeff())});
  }
}

/// Names a grain whose centre lies behind the facet that is nearest to it. The centre of a compound grain can lie there although
/// the grain is in front.
template <class Simulation>
MOREAU_INLINED inline void check_meshes([[maybe_unused]] Findings& found,
                                        [[maybe_unused]] const Simulation& simulation) {
  check_mesh_units(found, simulation);
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
