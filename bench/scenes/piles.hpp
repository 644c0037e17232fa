// SPDX-License-Identifier: MIT
// Piles and pyramids at h = 1/60 s, as users of game engines run them. Lengths are in grain sizes of 1 m.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "moreau/sample/random_rotation.hpp"

#include "measure.hpp"
#include "pairs.hpp"

namespace scenes {

inline constexpr double frame = 1.0 / 60;  // [s]
/// Bodies that fall at up to 10 m/s come nearer by 0.17 m in a step.
inline constexpr double margin_of_falling = 0.2;

/// A box or, in the plane, a square with edges of 1.
template <class ShapeT>
ShapeT cube() {
  using S = SpaceOf<ShapeT>;
  std::vector<typename S::Vector> corners;
  for (unsigned k = 0; k < 1U << S::dim; ++k) {
    typename S::Vector x;
    for (int axis = 0; axis < S::dim; ++axis)
      x[axis] = k >> axis & 1 ? typename S::Scalar(0.5) : typename S::Scalar(-0.5);
    corners.push_back(x);
  }
  return ShapeT(std::span<const typename S::Vector>(corners));
}

/// An empty world with a floor at height 0, under gravity.
template <class ShapeT>
std::unique_ptr<typename Scene<ShapeT>::World> world_with_floor(double friction, double margin,
                                                                const Options& options,
                                                                double grain_size = 1) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  const Materials<typename Made::Law> materials(1, typename Made::Law(Scalar(friction)));
  auto world =
      std::make_unique<typename Made::World>(Scalar(grain_size), materials, solver(options),
                                             tolerances(margin, options), options.correction);
  world->add_wall(S::Vector::Unit(S::dim - 1), S::Vector::Zero());
  world->set_gravity(Scalar(-9.81) * S::Vector::Unit(S::dim - 1));
  return world;
}

/// Rows of boxes, each with one box less than the row below: 40 rows, 820 boxes. At rest.
template <class ShapeT>
Scene<ShapeT> pyramid(const Options& options) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  const int rows = options.size > 0 ? options.size : 40;
  auto world = world_with_floor<ShapeT>(0.6, 0.02, options);
  Grains<ShapeT> boxes;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < rows - row; ++k) {
      Pose<S> pose;
      pose.position[0] = Scalar(1.1 * (k - 0.5 * (rows - row)));
      pose.position[S::dim - 1] = Scalar(0.5 + row);
      boxes.poses.push_back(pose);
    }
  boxes.shapes.push_back(cube<ShapeT>());
  boxes.shape_of.assign(boxes.poses.size(), 0);
  boxes.add_to(*world, 1000, options);
  return {std::move(world), Scalar(frame), 120, 300};
}

/// Grains on a grid, which fall. 1,000 hulls of 32 vertices, in the plane 2,000 polygons of 5 to 7.
/// @param settle steps before the measurement; 0: the fall is measured
template <class ShapeT>
Scene<ShapeT> pile(int settle, int steps, const Options& options) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  constexpr int up = S::dim - 1, across = S::dim == 3 ? 10 : 40;
  const int count = options.size > 0 ? options.size : (S::dim == 3 ? 1000 : 2000);
  auto world = world_with_floor<ShapeT>(0.5, margin_of_falling, options);
  std::mt19937_64 random(1);
  Grains<ShapeT> grains;
  for (int k = 0; k < 8; ++k)
    grains.shapes.push_back(S::dim == 3 ? pairs::with_vertices(S{}, 32, random).scaled(Scalar(0.5))
                                        : Ballast<ShapeT>::draw(random).scaled(Scalar(0.5)));
  for (int k = 0; k < count; ++k) {
    Pose<S> pose;
    int left = k;
    for (int axis = 0; axis < up; ++axis, left /= across)
      pose.position[axis] = Scalar(1.1 * (left % across));
    pose.position[up] = Scalar(0.6 + 1.1 * left);
    pose.rotation = random_rotation<S>(random);
    grains.poses.push_back(pose);
    grains.shape_of.push_back(std::size_t(k) % grains.shapes.size());
  }
  grains.add_to(*world, 1000, options);
  // In the plane the pile stands between two walls, in space it is free.
  if (S::dim == 2) {
    world->add_wall(S::Vector::UnitX(), -S::Vector::UnitX());
    world->add_wall(-S::Vector::UnitX(), Scalar(1.1 * across) * S::Vector::UnitX());
  }
  return {std::move(world), Scalar(frame), settle, steps};
}

/// Equal hulls of 32 random points on a sphere with a radius of 2 m fall, from a grid with as much space between centres
/// as a diameter. `size` is the number of layers of 8 x 8 hulls.
template <class ShapeT>
Scene<ShapeT> convex_pile(const Options& options) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  constexpr double radius = 2;
  const int layers = options.size > 0 ? options.size : 20;
  auto world = world_with_floor<ShapeT>(0.6, margin_of_falling, options, 2 * radius);
  std::mt19937_64 random(42);
  std::vector<typename S::Vector> corners;
  for (int k = 0; k < 32; ++k)
    corners.push_back(Scalar(radius) * pairs::random_direction<S>(random));
  Grains<ShapeT> grains;
  grains.shapes.emplace_back(std::span<const typename S::Vector>(corners));
  for (int k = 0; k < 64 * layers; ++k)
    grains.poses.push_back(
        Pose<S>({Scalar(2 * radius * (k % 8 - 4)), Scalar(2 * radius * (k / 8 % 8 - 4)),
                 Scalar(radius * (1 + 2 * (k / 64)))}));
  grains.shape_of.assign(grains.poses.size(), 0);
  grains.add_to(*world, 1000, options);
  return {std::move(world), Scalar(frame), 0, 500};
}

/// 1,000 hulls at rest on a wavy floor of 20,000 triangles with edges of 0.4 grain sizes, in layers.
template <class ShapeT>
Scene<ShapeT> on_mesh(const Options& options) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  constexpr int n = 100;
  constexpr auto edge = static_cast<Scalar>(0.4);
  FacetMesh<S> mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.push_back({edge * Scalar(i), edge * Scalar(j),
                               Scalar(0.3 * std::sin(0.8 * i) * std::cos(0.8 * j))});
  const auto at = [](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const Materials<typename Made::Law> materials(1, typename Made::Law(Scalar(0.5)));
  auto world = std::make_unique<typename Made::World>(Scalar(1), materials, solver(options),
                                                      tolerances(margin_of_falling, options),
                                                      options.correction);
  world->set_gravity(Scalar(-9.81) * S::Vector::Unit(2));
  std::mt19937_64 random(1);
  Grains<ShapeT> grains;
  const int count = options.size > 0 ? options.size : 1000;
  for (int k = 0; k < count; ++k) {
    Pose<S> pose(
        {Scalar(2 + 1.2 * (k % 30)), Scalar(2 + 1.2 * (k / 30 % 30)), Scalar(1 + 1.2 * (k / 900))});
    pose.rotation = random_rotation<S>(random);
    grains.poses.push_back(pose);
    grains.shapes.push_back(Ballast<ShapeT>::draw(random).scaled(Scalar(0.5)));
  }
  grains.add_to(*world, 1000, options);
  world->add_mesh_wall(mesh);
  return {std::move(world), Scalar(frame), 240, 300};
}

}  // namespace scenes
