// SPDX-License-Identifier: MIT
// Walls that keep a pressure. The time loop applies them before each step:
//
//   PressureLoad  lid(world, wall, 1e4, mass, [&] { return width * depth; });
//   PressureServo lid(wall, 1e4, gain, speed, [&] { return width * depth; });
//   for (...) { lid.apply(world, h); world.step(h); }
//
// PressureLoad is for rigid grains. It gives the wall a mass and applies the force pressure x area.
// At rest the grains carry this force up to the solver's residual. The mass sets how fast the wall
// responds.
//
// PressureServo is for grains with a regularized law, whose contact force changes continuously with
// the position of the wall. It moves the wall at v = gain (pressure - measured). With k the
// stiffness of the sample in the direction of the wall [N/m], the error is multiplied by 1 - gain k
// h / area per step. Keep gain k h / area below 1; at 2 the servo is unstable.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"

namespace moreau {

/// A function that returns the area on which a pressure acts [m^2], in the plane the length [m]. It
/// is called before every step, as other walls may move.
template <class F>
concept AreaFunction = requires(const F area) {
  { area() } -> std::convertible_to<double>;
};

/// Pressure of the contacts on a wall over the last step [Pa], in the plane [N/m]; > 0 if the
/// grains push.
/// @param wall a half-space of the simulation
/// @param step its length [s], > 0
/// @param area [m^2], in the plane the length [m], > 0
/// @throws std::invalid_argument for a step or an area that is not finite or not positive, or a
///         body that is not a half-space of the simulation
template <class Simulation>
typename Simulation::Scalar wall_pressure(const Simulation& simulation, BodyId wall,
                                          typename Simulation::Scalar step,
                                          typename Simulation::Scalar area) {
  require(std::isfinite(step) && step > 0, "wall_pressure", "step", step, "must be finite and > 0");
  require(std::isfinite(area) && area > 0, "wall_pressure", "area", area, "must be finite and > 0");
  const auto walls = simulation.walls();
  require(std::find(walls.begin(), walls.end(), wall) != walls.end(), "wall_pressure", "wall", wall,
          "must be the id of a half-space");
  const typename Simulation::Vector impulse = simulation.contact_impulse(wall);
  return -simulation.bodies().axes(wall.index()).col(0).dot(impulse) / (step * area);
}

namespace detail {

/// The area now.
template <class T>
T checked_area(const auto& area, const char* function) {
  const auto now = static_cast<T>(area());
  require(std::isfinite(now) && now > 0, function, "area", now, "must be finite and > 0");
  return now;
}

}  // namespace detail

/// A constant pressure on a wall with a mass: exact where the wall is at rest.
template <AreaFunction Area>
class PressureLoad {
 public:
  /// Gives the wall its mass and stops it.
  /// @param wall     a half-space of the simulation
  /// @param pressure [Pa], in the plane [N/m]; pushes the wall along its normal, on the grains
  /// @param mass     of the wall [kg], > 0; that of the grains is a good choice
  /// @param area     called before every step, > 0 [m^2], in the plane [m]
  /// @throws std::invalid_argument for a body that is not a half-space of the simulation, a
  ///         pressure that is not finite, or a mass that is not finite or not positive
  template <class Simulation>
  PressureLoad(Simulation& simulation, BodyId wall, double pressure, double mass, Area area)
      : wall_(wall), pressure_(pressure), area_(std::move(area)) {
    require(std::isfinite(pressure), "PressureLoad", "pressure", pressure, "must be finite");
    require(std::isfinite(mass) && mass > 0, "PressureLoad", "mass", mass,
            "must be finite and > 0");
    using Scalar = typename Simulation::Scalar;
    simulation.set_wall_mass(wall, static_cast<Scalar>(mass));
    simulation.set_velocity(wall, Simulation::Vector::Zero());
  }

  /// Sets the force pressure x area for the next step. The step is not needed; drives have it.
  /// @throws std::invalid_argument for an area that is not finite or not positive
  template <class Simulation>
  void apply(Simulation& simulation, typename Simulation::Scalar = 0) const {
    using Scalar = typename Simulation::Scalar;
    const Scalar area = detail::checked_area<Scalar>(area_, "PressureLoad::apply");
    simulation.set_force(wall_, static_cast<Scalar>(pressure_) * area *
                                    simulation.bodies().axes(wall_.index()).col(0));
  }

 private:
  BodyId wall_;
  double pressure_;
  Area area_;
};

/// A pressure kept by the velocity of a wall without mass, for grains that yield.
template <AreaFunction Area>
class PressureServo {
 public:
  /// @param wall     a half-space without mass; apply() checks it
  /// @param pressure to keep [Pa], in the plane [N/m]; > 0 pushes on the grains
  /// @param gain     velocity per missing pressure [m/(s Pa)], in the plane [m^2/(s N)], > 0
  /// @param limit    the largest speed [m/s], > 0; margin x grain size / step at most, or the wall
  ///                 runs into grains before they are seen
  /// @param area     called before every step, > 0 [m^2], in the plane [m]
  /// @throws std::invalid_argument for a pressure that is not finite, or a gain or limit that is
  ///         not finite or not positive
  PressureServo(BodyId wall, double pressure, double gain, double limit, Area area)
      : wall_(wall), pressure_(pressure), gain_(gain), limit_(limit), area_(std::move(area)) {
    constexpr const char* self = "PressureServo";
    require(std::isfinite(pressure), self, "pressure", pressure, "must be finite");
    require(std::isfinite(gain) && gain > 0, self, "gain", gain, "must be finite and > 0");
    require(std::isfinite(limit) && limit > 0, self, "limit", limit, "must be finite and > 0");
  }

  /// Sets the velocity for the next step by the pressure of the last one.
  /// @param step length of the last step [s], > 0
  /// @throws std::invalid_argument for a body that is not a half-space of the simulation or
  ///         has a mass, or a step or an area that is not finite or not positive
  template <class Simulation>
  void apply(Simulation& simulation, typename Simulation::Scalar step) const {
    using Scalar = typename Simulation::Scalar;
    const Scalar area = detail::checked_area<Scalar>(area_, "PressureServo::apply");
    const double missing = pressure_ - double(wall_pressure(simulation, wall_, step, area));
    require(simulation.bodies().inverse_mass[wall_.index()].isZero(0), "PressureServo::apply",
            "wall", wall_, "must have no mass, or its velocity is not kept");
    const double speed = std::clamp(gain_ * missing, -limit_, limit_);
    simulation.set_velocity(
        wall_, static_cast<Scalar>(speed) * simulation.bodies().axes(wall_.index()).col(0));
  }

 private:
  BodyId wall_;
  double pressure_, gain_, limit_;
  Area area_;
};

}  // namespace moreau
