// SPDX-License-Identifier: MIT
// Motion without contacts.
#pragma once

#include "scene.hpp"

namespace validation {

namespace detail {

/// Errors of the position [m] and of the velocity [m/s] of a thrown grain after half a second, with
/// the step 1/steps_per_second.
struct FlightError {
  double position, velocity;
};
template <class ShapeT, class Law>
FlightError fly(World<ShapeT, Law>& world, int steps_per_second) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector start = Vector::Constant(0.3), velocity = in_plane<S>(1, 2);
  const double time = 0.5;
  const BodyId grain = world.add_grain(world.add_shape(regular<ShapeT>(0.05)),
                                       {start, S::exp(S::Angular::Constant(0.4))}, 1000);
  world.set_gravity(tilted_gravity<S>(0.1));
  world.set_velocity(grain, velocity);
  world.set_spin(grain, S::Angular::Constant(2));
  for (int k = 0; k < steps_per_second / 2; ++k) world.step(1.0 / steps_per_second);
  const Vector x = start + time * velocity + time * time / 2 * world.gravity();
  const Vector v = velocity + time * world.gravity();
  const auto& bodies = world.bodies();
  return {(bodies.pose[grain.index()].position - x).norm(),
          (bodies.velocity[grain.index()].template head<S::dim>() - v).norm()};
}

}  // namespace detail

/// Free fall: v = v0 + g t in every scheme; x = x0 + v0 t + g t^2/2 for theta = 1/2 and velocity
/// Verlet.
template <class ShapeT, class Law>
void free_fall_exact(Record& record) {
  using S = SpaceOf<ShapeT>;
  auto world = world_of<ShapeT, Law>(0.1, Law{});
  const auto error = detail::fly(world, 512);
  const std::string name = with_law<Law>(with_shape<ShapeT>("free fall"));
  record.vanishes(name + ": velocity [m/s]", S{}, error.velocity, 1e-12);
  record.vanishes(name + ": position [m]", S{}, error.position, 1e-12);
}

/// For theta = 1 the error of the position is g t h/2.
template <class ShapeT>
void free_fall_implicit(Record& record) {
  std::vector<double> steps, errors;
  for (const int rate : {128, 256, 512}) {
    auto world = world_of<ShapeT, Coulomb<ShapeT>>(0.1, Coulomb<ShapeT>(), tight(), {}, 1);
    const double error = detail::fly(world, rate).position, h = 1.0 / rate;
    steps.push_back(h);
    errors.push_back(error);
    if (rate == 512)
      record.compare(with_shape<ShapeT>("free fall, theta = 1") + ": error, g t h/2 [m]",
                     SpaceOf<ShapeT>{}, gravity * 0.5 * h / 2, error, 1e-12);
  }
  record.compare(with_shape<ShapeT>("free fall, theta = 1") + ": order", SpaceOf<ShapeT>{}, 1,
                 order_of(steps, errors), 1e-6);
}

template <class ShapeT>
void free_fall_of(Record& record) {
  free_fall_exact<ShapeT, Coulomb<ShapeT>>(record);
  free_fall_exact<ShapeT, Springs<ShapeT>>(record);
  if constexpr (is_round<ShapeT>) free_fall_exact<ShapeT, Hertz<ShapeT>>(record);
  free_fall_implicit<ShapeT>(record);
}

template <class T>
void free_fall(Record& record, Effort) {
  free_fall_of<Polyhedron<T>>(record);
  free_fall_of<Polygon<T>>(record);
  free_fall_of<Ball<T>>(record);
  free_fall_of<Disk<T>>(record);
}

/// A free body with three different moments of inertia rotates about the middle axis y with Omega.
/// A disturbance (a, b) of the angular velocity about (x, z) obeys
///
///     a' = (I_y - I_z)/I_x Omega b,     b' = (I_x - I_y)/I_z Omega a
///
/// and grows with the rate Omega sqrt((I2 - I1)(I3 - I2)/(I1 I3)) (L. Euler; Landau and Lifshitz,
/// Mechanics, section 37).
template <class ShapeT, class Law>
struct Top {
  using S = SpaceOf<ShapeT>;
  static constexpr double omega = 10;
  World<ShapeT, Law> world;
  moreau::MassProperties<S> mass;
  typename S::Rotation start = S::exp({0.3, -0.7, 1.1});
  double rate, ratio;  ///< growth rate [1/s]; b/a of the growing mode

  /// @param disturbance initial a/Omega
  explicit Top(double disturbance, double theta = 0.5)
      : world(world_of<ShapeT, Law>(0.1, Law{}, tight(), {}, theta)) {
    const ShapeT box = cuboid<ShapeT>({0.03, 0.05, 0.08});
    mass = box.mass_properties(1000);
    const auto I = mass.inertia.diagonal();
    rate = omega * std::sqrt((I[0] - I[1]) * (I[1] - I[2]) / (I[0] * I[2]));
    ratio = rate * I[0] / ((I[1] - I[2]) * omega);
    const double a = disturbance * omega;
    world.add_grain(world.add_shape(box), {S::Vector::Zero(), start}, 1000);
    world.set_spin(world.grain(0), start * typename S::Vector(a, omega, ratio * a));
  }
  double disturbance() const {
    const auto& bodies = world.bodies();
    return (bodies.pose[0].rotation.inverse() * bodies.velocity[0].template tail<3>())[0] / omega;
  }
};

template <class ShapeT, class Law>
double growth_rate(double h, Curve* curve) {
  Top<ShapeT, Law> top(1e-6);
  const int steps = static_cast<int>(std::lround(6 / top.rate / h));
  for (int k = 1; k <= steps; ++k) {
    top.world.step(h);
    if (curve && k % 20 == 0)
      curve->rows.push_back(
          {top.world.time(), top.disturbance(), 1e-6 * std::exp(top.rate * top.world.time())});
  }
  return std::log(top.disturbance() / 1e-6) / top.world.time();
}

template <class ShapeT, class Law>
void top_growth(Record& record) {
  const std::string name = with_law<Law>("asymmetric top") + ": ";
  const SpaceOf<ShapeT> space;
  Curve& curve = record.curve(is_rigid<ShapeT, Law> ? "top" : "top_verlet", space,
                              {"t", "disturbance", "exact"});
  const double exact = Top<ShapeT, Law>(0).rate;
  std::vector<double> steps, errors;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const double rate = growth_rate<ShapeT, Law>(h, h == 5e-4 ? &curve : nullptr);
    steps.push_back(h);
    errors.push_back(std::abs(rate - exact));
    if (h == 5e-4)
      record.compare_relative(name + "growth rate of the middle axis [1/s]", space, exact, rate,
                              1e-4);
  }
  record.compare(name + "order of the growth rate", space, 2, order_of(steps, errors), 0.1);
}

/// Angular momentum and energy of a tumbling body over about thirty revolutions for theta = 1/2.
template <class ShapeT, class Law>
void top_conserved(Record& record, double theta = 0.5) {
  // [s]; with theta = 1 the body soon rotates about the axis of largest inertia.
  const double time = theta == 1 ? 1 : 20;
  std::vector<double> steps, drifts;
  double worst = 0;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    Top<ShapeT, Law> top(0.05, theta);
    const auto L = momentum(top.world).angular;
    const double E = kinetic_energy(top.world);
    double drift = 0;
    while (top.world.time() < time) {
      top.world.step(h);
      worst = std::max(worst, double((momentum(top.world).angular - L).norm() / L.norm()));
      drift = std::max(drift, std::abs(kinetic_energy(top.world) / E - 1));
    }
    steps.push_back(h);
    drifts.push_back(drift);
  }
  const SpaceOf<ShapeT> space;
  const std::string name = with_theta(theta, with_law<Law>("asymmetric top")) + ": ";
  record.vanishes(name + "angular momentum, relative change", space, worst, 1e-10);
  record.compare(name + "order of the energy's change", space, theta == 1 ? 1 : 2,
                 order_of(steps, drifts), 0.1);
}

template <class T>
void asymmetric_top(Record& record, Effort) {
  using Shape = Polyhedron<T>;
  if constexpr (std::is_same_v<T, double>) {  // in float 1e-6 is a few roundings
    top_growth<Shape, Coulomb<Shape>>(record);
    top_growth<Shape, Springs<Shape>>(record);
  }
  top_conserved<Shape, Coulomb<Shape>>(record);
  top_conserved<Shape, Coulomb<Shape>>(record, 1);
  top_conserved<Shape, Springs<Shape>>(record);
}

}  // namespace validation
