// SPDX-License-Identifier: MIT
// A drive prescribes the force on a body, or its velocity, as a function of time. The program
// applies the drive before each step of its time loop:
//
//   const ForceDrive shake(wall, -Vector::UnitX(), HarmonicForce(100, 500, 5));
//   for (...) { shake.apply(world, h); world.step(h); }
//
// A body has one drive: each apply() replaces the whole force, or the whole velocity along the axes that are prescribed.
// If two drives are applied to one body, only the last one acts; they do not add. Along several axes, call
// set_force() or set_velocity() with the sum before each step.
//
// The drive evaluates the function at the middle of the step. This makes the motion second-order
// accurate in the step, for forces and for velocities.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <numbers>
#include <type_traits>
#include <utility>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"

namespace moreau {

/// A function that returns a number for a time [s].
template <class F, class T>
concept FunctionOfTime = requires(const F f, T t) {
  { f(t) } -> std::convertible_to<T>;
};

/// A sinusoidal force f(t) = (fmax + fmin)/2 - (fmax - fmin)/2 sin(2 pi nu (t - start)) [N]. It has
/// this value at all times, also before the start. It is the force on the wall of E. Azema et al.,
/// arXiv 0711.1081.
class HarmonicForce {
 public:
  /// @param fmin,fmax smallest and largest force [N]
  /// @param frequency nu >= 0 [Hz]
  /// @param start     time at which the argument of the sine is zero [s]
  /// @throws std::invalid_argument if an argument is not finite, if fmin > fmax, or if the
  ///                               frequency is negative
  HarmonicForce(double fmin, double fmax, double frequency, double start = 0)
      : mean_(fmin / 2 + fmax / 2), amplitude_(fmax / 2 - fmin / 2), start_(start) {
    constexpr const char* self = "HarmonicForce";
    require(std::isfinite(fmin), self, "fmin", fmin, "must be finite");
    require(std::isfinite(fmax) && fmax >= fmin, self, "fmax", fmax, "must be finite and >= fmin");
    require(std::isfinite(frequency) && frequency >= 0, self, "frequency", frequency,
            "must be finite and >= 0");
    require(std::isfinite(start), self, "start", start, "must be finite");
    rate_ = 2 * std::numbers::pi * frequency;
    require(std::isfinite(rate_), self, "frequency", frequency,
            "must be smaller: 2 pi times it is not finite");
  }
  /// The force f(t) [N] at the time t [s].
  double operator()(double t) const { return mean_ - amplitude_ * std::sin(rate_ * (t - start_)); }

 private:
  double mean_, amplitude_, rate_ = 0, start_;
};

/// An Eigen vector, such as Space<3>::Vector, but not an Eigen expression.
template <class V>
concept PlainVector = std::same_as<V, typename V::PlainObject>;

/// A simulation whose vectors have the type VectorT, so that it has the dimension and the scalar
/// type of the drive.
template <class SimulationT, class VectorT>
concept SimulationWithVector = std::same_as<typename SimulationT::Vector, VectorT>;

namespace detail {

/// The vector of N components in braces; whole numbers stand for double.
template <class T, int N>
using ListVector = Eigen::Matrix<std::conditional_t<std::floating_point<T>, T, double>, N, 1>;

/// The common part of drives of forces and of velocities: a body, a direction and a function of
/// time.
template <PlainVector VectorT, FunctionOfTime<typename VectorT::Scalar> F>
class Drive {
 public:
  using Scalar = typename VectorT::Scalar;
  using Direction = Components<VectorT::SizeAtCompileTime, Scalar>;

  BodyId body() const { return body_; }  ///< the driven body

 protected:
  Drive(const char* self, BodyId body, const Direction& direction, F f)
      : body_(body), direction_(direction), f_(std::move(f)) {
    require(std::abs(direction.norm() - 1) <= Scalar(1e-5), self, "direction", direction,
            "must be unit");
  }
  /// The function's value at the middle of the step that begins now, times the direction.
  VectorT value(const SimulationWithVector<VectorT> auto& simulation, Scalar step,
                const char* self) const {
    require_positive(step, self, "step");
    return static_cast<Scalar>(f_(simulation.time() + step / 2)) * direction_;
  }
  /// If expected is true, throws unless a force along the direction accelerates the body. If
  /// expected is false, throws if such a force accelerates the body. The motion of a wall is prescribed
  /// until set_wall_mass() is called; then a force can accelerate it, but only along its normal.
  /// @returns M^-1/2 of the linear motion of the body [kg^-1/2], D x D, world axes
  auto require_mass(const auto& simulation, bool expected, const char* self,
                    const char* expectation) const {
    const auto root = linear_root(simulation, self);
    const bool accelerates = (root * direction_).norm() > Scalar(1e-5) * root.norm();
    require(accelerates == expected, self, "body", body_, expectation);
    return root;
  }

 private:
  /// M^-1/2 of the linear motion of the body [kg^-1/2], D x D, world axes.
  auto linear_root(const auto& simulation, const char* self) const {
    if constexpr (requires { simulation.mobility_root(body_); }) {  // of several processes
      return simulation.mobility_root(body_).linear;
    } else {
      const auto& bodies = simulation.bodies();
      require(body_.index() < bodies.size() && bodies.id[body_.index()] == body_, self, "body",
              body_, "must be the id of a body");
      return bodies.mobility_root(body_.index()).linear;
    }
  }

  BodyId body_;
  VectorT direction_;
  F f_;
};

}  // namespace detail

/// A force f(t) [N] on a body along a fixed direction. The body is a grain whose motion is not
/// prescribed, or a wall to which set_wall_mass has given a mass; of a DistributedSimulation, a wall. The
/// force replaces the force that set_force() has set.
template <class VectorT, class F>
class [[gnu::warn_unused]] ForceDrive : public detail::Drive<VectorT, F> {
  using Base = detail::Drive<VectorT, F>;

 public:
  /// @param body      a grain, or a wall with a mass; apply() checks this
  /// @param direction D components, unit, world axes; f > 0 pushes the body in this direction
  /// @param f         function: time at the middle of the step [s] -> force [N]
  /// @throws std::invalid_argument if the length of the direction differs from 1 by more than 1e-5
  ForceDrive(BodyId body, const typename Base::Direction& direction, F f)
      : Base("ForceDrive", body, direction, std::move(f)) {}

  /// Sets the force for the next step.
  /// @param step length of the next step [s]
  /// @throws std::invalid_argument for a body that is not in the simulation, a body that the force
  ///                               cannot move (a wall without set_wall_mass, or a force
  ///                               perpendicular to the wall's normal), a force that is not finite,
  ///                               or a step that is not finite or not positive
  void apply(SimulationWithVector<VectorT> auto& simulation, typename Base::Scalar step) const {
    constexpr const char* self = "ForceDrive::apply";
    const VectorT force = this->value(simulation, step, self);
    this->require_mass(simulation, true, self,
                       "must have a mass along the direction; set_wall_mass gives a wall one");
    simulation.set_force(this->body(), force);
  }
};

/// A velocity f(t) [m/s] along a fixed direction of a body whose motion is prescribed along it: a wall without
/// set_wall_mass(), a grain after prescribe_motion(), or a wall with a mass along a direction in its plane,
/// as the lid of a shear cell. It replaces the velocity that set_velocity() has set; a wall with a mass keeps the
/// velocity along its normal, which forces and contacts change.
template <class VectorT, class F>
class [[gnu::warn_unused]] VelocityDrive : public detail::Drive<VectorT, F> {
  using Base = detail::Drive<VectorT, F>;

 public:
  /// @param body      a body whose motion along the direction is prescribed; apply() checks this
  /// @param direction D components, unit, world axes; if f > 0 the body moves in this direction
  /// @param f         function: time at the middle of the step [s] -> velocity [m/s]
  /// @throws std::invalid_argument if the length of the direction differs from 1 by more than 1e-5
  VelocityDrive(BodyId body, const typename Base::Direction& direction, F f)
      : Base("VelocityDrive", body, direction, std::move(f)) {}

  /// Sets the velocity for the next step.
  /// @param step length of the next step [s]
  /// @throws std::invalid_argument for a body that is not in the simulation, a body that
  ///                               forces along the direction accelerate, a velocity that is not
  ///                               finite, or a step that is not finite or not positive
  void apply(SimulationWithVector<VectorT> auto& simulation, typename Base::Scalar step) const {
    constexpr const char* self = "VelocityDrive::apply";
    VectorT velocity = this->value(simulation, step, self);
    // n n^T / sqrt(m) for a wall with a mass and the normal n; else 0.
    const auto root = this->require_mass(
        simulation, false, self,
        "must have a prescribed motion along the direction, as a wall without set_wall_mass");
    if (root.norm() > 0) velocity += root * simulation.velocity(this->body()) / root.norm();
    simulation.set_velocity(this->body(), velocity);
  }
};

/// The direction can be an Eigen expression, such as -Vector::UnitX().
template <class Expression, class F>
ForceDrive(BodyId, const Eigen::MatrixBase<Expression>&, F)
    -> ForceDrive<typename Expression::PlainObject, F>;
/// The direction can be a list of components, such as {0, 0, 1}.
template <class T, std::size_t N, class F>
ForceDrive(BodyId, const T (&)[N], F) -> ForceDrive<detail::ListVector<T, int(N)>, F>;
/// The direction can be an Eigen expression, such as -Vector::UnitX().
template <class Expression, class F>
VelocityDrive(BodyId, const Eigen::MatrixBase<Expression>&, F)
    -> VelocityDrive<typename Expression::PlainObject, F>;
/// The direction can be a list of components, such as {0, 0, 1}.
template <class T, std::size_t N, class F>
VelocityDrive(BodyId, const T (&)[N], F) -> VelocityDrive<detail::ListVector<T, int(N)>, F>;

}  // namespace moreau
