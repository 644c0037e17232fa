// SPDX-License-Identifier: MIT
// Whether a packing is at rest. No single number of one step shows it: grains at the top of their path are slow,
// too, and the kinetic energy of a packing at rest is not zero but as small as the tolerance of the solver.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// When a packing counts as at rest.
struct RestOptions {
  /// Largest speed of the grains, the root of 2 x kinetic energy / mass, and of each wall with a mass along its normal
  /// [m/s]. If it is 0, it is the speed at which a grain rises by 1e-5 of the grain size under the gravity of the simulation.
  double speed = 0;
  /// Largest part of the load that walls and obstacles do not carry [-]. The load is the sum of the weights of the
  /// grains and the forces applied to them. It is not tested if it is zero to rounding: without gravity and applied
  /// forces, or with forces that cancel. The same of the force on each wall with a mass, which the grains carry.
  double load = 0.01;
  /// Time for which speed and load must stay within their limits, and all steps must be solved [s].
  double time = 0.05;
  /// Once they are within their limits, they may exceed them by this factor, >= 1, before the time begins anew.
  double hysteresis = 4;
};

/// Decides after each step whether a packing is at rest:
///
///     moreau::RestTest rest;
///     while (!rest.add(simulation, simulation.step(h), h)) {}
///
/// It does so if for RestOptions::time every step was solved, grains and walls with a mass were slow, and walls and
/// obstacles carried the grains. Grains whose motion is prescribed are obstacles.
class RestTest {
 public:
  /// @throws std::invalid_argument for an option that is not finite or out of range
  explicit RestTest(const RestOptions& options = {}) : options_(options) {
    const auto check = [](double value, double least, const char* name, const char* range) {
      require(std::isfinite(value) && value >= least, "RestTest", name, value, range);
    };
    check(options.speed, 0, "options.speed", "must be finite and >= 0");
    check(options.load, 0, "options.load", "must be finite and >= 0");
    check(options.time, 0, "options.time", "must be finite and >= 0");
    check(options.hysteresis, 1, "options.hysteresis", "must be finite and >= 1");
  }

  /// Takes a step into account.
  /// @param simulation after the step
  /// @param report     what the step returned
  /// @param step       its length, that of the report [s]
  /// @returns whether the packing is at rest
  /// @throws std::invalid_argument if RestOptions::speed is 0 and there is no gravity, or if the step is not positive
  ///         or not that of the report
  template <class Simulation>
  bool add(const Simulation& simulation, const StepReport& report, double step) {
    require_positive(step, "RestTest::add", "step");
    // The report of a simulation in single precision has the step in single precision.
    require(std::abs(step - report.step) <= 1e-6 * step, "RestTest::add", "step", step,
            "must be the step of the report");
    const double gravity = double(simulation.gravity().norm());
    require(options_.speed > 0 || gravity > 0, "RestTest::add", "options.speed", options_.speed,
            "must be > 0 without gravity");
    limit_ = options_.speed > 0 ? options_.speed
                                : std::sqrt(2e-5 * gravity * double(simulation.grain_size()));
    measure(simulation, step);
    solved_ = report.solve.converged;
    const double factor = time_ > 0 ? options_.hysteresis : 1;
    const bool calm =
        solved_ && speed_ <= factor * limit_ && missing_load_ <= factor * options_.load;
    time_ = calm ? time_ + step : 0;
    return is_at_rest();
  }

  /// Whether the packing was at rest after the last step.
  bool is_at_rest() const { return time_ > 0 && time_ >= options_.time * (1 - 1e-9); }
  double time() const { return time_; }  ///< for which the conditions hold [s]; 0 if they do not
  /// After the last step: of the grains, or of the fastest wall with a mass if that is larger [m/s], see RestOptions.
  double speed() const { return speed_; }
  /// Part of the weight that walls and obstacles did not carry in the last step, or of the force on a wall with a mass and
  /// the weight that the grains did not carry, if that is larger [-].
  double missing_load() const { return missing_load_; }
  /// Why the packing is not at rest, as a sentence with numbers; empty if it is. It names the first that holds of: no step
  /// was added, the last step was not solved, the time is too short, the grains are too fast, the load is not carried.
  std::string reason() const {
    std::ostringstream text;
    text.precision(3);
    if (is_at_rest()) return {};
    if (!(limit_ > 0))
      text << "no step was added";
    else if (!solved_)
      text << "the last step was not solved";
    else if (time_ > 0)
      text << "at rest for " << time_ << " s of " << options_.time << " s";
    else if (speed_ > limit_)
      text << (is_of_wall_ ? "a wall with a mass moves with " : "the grains move with ") << speed_
           << " m/s, the limit is " << limit_ << " m/s";
    else
      text << (is_load_of_wall_ ? "the grains do not carry the force on a wall with a mass, "
                                : "walls and obstacles do not carry ")
           << missing_load_ << (is_load_of_wall_ ? " of the load" : " of the weight")
           << ", the limit is " << options_.load;
    return text.str();
  }

 private:
  template <class Simulation>
  void measure(const Simulation& simulation, double step) {
    using S = typename Simulation::S;
    using Vector = typename S::Vector;
    const auto& bodies = simulation.bodies();
    double mass = 0, energy = 0;
    // Of the grains that move: the sum of the loads, and of their norms [N].
    Eigen::Matrix<double, S::dim, 1> load = Eigen::Matrix<double, S::dim, 1>::Zero();
    double loads = 0;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const std::size_t i = simulation.grain(k).index();
      if (bodies.is_prescribed(i)) continue;
      mass += double(bodies.grain_mass[i]);
      const BodyMotion<S> motion{bodies.grain_mass[i], bodies.inertia(i, bodies.pose[i].rotation),
                                 bodies.pose[i].position, bodies.velocity[i]};
      energy += double(kinetic_energy<S>(motion).total());
      const Vector weight = bodies.grain_mass[i] * simulation.gravity();
      load += (weight + linear<S>(bodies.force[i])).template cast<double>();
      loads += double(weight.norm() + linear<S>(bodies.force[i]).norm());
    }
    speed_ = mass > 0 ? std::sqrt(2 * energy / mass) : 0;
    // On walls and obstacles, from the grains that move.
    const auto carries = [&](std::size_t i) {
      return !simulation.is_grain(i) || bodies.is_prescribed(i);
    };
    detail::DoubleSum<Vector> impulses;
    const auto& contacts = simulation.contacts();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& point = contacts.points[c];
      if (carries(point.a) == carries(point.b)) continue;
      const Vector impulse = point.frame * contacts.impulse(c);
      impulses += carries(point.b) ? impulse : Vector(-impulse);
    }
    const Vector carried = impulses.over(step);
    // Each load has the rounding of its scalar, and each sum that of the total.
    const double rounding =
        2 * double(std::numeric_limits<typename S::Scalar>::epsilon()) +
        double(simulation.grain_count()) * std::numeric_limits<double>::epsilon();
    missing_load_ = load.norm() > rounding * loads
                        ? (carried.template cast<double>() - load).norm() / load.norm()
                        : 0;
    measure_walls(simulation, step, load.norm());
  }
  /// Walls with a mass: along its normal each is slow, and grains carry the force on it.
  /// @param load of the grains [N]
  template <class Simulation>
  void measure_walls(const Simulation& simulation, double step, double load) {
    using S = typename Simulation::S;
    using Vector = typename S::Vector;
    const auto& bodies = simulation.bodies();
    is_of_wall_ = is_load_of_wall_ = false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (simulation.is_grain(i) || bodies.is_prescribed(i)) continue;
      const Vector normal = bodies.axes(i).col(0);
      const auto along = [&](const Vector& x) { return double(normal.dot(x)); };
      const double speed = std::abs(along(linear<S>(bodies.velocity[i]))),
                   force = along(linear<S>(bodies.force[i])),
                   push = along(simulation.contacts().impulse_on(std::uint32_t(i))) / step;
      // The impulses have errors of the solver, which are relative to those of all contacts; without any, it is in the air.
      const double share = force == 0  ? 0
                           : push == 0 ? 1
                                       : std::abs(force + push) / (std::abs(force) + load);
      if (speed > speed_) speed_ = speed, is_of_wall_ = true;
      if (share > missing_load_) missing_load_ = share, is_load_of_wall_ = true;
    }
  }

  RestOptions options_;
  double time_ = 0, speed_ = 0, missing_load_ = 0, limit_ = 0;
  bool solved_ = false;
  bool is_of_wall_ = false, is_load_of_wall_ = false;  // whether a wall has the speed, the load
};

}  // namespace moreau
