// SPDX-License-Identifier: MIT
// The functions of Simulation that add shapes, grains and walls. They are not inline, as the end of
// world/simulation.hpp says, which includes this header.
#pragma once

#include <cmath>

#include "moreau/core/error.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
ShapeId Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_shape(const ShapeT& shape) {
  return assembly_.add_shape(shape);
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
BodyId Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_grain(ShapeId shape,
                                                                     const Pose<S>& pose,
                                                                     Scalar density,
                                                                     MaterialId material) {
  constexpr const char* self = "Simulation::add_grain";
  assembly_.require_pose(pose, self);
  const MassProperties<S> mass = assembly_.mass_of(shape, density, grain_size_, self);
  cell().require_room(detector_.room_of(assembly_.shape(shape), lengths()), self);
  const BodyId body = assembly_.add_body(pose, material, materials_.count(), self);
  assembly_.set_grain(body, shape, mass);
  detector_.add_grain(body, assembly_.shape(shape));
  return body;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
BodyId Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_wall(const VectorArgument<S>& normal,
                                                                    const VectorArgument<S>& point,
                                                                    MaterialId material) {
  constexpr const char* self = "Simulation::add_wall";
  require(std::abs(normal.norm() - 1) <= Scalar(1e-5), self, "normal", normal, "must be unit");
  require(all_finite(point), self, "point", point, "must be finite");
  cell().require_along(normal, self);
  const Pose<S> pose{point, S::normalized(typename S::Rotation(S::contact_frame(normal)))};
  return add_wall_of(HalfSpace<S>(Vector::UnitX()), pose, material, self);
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
BodyId Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_cylinder(
    const VectorArgument<S>& point, const AngularArgument<S>& axis, Scalar radius,
    MaterialId material) {
  constexpr const char* self = "Simulation::add_cylinder";
  require(all_finite(point), self, "point", point, "must be finite");
  require(std::abs(axis.norm() - 1) <= Scalar(1e-5), self, "axis", axis, "must be unit");
  require_positive(radius, self, "radius");
  cell().require_around(axis, self);
  return add_wall_of(CylinderWall<S>(axis, radius), Pose<S>(point), material, self);
}

}  // namespace moreau
