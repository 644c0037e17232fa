// SPDX-License-Identifier: MIT
// Bodies that a user's function of time drives. The time loop applies a drive before each step:
//
//   const ForceDrive shake(wall, -Vector::UnitX(), HarmonicForce(100, 500, 5));
//   for (...) { shake.apply(world, h); world.step(h); }
//
// The function is taken at the middle of the step, which makes the motion second order in h for
// forces and velocities alike.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <numbers>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"

namespace moreau {

/// A number for every time [s].
template <class F, class T>
concept FunctionOfTime = requires(const F f, T t) {
  { f(t) } -> std::convertible_to<T>;
};

/// f(t) = (fmax + fmin)/2 - (fmax - fmin)/2 sin(2 pi nu (t - start)) [N], at all times, before the
/// start too. It drives the wall of E. Azema et al., arXiv 0711.1081.
class HarmonicForce {
 public:
  /// @param fmin,fmax the least and the largest force [N]
  /// @param frequency nu >= 0 [Hz]
  /// @param start     when the sine begins [s]
  /// @throws std::invalid_argument if one of them is not finite, for fmin > fmax or a negative
  ///         frequency
  HarmonicForce(double fmin, double fmax, double frequency, double start = 0)
      : mean_(fmin / 2 + fmax / 2), amplitude_(fmax / 2 - fmin / 2), start_(start) {
    constexpr const char* self = "HarmonicForce";
    require(std::isfinite(fmin), self, "fmin", fmin, "must be finite");
    require(std::isfinite(fmax) && fmax >= fmin, self, "fmax", fmax, "must be finite and >= fmin");
    require(std::isfinite(frequency) && frequency >= 0, self, "frequency", frequency,
            "must be finite and >= 0");
    require(std::isfinite(start), self, "start", start, "must be finite");
    rate_ = 2 * std::numbers::pi * frequency;
    require(std::isfinite(rate_), self, "frequency", frequency, "must be less");
  }
  /// f(t) [N] at the time t [s].
  double operator()(double t) const { return mean_ - amplitude_ * std::sin(rate_ * (t - start_)); }

 private:
  double mean_, amplitude_, rate_ = 0, start_;
};

/// A vector of Eigen's, such as Space<3>::Vector, that is none of its expressions.
template <class V>
concept PlainVector = std::same_as<V, typename V::PlainObject>;

namespace detail {

/// A body, a direction and a function of time.
template <class VectorT, class F>
class Drive {
 public:
  using Scalar = typename VectorT::Scalar;

  Drive(const char* self, BodyId body, const VectorT& direction, F f)
      : body_(body), direction_(direction), f_(std::move(f)) {
    require(std::abs(direction.norm() - 1) <= Scalar(1e-5), self, "direction", direction,
            "must be unit");
  }
  BodyId body() const { return body_; }
  /// Whether a force along the direction would move the body: not a wall without mass, nor one
  /// that moves along another normal.
  bool can_accelerate(const auto& simulation, const char* function) const {
    const auto& bodies = simulation.bodies();
    require(body_.index() < bodies.size(), function, "body", body_, "must be the id of a body");
    const auto root = bodies.mobility_root(body_.index()).linear;
    return (root * direction_).norm() > Scalar(1e-5) * root.norm();
  }
  /// What the function gives in the middle of the step that begins at t.
  VectorT value(Scalar t, Scalar step) const {
    return static_cast<Scalar>(f_(t + step / 2)) * direction_;
  }

 private:
  BodyId body_;
  VectorT direction_;
  F f_;
};

}  // namespace detail

/// A force f(t) [N] along a fixed direction on a body: on a grain, or on a wall that set_wall_mass
/// gave a mass. It takes the place of what set_force() gave the body.
template <PlainVector VectorT, FunctionOfTime<typename VectorT::Scalar> F>
class ForceDrive : public detail::Drive<VectorT, F> {
 public:
  /// @param body      a grain, or a wall with a mass; looked at by apply()
  /// @param direction D, unit, world axes; the body is pushed along it where f > 0
  /// @param f         called with the time in the middle of the step [s], returns [N]
  /// @throws std::invalid_argument for a direction that is not unit within 1e-5
  ForceDrive(BodyId body, const VectorT& direction, F f)
      : detail::Drive<VectorT, F>("ForceDrive", body, direction, std::move(f)) {}

  /// Sets the force for the next step, of this length [s].
  /// @throws std::invalid_argument for a body that is not the simulation's, one that the force
  ///         cannot move (a wall without set_wall_mass, or across its normal), a force not finite,
  ///         a step that is not finite or not positive
  void apply(auto& simulation, typename VectorT::Scalar step) const {
    constexpr const char* self = "ForceDrive::apply";
    require(std::isfinite(step) && step > 0, self, "step", step, "must be finite and > 0");
    require(this->can_accelerate(simulation, self), self, "body", this->body(),
            "must have a mass along the direction; set_wall_mass gives a wall one");
    simulation.set_force(this->body(), this->value(simulation.time(), step));
  }
};

/// A direction may be an expression, e.g. -Vector::UnitX().
template <class Expression, class F>
ForceDrive(BodyId, const Eigen::MatrixBase<Expression>&, F)
    -> ForceDrive<typename Expression::PlainObject, F>;

/// A velocity f(t) [m/s] along a fixed direction of a body that has no mass, such as a wall. It
/// takes the place of what set_velocity() gave the body.
template <PlainVector VectorT, FunctionOfTime<typename VectorT::Scalar> F>
class VelocityDrive : public detail::Drive<VectorT, F> {
 public:
  /// @param body      without mass along the direction; looked at by apply()
  /// @param direction D, unit, world axes; the body moves along it where f > 0
  /// @param f         called with the time in the middle of the step [s], returns [m/s]
  /// @throws std::invalid_argument for a direction that is not unit within 1e-5
  VelocityDrive(BodyId body, const VectorT& direction, F f)
      : detail::Drive<VectorT, F>("VelocityDrive", body, direction, std::move(f)) {}

  /// Sets the velocity for the next step, of this length [s].
  /// @throws std::invalid_argument for a body that is not the simulation's, one that has a mass
  ///         along the direction, a velocity not finite, a step that is not finite or not positive
  void apply(auto& simulation, typename VectorT::Scalar step) const {
    constexpr const char* self = "VelocityDrive::apply";
    require(std::isfinite(step) && step > 0, self, "step", step, "must be finite and > 0");
    require(!this->can_accelerate(simulation, self), self, "body", this->body(),
            "must have no mass along the direction, as a wall without set_wall_mass");
    simulation.set_velocity(this->body(), this->value(simulation.time(), step));
  }
};

/// A direction may be an expression, e.g. -Vector::UnitX().
template <class Expression, class F>
VelocityDrive(BodyId, const Eigen::MatrixBase<Expression>&, F)
    -> VelocityDrive<typename Expression::PlainObject, F>;

}  // namespace moreau
