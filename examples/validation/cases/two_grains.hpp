// SPDX-License-Identifier: MIT
// Two grains that collide without gravity: effective mass and effective radius of a contact.
#pragma once

#include <numbers>

#include "scene.hpp"

namespace validation {

namespace detail {

/// A grain at rest below, and a second grain that moves down onto it.
template <class ShapeT, class Law>
struct Encounter {
  using S = SpaceOf<ShapeT>;
  static constexpr int up = S::dim - 1;
  static constexpr double below = 0.05, above = 0.03;  ///< radii [m]
  World<ShapeT, Law> world;
  BodyId lower, upper;

  /// @param gap    initial gap [m]
  /// @param v_n,v_t of the upper grain, towards the lower one and across [m/s]
  Encounter(const Law& law, double gap, double v_n, double v_t = 0)
      : world(world_of<ShapeT, Law>(0.05, law)) {
    lower = world.add_grain(world.add_shape(ShapeT(below)), Pose<S>{}, 1000);
    upper = world.add_grain(world.add_shape(ShapeT(above)),
                            Pose<S>{in_plane<S>(0, below + above + gap)}, 1000);
    world.set_velocity(upper, in_plane<S>(v_t, -v_n));
  }
  double mass() const {  ///< effective mass [kg]
    return 1 / (1 / world.bodies().grain_mass[lower.index()] +
                1 / world.bodies().grain_mass[upper.index()]);
  }
  /// Effective radius [m].
  static constexpr double radius() { return 1 / (1 / below + 1 / above); }
  /// Velocity of the upper centre relative to the lower one [m/s].
  typename S::Vector velocity() const {
    return (world.bodies().velocity[upper.index()] - world.bodies().velocity[lower.index()])
        .template head<S::dim>();
  }
  double gap() const {
    const auto& pose = world.bodies().pose;
    return (pose[upper.index()].position - pose[lower.index()].position).norm() - below - above;
  }
  /// Runs until the grains have separated.
  /// @returns the largest overlap [m]
  double pass(double step) {
    double deepest = 0;
    do {
      world.step(step);
      deepest = std::max(deepest, -gap());
    } while (velocity()[up] <= 0 || gap() <= 0);
    return deepest;
  }
};

}  // namespace detail

/// Grains of two sizes separate with e times the velocity of approach v. Without damping the
/// overlap is v sqrt(m/k) on linear springs and (15 m v^2/(16 E sqrt R))^(2/5) on Hertz's, with E =
/// Y/(2(1 - nu^2)) for two equal materials (H. Hertz, J. reine angew. Math. 92 (1882) 156). m and R
/// are effective: 1/(1/a + 1/b).
template <class ShapeT, class Law, class Depth>
void head_on(Record& record, const auto& law, const Depth& depth) {
  using Encounter = detail::Encounter<ShapeT, Law>;
  const double v = 0.1, gap = 1e-9;
  const std::string name = with_law<Law>(with_shape<ShapeT>("two grains")) + ": ";
  Encounter soft(law(0.5), gap, v);
  const double expected = depth(soft.mass(), Encounter::radius(), v), step = expected / v / 2000;
  soft.pass(step);
  record.compare(name + "restitution", typename Encounter::S{}, 0.5,
                 soft.velocity()[Encounter::up] / v, 1e-3);
  Encounter elastic(law(1), gap, v);
  record.compare_relative(name + "largest overlap without damping [m]", typename Encounter::S{},
                          expected, elastic.pass(step), 1e-4);
  record.compare(name + "speed kept without damping", typename Encounter::S{}, 1,
                 elastic.velocity()[Encounter::up] / v, 1e-3);
}

/// Newton's restitution between two free grains.
template <class ShapeT>
void head_on_rigid(Record& record) {
  using Encounter = detail::Encounter<ShapeT, Coulomb<ShapeT>>;
  const double v = 1, h = 1e-4, closed = 1e-13;
  Encounter encounter(Coulomb<ShapeT>(0.3, 0.5), v * h / 2 - closed, v);
  encounter.world.step(h);
  record.compare(with_shape<ShapeT>("two grains") + ": restitution", typename Encounter::S{}, 0.5,
                 encounter.velocity()[Encounter::up] / v, 1e-10);
}

/// A contact that sticks on linear springs without damping also oscillates in the tangential
/// direction. With k = I/(m R^2) and the mass k/(1 + k) m of the slip, it oscillates for
/// sqrt(k_t/k_n (1 + 1/k)) half periods during the contact. The tangential velocity becomes v_t (1
/// + k/(1 + k) (cos(pi sqrt(..)) - 1)) (N. Maw, J. R. Barber and J. N. Fawcett, Wear 38 (1976) 101,
/// for the contact of spheres; here the springs are linear).
template <class ShapeT>
void sticks_across(Record& record) {
  using Encounter = detail::Encounter<ShapeT, Springs<ShapeT>>;
  using S = typename Encounter::S;
  const double stiffness = 1e9, share = 0.15, k = gyration<S>, v_n = 0.1, v_t = 0.01;
  Encounter encounter(Springs<ShapeT>(stiffness, share * stiffness, 1e6, 1), 1e-9, v_n, v_t);
  encounter.pass(std::sqrt(encounter.mass() / stiffness) / 2000);
  const double turn = std::numbers::pi * std::sqrt(share * (1 + 1 / k));
  record.compare_relative(with_law<Springs<ShapeT>>(with_shape<ShapeT>("two grains")) +
                              ": speed across after sticking [m/s]",
                          S{}, v_t * (1 + k / (1 + k) * (std::cos(turn) - 1)),
                          encounter.velocity()[0], 1e-3);
}

template <class ShapeT>
void encounters_of(Record& record) {
  using T = ScalarOf<ShapeT>;
  head_on_rigid<ShapeT>(record);
  head_on<ShapeT, Springs<ShapeT>>(
      record, [](double e) { return Springs<ShapeT>(1e6, 0, 0, T(e)); },
      [](double mass, double, double v) { return v * std::sqrt(mass / 1e6); });
  const double young = 1e11, poisson = 0.3;  // the overlap shortens the levers, by at most 1e-4 R
  head_on<ShapeT, Hertz<ShapeT>>(
      record, [&](double e) { return Hertz<ShapeT>::of_material(T(young), T(poisson), 0, T(e)); },
      [&](double mass, double radius, double v) {
        const double effective = young / (2 * (1 - poisson * poisson));
        return std::pow(15 * mass * v * v / (16 * effective * std::sqrt(radius)), 0.4);
      });
  sticks_across<ShapeT>(record);
}

inline void two_grains(Record& record, Effort) {
  encounters_of<Ball<double>>(record);
  encounters_of<Disk<double>>(record);
}

}  // namespace validation
