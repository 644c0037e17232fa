// SPDX-License-Identifier: MIT
// Random rows of blocks that slide down between two walls: sizes, widths, masses, directions, steps and orders of the bodies are
// drawn. A force on one wall holds less than the weight. The faces carry the moments of the friction at the walls as long as
// friction * length <= 4 * height.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "physics/kinds.hpp"
#include "sanitized.hpp"

namespace rows {

/// What a row does in 0.3 s, or in 1,500 steps.
struct Result {
  int unsolved = 0;  ///< steps that are not converged
  double turn = 0;   ///< largest change of the rotation matrix of a block, Frobenius norm [-]
  double speed = 0;  ///< largest relative error of the speed of a block [-]
};

/// @param seed     of the row
/// @param world_of function: size [m], friction, up -> a simulation with gravity and one material
/// @param scale    of the sizes, which are drawn from 0.003 to 3 m times this, and the square of that of all times [-]
template <class ShapeT>
Result slide(unsigned seed, const auto& world_of, double scale = 1) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using kinds::weight;
  std::mt19937 random(seed * 7919);
  const auto number = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const auto factor = [&](double from, double to) { return from * std::pow(to / from, number()); };
  const int count = 1 + int(number() * 6);
  const double size = scale * factor(0.003, 3), mass = factor(1e-3, 1e3);
  const double slower = std::sqrt(scale);
  const double h = std::min(slower * factor(1e-4, 1.0 / 60), std::sqrt(0.3 * size / weight));
  const double share = number() < 0.3 ? 0.99 : 0.3 + 0.68 * number();
  const typename S::Rotation tilt = kinds::tilt_to<S>(random, seed % 2 == 0);
  const Vector up = tilt * Vector::Unit(S::dim - 1), across = tilt * Vector::UnitX();
  std::vector<double> widths;
  double length = 0;
  for (int k = 0; k < count; ++k)
    length += widths.emplace_back(size * (seed % 3 == 0 ? 1 : 0.4 + 0.6 * number()));
  const double friction = std::min(0.2 + 0.6 * number(), 3.6 * size / length);
  auto world = world_of(size, friction, up);
  std::vector<Vector> at;
  std::vector<std::size_t> order;
  double end = 0;
  for (const double width : widths) {
    order.push_back(at.size());
    at.push_back(T(end + width / 2) * across);
    end += width;
  }
  std::shuffle(order.begin(), order.end(), random);
  const auto put_walls = [&] {
    return std::pair{world.add_wall(across, Vector::Zero()),
                     world.add_wall(-across, Vector(T(length) * across))};
  };
  std::pair<moreau::BodyId, moreau::BodyId> walls;
  const bool walls_first = seed % 5 < 2, is_left = seed % 4 < 2;
  if (walls_first) walls = put_walls();
  double load = 0;
  for (const std::size_t k : order) {
    Vector half = Vector::Constant(T(size / 2));
    half[0] = T(widths[k] / 2);
    const auto grain =
        world.add_grain(world.add_shape(moreau::cuboid<ShapeT>(half)), {at[k], tilt}, T(1000));
    load += double(world.bodies().grain_mass[grain.index()]) * weight;
  }
  if (!walls_first) walls = put_walls();
  const auto wall = is_left ? walls.first : walls.second;
  world.set_wall_mass(wall, T(mass * load / (weight * count)));
  world.set_force(wall, T((is_left ? 1 : -1) * share * load / (2 * friction)) * across);
  const int steps = rounds(std::min(1500, int(0.3 * slower / h)));
  Result result;
  for (int k = 0; k < steps; ++k) result.unsolved += !world.step(T(h)).solve.converged;
  const double expected = weight * (1 - share) * steps * h;
  for (const auto grain : world.grains()) {
    result.turn = std::max(
        result.turn,
        double((world.pose(grain).rotation.toRotationMatrix() - tilt.toRotationMatrix()).norm()));
    result.speed =
        std::max(result.speed, std::abs(-double(world.velocity(grain).dot(up)) / expected - 1));
  }
  return result;
}

}  // namespace rows
