// SPDX-License-Identifier: MIT
// A sink: the part of space in which grains are removed. The program applies it after each step:
//
//   moreau::Sink<S> sink = moreau::Sink<S>::behind(Vector::UnitY(), {0, -0.1});
//   for (...) { world.step(h); sink.apply(world); }
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// Grains that a source added or a sink removed.
struct GrainSum {
  std::size_t count = 0;  ///< number of grains
  double mass = 0;        ///< their mass [kg]
};

/// Removes the grains whose centre of mass is behind a plane or outside a box. Grains whose motion is
/// prescribed stay. Snapshots can contain it: it then continues with its total().
template <EuclideanSpace S>
class [[gnu::warn_unused]] Sink {
 public:
  /// A sink for the grains behind a plane.
  /// @param normal unit vector towards the grains that stay, world axes
  /// @param point  any point of the plane, world axes [m]
  /// @throws std::invalid_argument for a normal that is not unit within 1e-5, or a point that is not
  ///         finite
  static Sink behind(const VectorArgument<S>& normal, const VectorArgument<S>& point) {
    constexpr const char* self = "Sink::behind";
    using Scalar = typename S::Scalar;
    require(std::abs(normal.norm() - 1) <= Scalar(1e-5), self, "normal", normal, "must be unit");
    require(all_finite(point), self, "point", point, "must be finite");
    Sink sink;
    sink.normal_ = normal;
    sink.point_ = point;
    return sink;
  }
  /// A sink for the grains outside a box.
  /// @param box world axes [m]; a bound may be infinite
  /// @throws std::invalid_argument for a lower bound that is not below the upper bound
  static Sink outside(const Aabb<S>& box) {
    for (int k = 0; k < S::dim; ++k)
      require(box.lower[k] < box.upper[k], "Sink::outside", "box.lower", box.lower,
              "must be below box.upper along every axis");
    Sink sink;
    sink.box_ = box;
    return sink;
  }

  /// Removes the grains that are in the sink. Along periodic axes a grain is where it is in the cell.
  /// @param simulation a Simulation in the space S
  /// @returns number and mass of the grains that were removed
  template <class Simulation>
  GrainSum apply(Simulation& simulation) {
    GrainSum now;
    removed_.clear();
    for (const BodyId grain : simulation.grains()) {
      const typename S::Vector x = simulation.cell().wrap(simulation.pose(grain).position);
      const bool stays = normal_.dot(x - point_) >= 0 && box_.contains(x);
      if (stays || simulation.is_prescribed(grain)) continue;
      removed_.push_back(grain);
      ++now.count;
      now.mass += double(simulation.bodies().grain_mass[grain.index()]);
    }
    simulation.remove_grains(removed_);
    total_.count += now.count;
    total_.mass += now.mass;
    return now;
  }

  /// The ids of the grains that the last apply() removed, ascending. Functions of the simulation refuse
  /// them.
  std::span<const BodyId> removed() const { return removed_; }
  const GrainSum& total() const { return total_; }  ///< what all calls of apply() removed

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(total_); }

  Sink() {
    constexpr auto infinity = std::numeric_limits<typename S::Scalar>::infinity();
    box_ = Aabb<S>(S::Vector::Constant(-infinity), S::Vector::Constant(infinity));
  }

  typename S::Vector normal_ = S::Vector::Zero(), point_ = S::Vector::Zero();
  Aabb<S> box_;
  std::vector<BodyId> removed_;
  GrainSum total_;
};

}  // namespace moreau
