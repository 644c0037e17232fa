// SPDX-License-Identifier: MIT
// One sphere on three, one disk on two.
#pragma once

#include <array>
#include <numbers>

#include "scene.hpp"

namespace validation {

namespace detail {

/// Whether a sphere on three spheres (a disk on two disks) that touch each other stays up for a
/// third of a second, from rest.
/// @param between friction between the balls
/// @param floor   friction between balls and floor
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
  // The lower centres form a simplex of side 2 R; the height of the upper centre above their plane.
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
  return radius + rise - world.pose(top).position[up] < 1e-4 * radius;
}

}  // namespace detail

/// The forces N and T act on a lower ball of weight W at the contact with the top ball, at the
/// angle beta to the vertical, and at the floor. The balance of moments requires the same T at both
/// contacts. The weight of the top ball requires N (cos + tan(beta/2) sin) = N = W/D with T =
/// tan(beta/2) N. The floor carries W + W/D. If the other friction is large enough, the pyramid
/// therefore stands iff mu between balls >= tan(beta/2), and iff mu of the floor >= tan(beta/2)/(D
/// + 1). beta is asin(1/sqrt 3) in space and 30 degrees in the plane.
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
