// SPDX-License-Identifier: MIT
// A block on the floor, under a force across the floor that grows: it slides where the force is mu_s times the weight,
// and then has the friction in slip, until it rests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>
#include <span>
#include <vector>

#include "world/assemblies.hpp"

namespace static_friction {

struct Options {
  int corners = 4;       ///< of the face, in space
  double height = 0.05;  ///< half height of the block; its half width is 0.05 [m]
  double lever = 0;  ///< height at which the force acts above the centre, over the half height [-]
  double azimuth = 0;    ///< of the force, in space [rad]
  bool incline = false;  ///< the force is a component of gravity
  bool islands = true;   ///< by the direct method
  bool few = false;      ///< at most D contact points
  double step = 1e-3;    ///< [s]
  double rate = 0.5;     ///< of the force over the weight [1/s]
  double tolerance = 1e-4;
};

template <class ShapeT>
class Block {
 public:
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = scenes::LawOf<ShapeT>;
  static constexpr double kinetic = 0.3, resting = 0.4, gravity = 10;

  explicit Block(const Options& options)
      : options_(options),
        world_(T(0.1), moreau::Materials<Law>(1, Law(T(kinetic), T(0), T(resting))),
               solver(options)) {
    if (options.few) world_.set_contact_points(moreau::ContactPoints::few);
    world_.add_wall(Vector(up()), Vector(Vector::Zero()));
    along_ = Vector::Zero();
    along_[0] = T(std::cos(options.azimuth));
    if constexpr (S::dim == 3) along_[1] = T(std::sin(options.azimuth));
    moreau::Pose<S> pose;
    pose.position = T(options.height) * up();
    block_ = world_.add_grain(world_.add_shape(shape()), pose, T(1000));
    weight_ = double(world_.bodies().grain_mass[block_.index()]) * gravity;
  }
  /// Lets the force grow from a quarter of the weight until the block slides. @returns the force over the weight
  double threshold() {
    for (double force = 0.25; force < 0.5; force += options_.rate * options_.step) {
      push(force);
      if (slides()) return force;
    }
    return 0.5;
  }
  /// A step under a force over the weight. @returns the friction over the weight
  double push(double force) {
    double down = gravity, across = 0;
    if (options_.incline) {
      down = gravity / std::hypot(1, force);
      across = force * down;
    } else {
      world_.set_force(block_, Vector(T(force * weight_) * along_));
      const double moment = force * weight_ * options_.lever * options_.height;
      typename S::Angular torque = S::Angular::Zero();
      if constexpr (S::dim == 2)
        torque[0] = T(-moment);
      else
        torque.template head<2>() = T(moment) * Eigen::Vector2<T>(-along_[1], along_[0]);
      world_.set_torque(block_, torque);
    }
    world_.set_gravity(Vector(T(across) * along_ - T(down) * up()));
    world_.step(T(options_.step));
    const Vector impulse = world_.contact_impulse(block_);
    return -double(impulse.dot(along_)) / double(impulse.dot(up()));
  }
  /// Whether a contact point has the friction in slip.
  bool slides() const {
    const auto& variants = world_.contacts().variants;
    return std::any_of(variants.begin(), variants.end(), [](auto k) { return k != 0; });
  }
  double speed() const { return double(world_.velocity(block_).dot(along_)); }

 private:
  static moreau::ColouredGaussSeidel solver(const Options& options) {
    moreau::ColouredOptions coloured;
    coloured.islands = options.islands;
    coloured.tolerance = options.tolerance;
    return moreau::ColouredGaussSeidel(coloured);
  }
  static Vector up() { return Vector::Unit(S::dim - 1); }
  ShapeT shape() const {
    std::vector<Vector> corners;
    const auto add = [&](double x, double y) {
      for (const double z : {-options_.height, options_.height}) {
        Vector corner = T(z) * up();
        corner[0] = T(x);
        if constexpr (S::dim == 3) corner[1] = T(y);
        corners.push_back(corner);
      }
    };
    const int sides = S::dim == 2 ? 2 : options_.corners;
    const double first = sides == 2 ? 0 : 0.5, radius = sides == 2 ? 0.05 : 0.05 * std::sqrt(2);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * (k + first) / sides;
      add(radius * std::cos(angle), radius * std::sin(angle));
    }
    return ShapeT(std::span<const Vector>(corners));
  }

  Options options_;
  scenes::World<ShapeT> world_;
  moreau::BodyId block_;
  Vector along_;
  double weight_ = 0;  // [N]
};

/// Checks that a block slides to rest with its own friction, and is pushed with it, whatever the mass of a block that rests
/// 5 m away.
/// @param ratio   mass of the other block over that of the block
/// @param step    [s]
/// @param islands by the direct method
template <class ShapeT>
void check_beside(double ratio, double step, bool islands) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = scenes::LawOf<ShapeT>;
  constexpr double kinetic = 0.3, resting = 0.6, gravity = 10;
  CAPTURE(S::dim);
  CAPTURE(sizeof(T));
  CAPTURE(ratio);
  CAPTURE(step);
  CAPTURE(islands);
  moreau::Materials<Law> materials(2, Law(T(kinetic), T(0), T(resting)));
  materials.set(moreau::MaterialId(0), moreau::MaterialId(1), Law(T(0)));
  moreau::ColouredOptions coloured;
  coloured.islands = islands;
  scenes::World<ShapeT> world(T(0.1), materials, moreau::ColouredGaussSeidel(coloured));
  const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(0.05))));
  const auto large = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(0.5))));
  const auto add = [&](moreau::ShapeId id, double x, double z, double density,
                       std::size_t material) {
    moreau::Pose<S> pose;
    pose.position[0] = T(x);
    pose.position[S::dim - 1] = T(z);
    return world.add_grain(id, pose, T(density), moreau::MaterialId(material));
  };
  world.add_wall(Vector(Vector::Unit(S::dim - 1)), Vector(Vector::Zero()));
  world.set_gravity(Vector(-T(gravity) * Vector::Unit(S::dim - 1)));
  const auto block = add(shape, 0, 0.05, 2500, 0);
  add(large, -5, 0.5, 2500 * ratio / std::pow(10, S::dim), 0);
  const auto speed = [&] { return double(world.velocity(block)[0]) / (gravity * step); };
  for (int k = 0; k < 100; ++k) world.step(T(step));
  world.set_velocity(block, Vector(T(12.5 * kinetic * gravity * step) * Vector::UnitX()));
  world.step(T(step));
  // As the last kick of static friction.
  CHECK(speed() == doctest::Approx(12.5 * kinetic - resting).epsilon(0.01));
  for (int k = 1; k <= 10; ++k) {
    world.step(T(step));
    CHECK(speed() == doctest::Approx((10.5 - k) * kinetic).epsilon(0.01));
  }
  for (int k = 0; k < 10; ++k) world.step(T(step));
  CHECK(std::abs(speed()) < 1e-3);

  const double x = double(world.pose(block).position[0]);
  const auto pusher = add(shape, x - 0.1, 0.05, 2500, 1);
  world.prescribe_motion(pusher);
  world.set_velocity(pusher, Vector(T(0.1 * gravity * step) * Vector::UnitX()));
  const double weight = double(world.bodies().grain_mass[block.index()]) * gravity;
  for (int k = 0; k < 40; ++k) {
    world.step(T(step));
    if (k < 10) continue;
    const double force = -double(world.contact_impulse(pusher)[0]) / step;
    CHECK(force / weight == doctest::Approx(kinetic).epsilon(0.01));
  }
}

/// Checks the threshold, the friction in slip, that the block comes to rest, and the threshold once more.
template <class ShapeT>
void check(const Options& options) {
  using B = Block<ShapeT>;
  CAPTURE(B::S::dim);
  CAPTURE(sizeof(typename B::T));
  CAPTURE(options.corners);
  CAPTURE(options.height);
  CAPTURE(options.lever);
  CAPTURE(options.azimuth);
  CAPTURE(options.incline);
  CAPTURE(options.islands);
  CAPTURE(options.few);
  CAPTURE(options.step);
  CAPTURE(options.tolerance);
  Block<ShapeT> block(options);
  // A float has roundings of the gap of 4e-9 m, through which the block falls at first, in steps of 1e-5 s in a few of them.
  for (int k = 0; k < 100; ++k) block.push(0);
  for (const bool again : {false, true}) {
    CAPTURE(again);
    CHECK(block.threshold() == doctest::Approx(B::resting).epsilon(0.01));
    for (int k = 0; k < 20; ++k) {
      const double friction = block.push(0.42);
      if (k > 10) CHECK(friction == doctest::Approx(B::kinetic).epsilon(0.002));
    }
    CHECK(block.speed() > 0);
    for (int k = 0; k < 1000 && block.slides(); ++k) block.push(0);
    CHECK_FALSE(block.slides());
  }
}

}  // namespace static_friction
