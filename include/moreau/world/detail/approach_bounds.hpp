// SPDX-License-Identifier: MIT
// How far the pairs of a detector can approach in a step, for the margins of step_margins.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/detail/step_margins.hpp"

namespace moreau::detail {

/// Bounds on the approach in a step of the pairs of grains, and of grains and walls, that are within the margin.
/// @tparam GrainT  a grain: its body and its width in any orientation
/// @tparam Planes,Cylinders lists of walls, with their body and their placed shape
/// @tparam Meshes  the mesh walls
template <class S, class GrainT, class Planes, class Cylinders, class Meshes>
struct ApproachBounds {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  std::span<const GrainT> grains;
  std::span<const Aabb<S>> boxes;    ///< one per grain [m]
  std::span<const IndexPair> pairs;  ///< of grains
  std::span<const Vector> shifts;  ///< of the second grain of each pair [m]; empty in an open cell
  const Planes& planes;
  const Cylinders& cylinders;
  const Meshes& meshes;
  const Bodies<S>& bodies;
  const StepMotion<S>& motion;
  Scalar margin;  ///< the largest margin of a pair [m]

  bool is_prescribed(std::size_t k) const {  ///< the motion of grain k
    return bodies.is_prescribed(grains[k].body.index());
  }
  /// Two grains, or a grain and a wall, approach by no more than the sum of their reaches: a bound that takes less time
  /// than of_pair() and of_walls(), and is as good where they hardly move. It follows from those by the triangle
  /// inequality: the centres of grains whose boxes are closer than the margin M are at most sqrt(D) (W + M) apart, W
  /// being the width of the widest grain.
  /// @param widest W [m]
  /// @returns the reach of grain k [m]
  Scalar reach(std::size_t k, Scalar widest) const {
    return motion.reach(grains[k].body.index(), 2 * (widest + margin) + widest / 2 + margin);
  }
  /// The largest reach of the walls [m]; infinite if one of them turns.
  Scalar reach_of_walls() const {
    Scalar largest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!(bodies.grain_mass[i] > 0))
        largest = std::max(largest, motion.reach(i, std::numeric_limits<Scalar>::infinity()));
    return largest;
  }
  /// The width of the widest grain [m].
  Scalar widest() const {
    Scalar widest = 0;
    for (const GrainT& grain : grains) widest = std::max(widest, grain.width);
    return widest;
  }
  /// Bound on the approach of pair p [m]; < 0 if its boxes are farther apart than the margin, or no impulse can
  /// change its motion.
  Scalar of_pair(std::size_t p) const {
    const auto [first, second] = pairs[p];
    const GrainT &a = grains[first], &b = grains[second];
    const Vector shift = shifts.empty() ? Vector(Vector::Zero()) : shifts[p];
    const Aabb<S> moved = boxes[second].moved(shift);
    if (!boxes[first].inflated(margin).overlaps(moved)) return Scalar(-1);
    if (is_prescribed(first) && is_prescribed(second)) return Scalar(-1);
    const std::size_t i = a.body.index(), j = b.body.index();
    const Vector to_b = bodies.pose[j].position - bodies.pose[i].position + shift;
    return a.width < b.width ? motion.approach(i, j, -to_b, a.width / 2 + margin)
                             : motion.approach(j, i, to_b, b.width / 2 + margin);
  }
  /// Largest bound on the approach of grain k and a wall within the margin [m]; 0 if there is none, or no impulse can
  /// change its motion.
  Scalar of_walls(std::size_t k) const {
    Scalar largest = 0;
    const GrainT& grain = grains[k];
    const std::size_t i = grain.body.index();
    const auto take = [&](BodyId wall) {
      if (is_prescribed(k) && bodies.is_prescribed(wall.index())) return;
      const Vector to_grain = bodies.pose[i].position - bodies.pose[wall.index()].position;
      largest =
          std::max(largest, motion.approach(i, wall.index(), to_grain, grain.width / 2 + margin));
    };
    for (const auto& wall : planes)
      if (wall.placed.reaches(boxes[k], margin)) take(wall.body);
    for (const auto& wall : cylinders)
      if (wall.placed.reaches(boxes[k], margin)) take(wall.body);
    meshes.for_each_near(boxes[k], margin, take);
    return largest;
  }
};

}  // namespace moreau::detail
