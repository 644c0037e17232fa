// SPDX-License-Identifier: MIT
// Walls with a prescribed pressure. The program applies one of the two classes before each step of
// its time loop:
//
//   PressureLoad  lid(world, wall, 1e4, mass, [&] { return width * depth; });
//   PressureServo lid(wall, 1e4, gain, speed, [&] { return width * depth; });
//   for (...) { lid.apply(world, h); world.step(h); }
//
// PressureLoad is for grains under a set-valued law. It gives the wall a mass and applies the force pressure x area
// to it. If the wall is at rest, the grains carry this force up to the residual of the contact
// solver. The mass determines how fast the wall responds.
//
// PressureServo is for grains under a regularized law (springs), whose contact force is a continuous
// function of the position of the wall. So is the contact force under Compliant<Law>, which has springs
// in series with a set-valued law: PressureServo works with it, too, and PressureLoad is simpler. Under
// the other set-valued laws the servo does not reach its pressure.
//
// The servo moves the wall along its normal with the velocity v = gain (pressure - measured pressure); a velocity of the
// wall along itself, as of the lid of a shear cell, stays as it is. Let k be the
// stiffness of the sample in the direction of the wall [N/m] and h the step [s]. In each step the error
// of the pressure is multiplied by 1 - gain k h / area. Keep gain k h / area below 1. If it exceeds 2,
// the servo is unstable.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"

namespace moreau {

/// A function that returns the area on which a pressure acts [m^2], in the plane the length [m]. It
/// is called before every step, because the motion of other walls can change the area.
template <class F>
concept AreaFunction = requires(const F area) {
  { area() } -> std::convertible_to<double>;
};

namespace detail {

/// @throws std::invalid_argument, in the name of `function`, for a body that is not in walls()
template <class Simulation>
void require_half_space(const Simulation& simulation, BodyId wall, const char* function) {
  const auto walls = simulation.walls();
  require(std::find(walls.begin(), walls.end(), wall) != walls.end(), function, "wall", wall,
          "must be the id of a half-space");
}
/// The normal of a half-space, unit, towards the grains, world axes.
template <class Simulation>
typename Simulation::Vector wall_normal(const Simulation& simulation, BodyId wall) {
  return simulation.pose(wall).rotation.toRotationMatrix().col(0);
}
/// Whether a wall is without set_wall_mass(), so that its motion is prescribed.
template <class Simulation>
bool has_no_mass(const Simulation& simulation, BodyId wall) {
  if constexpr (requires { simulation.mobility_root(wall); })  // of several processes
    return simulation.mobility_root(wall).linear.isZero(0);
  else
    return simulation.is_prescribed(wall);
}
/// The present area, checked.
template <class T>
T checked_area(const auto& area, const char* function) {
  const auto now = static_cast<T>(area());
  require_positive(now, function, "area");
  return now;
}

}  // namespace detail

/// The pressure that the contacts exerted on a wall in the last step [Pa], in the plane [N/m]; > 0
/// if the grains push the wall outwards.
/// @param simulation of one process, or a DistributedSimulation: all processes call it together
/// @param wall id of a half-space of the simulation
/// @param step length of the last step [s], > 0
/// @param area area of the wall [m^2], in the plane its length [m], > 0
/// @throws std::invalid_argument if the step or the area is not finite or not positive, the step is a hundred times
///                               longer or shorter than the last one, or the body is not a half-space of the simulation
template <class Simulation>
typename Simulation::Scalar wall_pressure(Simulation& simulation, BodyId wall,
                                          typename Simulation::Scalar step,
                                          typename Simulation::Scalar area) {
  require_positive(step, "wall_pressure", "step");
  require_positive(area, "wall_pressure", "area");
  if constexpr (requires { simulation.require_unit_of_step(step, ""); })
    simulation.require_unit_of_step(step, "wall_pressure");
  detail::require_half_space(simulation, wall, "wall_pressure");
  const typename Simulation::Vector impulse = simulation.contact_impulse(wall);
  return -detail::wall_normal(simulation, wall).dot(impulse) / (step * area);
}

/// A constant pressure on a wall with a mass, of a Simulation or a DistributedSimulation. The pressure on
/// the grains is exact if the wall is at rest.
template <AreaFunction Area>
class PressureLoad {
 public:
  /// Gives the wall its mass. A wall whose motion was prescribed comes to rest. A wall that has a mass already
  /// keeps its velocity: a load that is made anew, for example after read_snapshot(), continues the motion.
  /// @param wall     id of a half-space of the simulation
  /// @param pressure [Pa], in the plane [N/m]; if > 0 it pushes the wall along its normal, towards
  ///                 the grains
  /// @param mass     mass of the wall [kg], > 0; the total mass of the grains is a good choice
  /// @param area     function that returns the area, called before every step, > 0 [m^2], in the
  ///                 plane [m]
  /// @throws std::invalid_argument if the body is not a half-space of the simulation, if the
  ///                               pressure is not finite, or if the mass is not finite or not
  ///                               positive
  template <class Simulation>
  PressureLoad(Simulation& simulation, BodyId wall, double pressure, double mass, Area area)
      : wall_(wall), pressure_(pressure), area_(std::move(area)) {
    require(std::isfinite(pressure), "PressureLoad", "pressure", pressure, "must be finite");
    require_positive(mass, "PressureLoad", "mass");
    detail::require_half_space(simulation, wall, "PressureLoad");
    using Scalar = typename Simulation::Scalar;
    const bool was_prescribed = detail::has_no_mass(simulation, wall);
    simulation.set_wall_mass(wall, static_cast<Scalar>(mass));
    if (was_prescribed) simulation.set_velocity(wall, Simulation::Vector::Zero());
  }

  /// Sets the force pressure x area for the next step. The second argument is not used; it exists
  /// because drives have it.
  /// @throws std::invalid_argument if the area is not finite or not positive
  template <class Simulation>
  void apply(Simulation& simulation, typename Simulation::Scalar = 0) const {
    using Scalar = typename Simulation::Scalar;
    const Scalar area = detail::checked_area<Scalar>(area_, "PressureLoad::apply");
    simulation.set_force(
        wall_, static_cast<Scalar>(pressure_) * area * detail::wall_normal(simulation, wall_));
  }

 private:
  BodyId wall_;
  double pressure_;
  Area area_;
};

/// A pressure controlled by the velocity of a wall without set_wall_mass(), for grains under a
/// regularized law (springs) or under Compliant<Law>.
template <AreaFunction Area>
class [[gnu::warn_unused]] PressureServo {
 public:
  /// @param wall     id of a half-space without set_wall_mass(); apply() checks this
  /// @param pressure set point [Pa], in the plane [N/m]; > 0 pushes the wall on the grains
  /// @param gain     velocity of the wall per difference of pressure [m/(s Pa)], in the plane
  ///                 [m^2/(s N)], > 0
  /// @param limit    largest speed of the wall [m/s], > 0. Let it be at most margin x grain size /
  ///                 step; otherwise the wall runs into grains before their contacts are detected
  /// @param area     function that returns the area, called before every step, > 0 [m^2], in the
  ///                 plane [m]
  /// @throws std::invalid_argument if the pressure is not finite, or if gain or limit is not finite
  ///                               or not positive
  PressureServo(BodyId wall, double pressure, double gain, double limit, Area area)
      : wall_(wall), pressure_(pressure), gain_(gain), limit_(limit), area_(std::move(area)) {
    constexpr const char* self = "PressureServo";
    require(std::isfinite(pressure), self, "pressure", pressure, "must be finite");
    require_positive(gain, self, "gain");
    require_positive(limit, self, "limit");
  }

  /// Sets the velocity along the normal for the next step, from the pressure in the last step.
  /// @param step length of the last step [s], > 0
  /// @throws std::invalid_argument if the body is not a half-space of the simulation or has a mass,
  ///                               or if the step or the area is not finite or not positive
  template <class Simulation>
  void apply(Simulation& simulation, typename Simulation::Scalar step) const {
    using Scalar = typename Simulation::Scalar;
    const Scalar area = detail::checked_area<Scalar>(area_, "PressureServo::apply");
    const double missing = pressure_ - double(wall_pressure(simulation, wall_, step, area));
    require(simulation.bodies().inverse_mass[wall_.index()].isZero(0), "PressureServo::apply",
            "wall", wall_,
            "must have a prescribed motion: contacts change the velocity of a wall with a mass");
    const auto speed = static_cast<Scalar>(std::clamp(gain_ * missing, -limit_, limit_));
    const typename Simulation::Vector normal = detail::wall_normal(simulation, wall_),
                                      before = simulation.velocity(wall_);
    simulation.set_velocity(wall_, before + (speed - normal.dot(before)) * normal);
  }

 private:
  BodyId wall_;
  double pressure_, gain_, limit_;
  Area area_;
};

}  // namespace moreau
