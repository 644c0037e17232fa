// SPDX-License-Identifier: MIT
// A grain slides without friction over a floor of flush tiles, in any direction. It moves straight on, at its
// speed, and does not turn.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace tiles {

using namespace moreau;

/// A polytope as a shape of a simulation.
template <class ShapeT, class P>
ShapeT as(const P& part) {
  using S = SpaceOf<P>;
  if constexpr (CompoundShape<ShapeT>)
    return ShapeT({{part, {S::Vector::Zero(), S::identity()}}});
  else
    return ShapeT(part);
}
/// A box of these edge lengths [m].
template <class P>
P box(double x, double y, [[maybe_unused]] double z = 0) {
  using T = typename P::Scalar;
  if constexpr (SpaceOf<P>::dim == 2)
    return cuboid<P>({T(x / 2), T(y / 2)});
  else
    return cuboid<P>({T(x / 2), T(y / 2), T(z / 2)});
}
/// A prism with n sides about the vertical, of radius r and height 2 half [m].
template <class P>
P prism(int n, double r, double half) {
  using T = typename P::Scalar;
  std::vector<typename P::Vector> points;
  for (int k = 0; k < n; ++k)
    for (const double z : {-half, half}) {
      const double angle = 2 * std::numbers::pi * k / n;
      points.push_back({T(r * std::cos(angle)), T(r * std::sin(angle)), T(z)});
    }
  return P(points);
}
/// A hull of random points on a flat base, at -half in the last axis [m].
template <class P>
P random_hull(double half, unsigned seed) {
  using T = typename P::Scalar;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<typename P::Vector> points;
  const auto add = [&](double x, double y, double z) {
    if constexpr (SpaceOf<P>::dim == 2)
      points.push_back({T(x), T(z)});
    else
      points.push_back({T(x), T(y), T(z)});
  };
  for (int k = 0; k < 6; ++k) {
    const double angle = k + 0.3 * number(random);
    add(1.5 * half * std::cos(angle), 1.5 * half * std::sin(angle), -half);
  }
  for (int k = 0; k < 7; ++k)
    add(half * number(random), half * number(random), half * number(random));
  return P(points);
}

template <class P>
struct Tile {
  P shape;
  typename P::Vector center;
};
struct Size {
  double x, y, depth;  ///< [m]
};
/// A floor of tiles with their tops in the plane 0 of the last axis.
/// @param kind 0: squares, 1: bricks in running bond, 2: hexagons, 3: rows of rectangles of different sizes
///             and depths; in the plane 3, or blocks of one size
/// @param s    size of a tile [m]
template <class P>
std::vector<Tile<P>> floor_of(int kind, double s) {
  using T = typename P::Scalar;
  std::vector<Tile<P>> floor;
  const auto add = [&](const P& shape, double x, double y, double depth) {
    if constexpr (SpaceOf<P>::dim == 2)
      floor.push_back({shape, {T(x), T(-depth / 2)}});
    else
      floor.push_back({shape, {T(x), T(y), T(-depth / 2)}});
  };
  const auto box_of = [](const Size& size) {
    return SpaceOf<P>::dim == 2 ? box<P>(size.x, size.depth) : box<P>(size.x, size.y, size.depth);
  };
  const int n = 13, rows = SpaceOf<P>::dim == 2 ? 0 : n;
  const double d = 0.03;
  if constexpr (SpaceOf<P>::dim == 3)
    if (kind == 2) {
      const double r = s / 2;
      const P tile = prism<P>(6, r, d / 2);
      for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
          add(tile, 1.5 * r * i, std::sqrt(3.0) * r * (j + (i % 2 != 0 ? 0.5 : 0)), d);
      return floor;
    }
  if (kind < 3) {
    const Size size{s, kind == 1 ? s / 2 : s, d};
    const P tile = box_of(size);
    for (int i = -n; i <= n; ++i)
      for (int j = -2 * rows; j <= 2 * rows; ++j)
        add(tile, s * (i + (kind == 1 && j % 2 != 0 ? 0.5 : 0)), size.y * j, d);
    return floor;
  }
  const std::array<double, 3> sizes{s, s / 2, 1.5 * s};
  double y = -(rows + 0.2) * s;
  for (int j = 0; y <= rows * s; ++j) {
    double x = -(n + 0.3 * (j % 4)) * s;
    for (int i = j; x < n * s; ++i) {
      const Size size{sizes[std::size_t(7 * i % 3)], sizes[std::size_t(j % 3)],
                      0.02 + 0.01 * (i % 3)};
      add(box_of(size), x + size.x / 2, y + size.y / 2, size.depth);
      x += size.x;
    }
    y += sizes[std::size_t(j % 3)];
  }
  return floor;
}

template <class ShapeT>
struct Slider {
  std::string name;
  ShapeT shape;
  double height;  ///< of its centre above the floor [m]
};
/// How a grain moves, and everything is tilted.
struct Slide {
  double direction = 0;  ///< of the motion, about the vertical; in the plane 0 or pi [rad]
  double turn = 0;       ///< of the grain about the vertical [rad]
  double tilt = 0;       ///< of floor and gravity [rad]
  double v = 1, h = 1e-3, time = 0.3;
  double jitter = 0;  ///< of the heights of the tiles [m]
};
/// The same over tiles of which some are mesh walls in place of obstacles.
struct SlideOnMeshes : Slide {
  int meshes = 7;       ///< of every three tiles those with 1, 2, 4 of this number
  bool sheets = false;  ///< whether these are the tops of tiles only
};

/// The surface of a tile as a mesh, or its top, with the outside upwards.
template <class P>
moreau::FacetMesh<SpaceOf<P>> mesh_of(const P& tile, bool top) {
  using S = SpaceOf<P>;
  moreau::FacetMesh<S> mesh;
  const auto& vertices = tile.vertices();
  const auto n = std::size_t(vertices.rows());
  const auto vertex = [&](std::size_t v) ->
      typename S::Vector { return vertices.row(Eigen::Index(v)).transpose(); };
  for (std::size_t v = 0; v < n; ++v) mesh.vertices.push_back(vertex(v));
  const auto is_top = [&](auto... corners) {
    const double highest = double(vertices.col(S::dim - 1).maxCoeff());
    return ((double(vertex(corners)[S::dim - 1]) > highest - 1e-6) && ...);
  };
  const auto add = [&](auto... corners) {
    if (!top || is_top(corners...)) mesh.facets.push_back({std::uint32_t(corners)...});
  };
  if constexpr (S::dim == 2)
    for (std::size_t v = 0; v < n; ++v) add(v, (v + 1) % n);
  else
    for (std::size_t f = 0; f < tile.face_count(); ++f)
      for (std::size_t k = 2; k < tile.face(f).size(); ++k)
        add(tile.face(f)[0], tile.face(f)[k - 1], tile.face(f)[k]);
  return mesh;
}

template <class WorldT, class P, class ShapeT, class SlideT>
void check(const std::vector<Tile<P>>& floor, const Slider<ShapeT>& slider, const SlideT& slide,
           double tolerance) {
  using S = SpaceOf<P>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  typename S::Angular tilt = S::Angular::Zero(), turn = S::Angular::Zero();
  tilt[0] = T(slide.tilt);
  if constexpr (S::dim == 3) tilt[1] = T(0.7 * slide.tilt), turn[2] = T(slide.turn);
  const typename S::Rotation q = S::exp(tilt);
  Vector along = Vector::Zero();
  along[0] = T(std::cos(slide.direction));
  if constexpr (S::dim == 3) along[1] = T(std::sin(slide.direction));

  using Law = SignoriniCoulomb<T>;
  WorldT world(T(0.02), Materials<Law>(1, Law(T(0))));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-slide.jitter, slide.jitter);
  [[maybe_unused]] int number = 0;  // of a tile
  for (const Tile<P>& tile : floor) {
    const T way = tile.center.dot(along);
    Vector aside = tile.center - way * along;
    aside[S::dim - 1] = 0;
    if (way < T(-0.06) || way > T(slide.v * slide.time + 0.06) || aside.norm() > T(0.06)) continue;
    const Vector at = tile.center + T(off(random)) * up;
    if constexpr (requires { slide.meshes; })
      if ((slide.meshes >> (number++ % 3)) % 2 == 1) {
        world.add_mesh_wall(mesh_of(tile.shape, slide.sheets), {Vector(q * at), q});
        continue;
      }
    world.prescribe_motion(
        world.add_grain(world.add_shape(as<ShapeT>(tile.shape)), {Vector(q * at), q}, T(1000)));
  }
  Vector start = T(slider.height) * up;
  start[0] = T(0.0013);
  if constexpr (S::dim == 3) start[1] = T(0.0007);
  const BodyId grain = world.add_grain(
      world.add_shape(slider.shape), {Vector(q * start), S::normalized(q * S::exp(turn))}, T(1000));
  world.set_gravity(Vector(T(-9.81) * (q * up)));
  world.set_velocity(grain, Vector(T(slide.v) * (q * along)));
  for (int k = 0; k < int(slide.time / slide.h + 0.5); ++k) world.step(T(slide.h));

  const Vector moved = q.inverse() * world.pose(grain).position - start;
  const Vector velocity = q.inverse() * world.velocity(grain);
  CAPTURE(S::dim);
  CAPTURE(slider.name);
  CAPTURE(slide.direction);
  CAPTURE(slide.turn);
  CAPTURE(slide.tilt);
  CAPTURE(slide.v);
  CAPTURE(slide.h);
  if constexpr (requires { slide.meshes; }) {
    CAPTURE(slide.meshes);
    CAPTURE(slide.sheets);
  }
  // Places are rounded to eps times 0.3 m. A gap that is wrong by that opens or closes within a step.
  const double hop = 4 * double(std::numeric_limits<T>::epsilon()) * 0.3 / slide.h;
  CHECK((moved - T(slide.v * slide.time) * along).norm() < tolerance + hop * slide.time);
  CHECK((velocity - T(slide.v) * along).norm() < 100 * tolerance + hop);
  CHECK(world.spin(grain).norm() < 1000 * tolerance + 100 * hop);  // hop over a lever of 1 cm
}

/// Slides in as many directions as given; floor, grain, tilt, speed and step change with the direction.
/// @param tolerance of the place at the end, without rounding [m]
template <class WorldT, class P, class SlideT = Slide, class ShapeT>
void check_directions(const std::vector<Slider<ShapeT>>& sliders, int directions,
                      double tolerance) {
  constexpr bool plane = SpaceOf<P>::dim == 2;
  std::vector<std::vector<Tile<P>>> floors;
  for (const int kind : {0, 1, 2, 3}) floors.push_back(floor_of<P>(kind, kind == 0 ? 0.03 : 0.025));
  for (int k = 0; k < directions; ++k) {
    SlideT slide;
    slide.direction = plane ? k % 2 * std::numbers::pi : 2 * std::numbers::pi * k / directions;
    slide.turn = k % 3 == 2 ? 0.3 : 0;
    slide.tilt = k % 7 == 3 ? 0.3 : k % 7 == 5 ? -0.8 : 0;
    slide.v = k % 5 == 1 ? 0.4 : 1;
    slide.h = k % 11 == 4 ? 2e-4 : 1e-3;
    slide.time = k % 11 == 4 ? 0.06 : 0.25;
    slide.jitter = sizeof(typename P::Scalar) == 4 ? 0 : k % 4 == 2 ? 1e-9 : 0;
    if constexpr (requires { slide.meshes; }) {
      slide.meshes = 1 + k % 7;
      slide.sheets = k % 2 == 1;
    }
    const auto& slider = sliders[std::size_t(k / 4) % sliders.size()];
    check<WorldT>(floors[std::size_t(k % 4)], slider, slide, tolerance);
  }
}

/// Polytopes that slide on a face.
template <class ShapeT, class P>
std::vector<Slider<ShapeT>> polytopes() {
  std::vector<Slider<ShapeT>> sliders;
  const auto add = [&](const char* name, const P& shape, double height) {
    sliders.push_back({name, as<ShapeT>(shape), height});
  };
  if constexpr (SpaceOf<P>::dim == 2) {
    add("square", box<P>(0.02, 0.02), 0.01);
    add("plate", box<P>(0.04, 0.008), 0.004);
  } else {
    add("cube", box<P>(0.02, 0.02, 0.02), 0.01);
    add("brick", box<P>(0.03, 0.012, 0.01), 0.005);
    add("plate", box<P>(0.045, 0.035, 0.006), 0.003);
    for (const int n : {3, 6}) add("prism", prism<P>(n, 0.012, 0.006), 0.006);
  }
  for (const unsigned seed : {1u, 2u, 3u}) {
    const P hull = random_hull<P>(0.007, seed);
    add("hull", hull, -double(hull.vertices().col(SpaceOf<P>::dim - 1).minCoeff()));
  }
  return sliders;
}

}  // namespace tiles
