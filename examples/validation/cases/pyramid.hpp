// SPDX-License-Identifier: MIT
// One ball on three, one disk on two.
#pragma once

#include <array>
#include <numbers>

#include "scene.hpp"

namespace validation {

namespace detail {

/// Whether a ball on three (a disk on two) that touch each other stays up, from rest, for a third
/// of a second.
/// @param between friction of balls on each other
/// @param floor   friction of balls on the floor
template <class ShapeT>
bool pyramid_stands(double between, double floor) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const double radius = 0.05;
  using Law = Coulomb<ShapeT>;
  Materials<Law> materials(2, Law(between));
  materials.set(moreau::MaterialId(0), moreau::MaterialId(1), Law(floor));
  World<ShapeT> world(2 * radius, materials, solver_of<ShapeT, Law>(tight(1e-9)));
  const auto ball = world.add_shape(ShapeT(radius));
  // Feet at the corners of a simplex of side 2 R; the height of the next corner over their plane.
  const double side = 2 * radius, spread = side * std::sqrt((S::dim - 1.0) / (2.0 * S::dim));
  const double rise = side * std::sqrt((S::dim + 1.0) / (2.0 * S::dim));
  for (int k = 0; k < S::dim; ++k) {
    Vector x = Vector::Constant(radius);
    const double angle = 2 * std::numbers::pi * k / S::dim;
    x[1] = spread * std::sin(angle);
    x[0] = spread * std::cos(angle);
    x[up] = radius;
    world.add_grain(ball, {x}, 1000);
  }
  const BodyId top = world.add_grain(ball, {in_plane<S>(0, radius + rise)}, 1000);
  world.add_wall(Vector::Unit(up), Vector::Zero(), moreau::MaterialId(1));
  world.set_gravity(tilted_gravity<S>(0));
  for (int k = 0; k < 300; ++k) world.step(1e-3);
  return radius + rise - world.bodies().pose[top.index()].position[up] < 1e-4 * radius;
}

}  // namespace detail

/// A ball of weight W is pushed by N and T at the top, at beta to the vertical, and at the floor.
/// Its moments ask for the same T at both; the top's weight for N (cos + tan(beta/2) sin) = N = W/D
/// with T = tan(beta/2) N; the floor carries W + W/D. So, the other friction being ample, the
/// pyramid stands iff mu between balls >= tan(beta/2) and mu of the floor >= tan(beta/2)/(D + 1).
/// beta is asin(1/sqrt 3) in space, 30 degrees in the plane.
template <class ShapeT>
void pyramid(Record& record) {
  using S = SpaceOf<ShapeT>;
  const double beta = std::asin(S::dim == 3 ? 1 / std::sqrt(3.0) : 0.5),
               between = std::tan(beta / 2);
  const double floor = between / (S::dim + 1);
  const std::string name = with_shape<ShapeT>(S::dim == 3 ? "pyramid 3 + 1" : "pyramid 2 + 1");
  const double ample = 1;
  record.compare(name + ": least friction between balls", S{}, between,
                 threshold(between - 0.01, between + 0.01, 7,
                           [&](double mu) { return detail::pyramid_stands<ShapeT>(mu, ample); }),
                 1e-3);
  record.compare(name + ": least friction on the floor", S{}, floor,
                 threshold(floor - 0.01, floor + 0.01, 7,
                           [&](double mu) { return detail::pyramid_stands<ShapeT>(ample, mu); }),
                 1e-3);
}

template <class T>
void pyramid_of_balls(Record& record, Effort) {
  pyramid<Ball<T>>(record);
  pyramid<Disk<T>>(record);
}

}  // namespace validation
