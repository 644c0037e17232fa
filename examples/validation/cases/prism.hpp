// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "moreau/sample/ballast.hpp"

#include "scene.hpp"

namespace validation {

namespace detail {

/// A polygon, or the prism of it between two planes of constant y.
template <class ShapeT>
ShapeT extruded(const Polygon& base, double depth) {
  using S = SpaceOf<ShapeT>;
  std::vector<typename S::Vector> corners;
  for (const auto& row : base.vertices().rowwise())
    for (const double side : {-depth / 2, depth / 2}) {
      typename S::Vector x = S::Vector::Constant(side);
      x[0] = row[0];
      x[S::dim - 1] = row[1];
      if (S::dim == 3 || side > 0) corners.push_back(x);
    }
  return ShapeT(corners);
}

/// Polygons that fall on a floor and on each other, or prisms that do.
template <class ShapeT>
World<ShapeT> fall_of_prisms(std::uint64_t seed) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double depth = 0.02, density = 2700;
  auto world = world_of<ShapeT, Coulomb>(0.02, Coulomb(0.1));
  world.set_contact_points(moreau::ContactPoints::all);
  // Ten sweeps of the correction of overlaps do not converge: it would break the symmetry.
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  world.set_correction(off);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 6; ++k) {
    const Polygon base = moreau::Ballast<Polygon>::draw(random).scaled(0.01);
    const double across = 0.018 * (k % 3) + 0.002 * any(random), angle = 3 * any(random);
    const Pose<S> pose{in_plane<S>(across, 0.012 + 0.021 * (k / 3)), S::exp(turn<S>(angle))};
    world.add_grain(world.add_shape(extruded<ShapeT>(base, depth)), pose,
                    S::dim == 3 ? density : density * depth);
  }
  world.add_wall(Vector::Unit(S::dim - 1), Vector::Zero());
  world.set_gravity(tilted_gravity<S>(0));
  return world;
}

}  // namespace detail

/// Extruded polygons do what the polygons do, for as long as rounding has not grown: 100 steps. The
/// contact of two edges is one of two faces, its two points are four. Symmetry holds the prisms in
/// their plane as long as the solution is unique, so friction is small. (Between two smooth walls
/// at the prisms' ends every solution has a self-stress, and the sweeps stall at a residual of
/// 1e-7.)
inline void prisms_and_polygons(Record& record, Effort) {
  double apart = 0, tilted = 0;
  int unsolved = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    auto polygons = detail::fall_of_prisms<Polygon>(seed);
    auto prisms = detail::fall_of_prisms<Polyhedron>(seed);
    for (int k = 0; k < 100; ++k) {
      unsolved += !polygons.step(1e-3).solve.converged + !prisms.step(1e-3).solve.converged;
      for (std::size_t i = 0; i < polygons.grain_count(); ++i) {
        const auto& flat = polygons.bodies().pose[i].position;
        const auto& deep = prisms.bodies().pose[i];
        const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
        apart = std::max(apart, (deep.position - Eigen::Vector3d(flat.x(), 0, flat.y())).norm());
        tilted = std::max(tilted, (deep.rotation * y - y).norm());
      }
    }
  }
  const std::string name = "prisms against polygons, 100 steps: ";
  record.vanishes(name + "distance over size", 3, apart / 0.02, 1e-9);
  record.vanishes(name + "tilt out of the plane", 3, tilted, 1e-9);
  record.vanishes(name + "steps not solved", 3, unsolved, 0);
}

}  // namespace validation
