// SPDX-License-Identifier: MIT
// Large packings at the price of a small one: a tile of grains, periodic along the horizontal axes,
// is compressed by a lid and repeated along every axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/spatial_order.hpp"
#include "moreau/world/simulation.hpp"

#include "ballast_grains.hpp"

namespace bench {

using namespace moreau;

/// The order in which the grains of a packing are numbered.
enum class Order { curve, random };

/// How a tile is repeated.
struct Repeat {
  Order order = Order::curve;
  /// Share of the grains that is left out, at random: the copies then rearrange in different ways.
  double left_out = 0;
};

/// @tparam Solver of the contact problem
template <class ShapeT, class Law, class Solver>
class Tiles {
 public:
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using World = Simulation<ShapeT, Law, MoreauJean, CellGrid<S>, Solver>;
  static constexpr int up = S::dim - 1;
  static constexpr double step = 2e-4;  // [s]

  /// One tile under its load, from a file, or prepared and stored in this file.
  Tiles(std::size_t count, const Law& law, const Solver& solver, const std::filesystem::path& file)
      : world(size, Materials<Law>(1, law), solver) {
    world.set_contact_points(contact_points<S, Law>);
    if (std::filesystem::exists(file)) {
      read_snapshot(file, world, length_, height_);
      lid_ = world.walls()[1];
      return;
    }
    deposit(count);
    compress();
    if (!file.empty()) write_snapshot(file, world, length_, height_);
  }
  /// A tile, repeated: `counts` copies along each axis, with a lid of the same pressure. Call settle()
  /// afterwards: there are no impulses yet.
  Tiles(const Tiles& tile, const std::array<int, std::size_t{S::dim}>& counts, const Repeat& repeat,
        const Law& law, const Solver& solver)
      : world(size, Materials<Law>(1, law), solver), length_(tile.length_) {
    world.set_contact_points(contact_points<S, Law>);
    std::vector<std::pair<std::size_t, Vector>> places;  // grain of the tile, position
    std::array<int, std::size_t{S::dim}> at{};
    std::mt19937_64 random(2);
    std::bernoulli_distribution leaves_out(repeat.left_out);
    for (bool more = true; more;) {
      for (std::size_t k = 0; k < tile.world.grain_count(); ++k) {
        if (repeat.left_out > 0 && leaves_out(random)) continue;
        Vector x = tile.world.cell().wrap(tile.world.pose(tile.world.grain(k)).position);
        for (int axis = 0; axis < S::dim; ++axis)
          x[axis] += at[std::size_t(axis)] * (axis == up ? tile.height_ : length_);
        places.emplace_back(k, x);
      }
      more = false;
      for (std::size_t axis = 0; axis < S::dim && !more; ++axis) {
        more = ++at[axis] < counts[axis];
        if (!more) at[axis] = 0;
      }
    }
    for (const std::size_t i : numbered(places, repeat.order)) {
      const BodyId grain = tile.world.grain(places[i].first);
      Pose<S> pose = tile.world.pose(grain);
      pose.position = places[i].second;
      world.add_grain(world.add_shape(tile.world.shape_of_grain(places[i].first)), pose,
                      density<S>);
    }
    height_ = tile.height_ * counts[std::size_t(up)];
    area_ = 1;
    for (int axis = 0; axis < up; ++axis) {
      const double length = length_ * counts[std::size_t(axis)];
      area_ *= length;
      world.set_periodic(axis, 0, length);
    }
    add_lid(height_);
    free_lid();
  }

  /// Lets the packing come to rest under the load.
  void settle(int steps, double h = step) {
    load(1);
    for (int k = 0; k < steps; ++k) world.step(h);
  }
  /// Sets the force on the lid, relative to that of the pressure.
  void load(double share) {
    world.set_force(lid_, -share * pressure * depth<S> * area_ * Vector::Unit(up));
  }

  World world;

 private:
  static constexpr double size = 0.025;

  static std::vector<std::size_t> numbered(
      const std::vector<std::pair<std::size_t, Vector>>& places, Order order) {
    std::vector<std::size_t> numbers(places.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    if (order == Order::random) {
      std::mt19937_64 random(1);
      std::shuffle(numbers.begin(), numbers.end(), random);
      return numbers;
    }
    std::vector<Vector> points;
    for (const auto& place : places) points.push_back(place.second);
    return spatial_order<S>(points);
  }

  void deposit(std::size_t count) {
    std::mt19937_64 random(1);
    const BallastGrains<ShapeT> grains(count, random);
    length_ = std::pow(grains.volume / (up == 1 ? 0.8 : 0.6), 1.0 / S::dim);
    const auto poses = random_deposition<S>(grains.radii, length_, random);
    for (std::size_t k = 0; k < count; ++k) {
      world.add_grain(world.add_shape(grains.shapes[k]), poses[k], density<S>);
      height_ = std::max(height_, poses[k].position[up] + grains.radii[k]);
    }
    area_ = std::pow(length_, up);
    for (int axis = 0; axis < up; ++axis) world.set_periodic(axis, 0, length_);
    add_lid(height_);
  }
  void add_lid(double height) {
    world.add_wall(Vector::Unit(up), Vector::Zero());
    lid_ = world.add_wall(-Vector::Unit(up), height * Vector::Unit(up));
    world.set_gravity(-9.81 * Vector::Unit(up));
  }
  /// The lid moves under its force; it weighs as much as the grains.
  void free_lid() {
    double mass = 0;
    for (const double weight : world.bodies().grain_mass) mass += weight;
    world.set_velocity(lid_, Vector::Zero());
    world.set_wall_mass(lid_, mass);
  }
  /// Lowers the lid until the grains carry its force, and lets them come to rest under it.
  void compress() {
    constexpr double coarse = 5e-4;  // [s]
    world.set_velocity(lid_, -1.0 * Vector::Unit(up));
    const double force = pressure * depth<S> * area_;
    for (double reaction = 0; reaction < force;) {
      world.step(coarse);
      reaction += 0.1 * (world.contact_impulse(lid_)[up] / coarse - reaction);
    }
    free_lid();
    settle(600, coarse);
    settle(300);
    height_ = world.pose(lid_).position[up];
  }

  double length_ = 0, height_ = 0, area_ = 0;  // of a tile; of the packing; of the lid
  BodyId lid_;
};

}  // namespace bench
