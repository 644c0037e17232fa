// SPDX-License-Identifier: MIT
// Grains that bounce in a box under gravity, and the energy that each step adds to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "moreau/motion/body_motion.hpp"
#include "moreau/shape/ball.hpp"

#include "world/assemblies.hpp"

namespace bouncing {

/// Kinetic energy of body i in the pose that it has at another time: its inertia turns, its angular momentum stays [J].
/// @param time from now on; 0 < |time| < h [s]
template <class S>
double kinetic_energy_at(const moreau::Bodies<S>& bodies, std::size_t i, typename S::Scalar time) {
  moreau::Pose<S> pose = bodies.pose[i];
  moreau::advance_pose<S>(pose, bodies.velocity[i], time);
  using Spin = Eigen::Matrix<double, S::angular_dim, 1>;
  using Inertia = Eigen::Matrix<double, S::angular_dim, S::angular_dim>;
  const Inertia now = bodies.inertia(i, bodies.pose[i].rotation).template cast<double>(),
                then = bodies.inertia(i, pose.rotation).template cast<double>();
  const Spin momentum = now * moreau::angular<S>(bodies.velocity[i]).template cast<double>();
  const auto v = moreau::linear<S>(bodies.velocity[i]).template cast<double>().eval();
  return (double(bodies.grain_mass[i]) * v.squaredNorm() +
          momentum.dot(then.inverse() * momentum)) /
         2;
}

/// What a run counts.
struct Tally {
  int steps = 0, unsolved = 0;
  int beyond = 0;  ///< solved steps that gain more than `lift` and 1e-9 of the kinetic energy
  double worst =
      -1;  ///< largest gain of a solved step, less 16 `lift`, over the kinetic energy before the step
  double kept =
      0;  ///< kinetic and potential energy at the end, over the kinetic energy at the start
};

struct Box {
  double restitution = 0, friction = 0;
  double mass_ratio = 1;  ///< of the heaviest to the lightest grain
  double gravity = 9.81;  ///< [m/s^2]
  double step = 1e-4;     ///< [s]
  int steps = 300, grains = 20;
  unsigned seed = 1;
};

/// Grains of 2 cm at 2 m/s and 50 rad/s that fall into a box, under gravity that is not along an axis.
/// @tparam World  a Simulation under SignoriniCoulomb
/// @param  shapes of the grains, circumradius 1 cm
template <class World, class ShapeT>
Tally count(const Box& box, const std::vector<ShapeT>& shapes) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using V = typename S::Vector;
  constexpr int up = S::dim - 1, per_side = S::dim == 2 ? 5 : 3;
  using Law = scenes::LawOf<ShapeT>;
  World world{T(0.02), moreau::Materials<Law>(1, Law(T(box.friction), T(box.restitution)))};
  std::mt19937_64 random(box.seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<moreau::ShapeId> ids;
  for (const ShapeT& shape : shapes) ids.push_back(world.add_shape(shape));
  constexpr double spacing = 0.0215;
  for (int k = 0; k < box.grains; ++k) {
    V x = V::Zero(), v;
    int rest = k;
    for (int axis = 0; axis < up; ++axis) {
      x[axis] = T(0.012 + spacing * (rest % per_side) + 5e-4 * uniform(random));
      rest /= per_side;
    }
    x[up] = T(0.0108 + spacing * rest);
    typename S::Angular turn, spin;
    for (auto& value : turn) value = T(3 * uniform(random));
    const double density = 2500 * std::pow(box.mass_ratio, (uniform(random) + 1) / 2);
    const auto grain =
        world.add_grain(ids[std::size_t(k) % ids.size()], {x, S::exp(turn)}, T(density));
    for (auto& value : v) value = T(2 * uniform(random));
    for (auto& value : spin) value = T(50 * uniform(random));
    world.set_velocity(grain, v);
    world.set_spin(grain, spin);
  }
  for (int axis = 0; axis < S::dim; ++axis) {
    world.add_wall(V(V::Unit(axis)), V::Zero());
    if (axis != up)
      world.add_wall(V(-V::Unit(axis)), V(T(spacing * per_side + 0.003) * V::Unit(axis)));
  }
  V gravity = V(T(-box.gravity) * V::Unit(up));
  gravity[0] = T(0.2 * box.gravity);
  world.set_gravity(gravity);

  Tally tally;
  double start = 0, sum = 0;
  const T h = T(box.step);
  for (tally.steps = 0; tally.steps < box.steps; ++tally.steps) {
    const moreau::Bodies<S> before = world.bodies();
    const moreau::StepReport report = world.step(h);
    const moreau::Bodies<S>& after = world.bodies();
    // The bound of E(r_0) in restitution_limit.hpp; that of an island at rest is 16 times as large.
    double kinetic = 0, gain = report.correction.work, lift = 0;
    for (std::size_t k = 0; k < world.grain_count(); ++k) {
      const std::size_t i = world.grain(k).index();
      const auto mass = double(before.grain_mass[i]);
      const double energy = kinetic_energy_at<S>(before, i, h / 2);
      const auto way = (after.pose[i].position.template cast<double>() -
                        before.pose[i].position.template cast<double>())
                           .eval();
      kinetic += energy;
      gain += kinetic_energy_at<S>(after, i, -h / 2) - energy -
              mass * gravity.template cast<double>().dot(way);
      lift += mass * double(gravity.squaredNorm()) * box.step * box.step / 8;
    }
    if (tally.steps == 0) start = kinetic;
    sum += gain;
    if (!report.solve.converged) {
      ++tally.unsolved;
      continue;
    }
    tally.worst = std::max(tally.worst, (gain - 16 * lift) / kinetic);
    if (gain > lift + 1e-9 * kinetic) ++tally.beyond;
  }
  tally.kept = 1 + sum / start;
  return tally;
}

}  // namespace bouncing
