// SPDX-License-Identifier: MIT
// Read access to the bodies of a simulation: poses, velocities, shapes, and which body is a grain,
// a wall or a cylinder.
#pragma once

#include <cstddef>
#include <span>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/core/value.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/detail/assembly.hpp"

namespace moreau {

/// The functions of Simulation that read bodies; Simulation inherits them. They throw
/// std::invalid_argument, which names function, argument and value, for an id that is not of this
/// simulation, or of a grain that was removed.
///
///     for (const moreau::BodyId grain : simulation.grains())
///       lowest = std::min(lowest, simulation.pose(grain).position[2]);
///
/// @tparam ShapeT shape of the grains
template <GrainShape ShapeT>
class BodyAccess {
 public:
  using S = SpaceOf<ShapeT>;

  /// Position of the centre of mass [m], and rotation from body to world axes. The origin of a wall
  /// is a point of its plane, the origin of a cylinder is a point of its axis. Poses of periodic
  /// axes are not wrapped; cell().wrap() gives the position in the cell. The reference is valid
  /// until a body is added.
  /// @throws std::invalid_argument for a body that is not of this simulation
  const Pose<S>& pose(BodyId body) const {
    assembly_.require_body(body, "Simulation::pose");
    return bodies().pose[body.index()];
  }
  /// Velocity of the centre of mass, world axes [m/s].
  /// @throws std::invalid_argument for a body that is not of this simulation
  const Value<typename S::Vector> velocity(BodyId body) const {
    assembly_.require_body(body, "Simulation::velocity");
    return linear<S>(bodies().velocity[body.index()]);
  }
  /// Angular velocity, world axes [rad/s]: a vector in space; in the plane a vector with one
  /// component, > 0 from x to y.
  /// @throws std::invalid_argument for a body that is not of this simulation
  const Value<typename S::Angular> spin(BodyId body) const {
    assembly_.require_body(body, "Simulation::spin");
    return angular<S>(bodies().velocity[body.index()]);
  }
  /// Shape of a grain, in its own frame. Takes a time proportional to the logarithm of the number
  /// of grains.
  /// @throws std::invalid_argument for a body that is not a grain of this simulation
  const ShapeT& shape(BodyId grain) const {
    return assembly_.shape_of_grain(assembly_.number_of_grain(grain, "Simulation::shape"));
  }

  /// Whether the id is that of a grain or wall of this simulation that was not removed.
  bool contains(BodyId body) const { return assembly_.contains(body); }
  /// The id of the body with this index, e.g. of Contact::a.
  /// @throws std::invalid_argument if no body has this index
  BodyId body_id(std::size_t index) const {
    require(index < bodies().size() && bodies().exists(index), "Simulation::body_id", "index",
            index, "must be the index of a body");
    return bodies().id[index];
  }
  /// Whether the motion of a body is prescribed, so that neither forces nor contacts change it: a grain
  /// after prescribe_motion(), a wall without set_wall_mass().
  /// @throws std::invalid_argument for a body that is not of this simulation
  bool is_prescribed(BodyId body) const {
    assembly_.require_body(body, "Simulation::is_prescribed");
    return bodies().is_prescribed(body.index());
  }

  /// An added shape, in its own frame.
  /// @throws std::invalid_argument for a shape that is not of this simulation
  const ShapeT& shape(ShapeId shape) const {
    assembly_.require_shape(shape, "Simulation::shape");
    return assembly_.shape(shape);
  }

  /// The ids of all grains, ascending: in the order in which they were added, as long as no grain was
  /// removed. The span is valid until a grain is added or removed.
  std::span<const BodyId> grains() const { return assembly_.grains(); }
  /// The ids of all walls that are half-spaces, in the order in which they were added. The span is
  /// valid until a wall is added.
  std::span<const BodyId> walls() const { return assembly_.walls(); }
  /// All cylinder walls with their shapes, in the order in which they were added. The span is valid
  /// until a cylinder is added.
  std::span<const CylinderBody<S>> cylinders() const { return assembly_.cylinders(); }

  /// All mesh walls with their shapes, in the order in which they were added. The span is valid until a
  /// mesh wall is added.
  std::span<const MeshBody<S>> mesh_walls() const { return assembly_.meshes(); }

  std::size_t grain_count() const { return assembly_.grain_count(); }  ///< without walls
  /// The k-th element of grains().
  /// @throws std::invalid_argument unless k < grain_count()
  BodyId grain(std::size_t k) const {
    assembly_.require_grain(k, "Simulation::grain");
    return assembly_.grain(k);
  }
  /// Shape of the k-th element of grains(), in its own frame.
  /// @throws std::invalid_argument unless k < grain_count()
  const ShapeT& shape_of_grain(std::size_t k) const {
    assembly_.require_grain(k, "Simulation::shape_of_grain");
    return assembly_.shape_of_grain(k);
  }
  /// Whether the element `body` of bodies(), which must exist, is a grain. Else it is a wall, or belongs
  /// to no body (Bodies::exists()).
  bool is_grain(std::size_t body) const { return bodies().grain_mass[body] > 0; }

  /// All quantities of all bodies, by BodyId::index(); indices are not checked. Removed grains leave
  /// elements with zero mass, which a body that is added later takes (Bodies::exists()).
  const Bodies<S>& bodies() const { return assembly_.bodies(); }

 protected:
  BodyAccess() = default;

  detail::Assembly<ShapeT> assembly_;  ///< bodies, shapes and walls
};

}  // namespace moreau
