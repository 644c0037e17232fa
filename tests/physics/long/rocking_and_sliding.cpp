// SPDX-License-Identifier: MIT
// A block that rocks on a floor loses the energy that Housner's formula says, and a block on the inside of a drum that turns
// moves like a pendulum with friction.
#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>

#include "physics/kinds.hpp"
#include "sanitized.hpp"

using namespace kinds;

namespace {

template <class ShapeT>
ShapeT block(double half_width, double half_height) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  typename S::Vector half = S::Vector::Constant(T(0.1));
  half[0] = T(half_width);
  half[S::dim - 1] = T(half_height);
  return scenes::cuboid<ShapeT>(half);
}
/// A rotation from the last axis towards the first one by an angle.
template <class S>
typename S::Angular turn(double angle) {
  using T = typename S::Scalar;
  typename S::Angular w = S::Angular::Zero();
  if constexpr (S::dim == 3)
    w[1] = T(angle);
  else
    w[0] = T(-angle);
  return w;
}

}  // namespace

// G. W. Housner, Bull. Seismol. Soc. Am. 53 (1963) 403: where the block lands on its other edge without a rebound, the
// angular momentum about this edge is kept, and the energy becomes (1 - 1.5 sin^2 alpha)^2 of that before, alpha the angle
// between the diagonal and the height. A step finds the impact at its own end: the energy
// that is lost has an error of first order, g h / v of the energy, v the velocity of the edge that lands.
TEST_CASE_TEMPLATE("a rocking block loses the energy of Housner's formula", ShapeT, Polyhedron<>,
                   Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  for (const double width : {0.1, 0.2})
    for (const double step : {1e-3, 2.5e-4}) {
      const double height = 0.4, alpha = std::atan(width / height),
                   radius = std::hypot(width, height);
      World<ShapeT> world = world_of<ShapeT>(0.2, 2, Vector::Unit(up));
      world.add_wall(Vector::Unit(up), Vector::Zero());
      const double lean = alpha / 2;
      Vector x = Vector::Zero();
      x[0] = T(width - radius * std::sin(alpha - lean));
      x[up] = T(radius * std::cos(alpha - lean));
      const auto grain = world.add_grain(world.add_shape(block<ShapeT>(width, height)),
                                         {x, S::exp(turn<S>(lean))}, T(1000));
      const double inertia = radius * radius / 3;  // over the mass, about the centre
      const auto energy = [&] {
        return double(world.velocity(grain).squaredNorm()) / 2 +
               inertia * double(world.spin(grain).squaredNorm()) / 2 +
               weight * (double(world.pose(grain).position[up]) - height);
      };
      const auto rate = [&] { return double(world.spin(grain)[S::dim == 3 ? 1 : 0]); };
      CAPTURE(width);
      CAPTURE(step);
      const double left = std::pow(1 - 1.5 * std::pow(std::sin(alpha), 2), 2);
      double before = energy(), side = 0;
      int unsolved = 0;
      for (int impacts = 0; impacts < 2;) {
        unsolved += !world.step(T(step)).solve.converged;
        if (side == 0 && std::abs(rate()) > 1e-4) side = rate();
        if (!(rate() * side < 0)) continue;
        // The block turns back: all of its energy is potential.
        ++impacts;
        side = rate();
        const double v = 2 * width * std::sqrt(2 * before / (inertia + radius * radius));
        CHECK(std::abs(energy() / before - left) < weight * step / v);
        before = energy();
      }
      CHECK(unsolved == 0);
    }
}

// Two lines of contact, each at the angle beta from the radius through the centre, a from the axis. The block has the
// normal forces N1, N2 and slides: with S = N1 + N2, D = N1 - N2 and the angle q from the lowest place, over the mass,
//
//   S cos beta + mu D sin beta = g cos q + a q'^2        along the radius
//   mu S cos beta - D sin beta = g sin q + a q''         across it
//   (a^2 + i) q'' = mu R S - a g sin q                   about the axis
//
// In equilibrium q is about atan mu. Friction does not damp the swing about it.
TEST_CASE_TEMPLATE("a block slides on the inside of a turning drum like a pendulum with friction",
                   ShapeT, Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double half = 0.1, height = 0.05, step = 1e-3;
  for (const double friction : {0.3, 0.6})
    for (const double radius : {0.5, 1.0})
      for (const double aside : {0.0, 0.05}) {
        const double s = half / radius, c = std::sqrt(1 - s * s), a = radius * c - height;
        const double inertia = a * a + (half * half + height * height) / 3;
        // S from the first two equations, with q'' from the third.
        const auto acceleration = [&](double q, double rate) {
          const double along = weight * std::cos(q) + a * rate * rate,
                       across = weight * std::sin(q);
          // S (c + mu^2 c) = along + mu (across + a q''), q'' = (mu R S - a across) / inertia
          const double own =
              c * (1 + friction * friction) - friction * a * friction * radius / inertia;
          const double sum = (along + friction * across * (1 - a * a / inertia)) / own;
          return (friction * radius * sum - a * across) / inertia;
        };
        double low = 0, high = 1.5;
        for (int k = 0; k < 60; ++k) {
          const double middle = (low + high) / 2;
          (acceleration(middle, 0) > 0 ? low : high) = middle;
        }
        const double start = low + aside;
        World<ShapeT> world = world_of<ShapeT>(0.2, friction, Vector::Unit(up));
        typename S::Angular axis = S::Angular::Zero();
        axis[S::dim == 3 ? 1 : 0] = 1;
        const auto drum = world.add_cylinder(Vector::Zero(), axis, T(radius));
        world.set_spin(drum, typename S::Angular(T(2) * axis));
        // The drum moves the lowest point along -x in space and along x in the plane.
        const double way = S::dim == 3 ? -1 : 1;
        Vector x = Vector::Zero();
        x[0] = T(way * a * std::sin(start));
        x[up] = T(-a * std::cos(start));
        const auto grain = world.add_grain(world.add_shape(block<ShapeT>(half, height)),
                                           {x, S::exp(turn<S>(-way * start))}, T(1000));
        CAPTURE(friction);
        CAPTURE(radius);
        CAPTURE(aside);
        double q = start, rate = 0, largest = 0;
        int unsolved = 0;
        const int steps = rounds(2000);
        for (int k = 0; k < steps; ++k) {
          unsolved += !world.step(T(step)).solve.converged;
          constexpr int fine = 4;
          for (int i = 0; i < fine; ++i) {  // the midpoint rule
            const double h = step / fine, half_rate = rate + h / 2 * acceleration(q, rate);
            const double middle = q + h / 2 * rate;
            rate += h * acceleration(middle, half_rate);
            q += h * half_rate;
          }
          const auto& at = world.pose(grain).position;
          largest =
              std::max(largest, std::abs(std::atan2(way * double(at[0]), -double(at[up])) - q));
        }
        CHECK(unsolved == 0);
        CHECK(largest < 1e-3);
      }
}
