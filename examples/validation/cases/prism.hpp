// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "moreau/sample/ballast.hpp"

#include "scene.hpp"

namespace validation {

namespace detail {

/// A polygon, or its prism between two planes of constant y.
template <class ShapeT>
ShapeT extruded(const Polygon<ScalarOf<ShapeT>>& base, double depth) {
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

/// Polygons, or their prisms, that fall on a floor and on each other.
template <class ShapeT, class Law>
World<ShapeT, Law> fall_of_prisms(std::uint64_t seed, const Law& law) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double depth = 0.02, density = 2700;
  auto world = world_of<ShapeT>(0.02, law);
  world.set_contact_points(moreau::ContactPoints::all);
  // The ten sweeps of the overlap correction do not converge and would break the symmetry.
  without_correction(world);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 6; ++k) {
    const auto base = moreau::Ballast<Polygon<ScalarOf<ShapeT>>>::draw(random).scaled(0.01);
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

/// Prisms move like their polygons until rounding has grown: for 0.1 s. A contact of two edges with
/// two points becomes a contact of two faces with four points, so the springs of prisms are half as
/// stiff. Symmetry keeps the prisms in their plane as long as the solution is unique, so friction
/// is small. (Between two smooth walls at the ends of the prisms every solution has a self-stress,
/// and the sweeps stall at a residual of 1e-7.)
template <class T, class Law2, class Law3>
void prisms_against_polygons(Record& record, const Law2& flat_law, const Law3& deep_law) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  constexpr bool rigid = is_rigid<Polygon<T>, Law2>;
  double apart = 0, turned = 0, tilted = 0;
  int unsolved = 0;
  const double h = rigid ? 1e-3 : 5e-5;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    auto polygons = detail::fall_of_prisms<Polygon<T>>(seed, flat_law);
    auto prisms = detail::fall_of_prisms<Polyhedron<T>>(seed, deep_law);
    for (int k = 0; k < int(std::lround(0.1 / h)); ++k) {
      const bool flat_solved = polygons.step(h).solve.converged;
      const bool deep_solved = prisms.step(h).solve.converged;
      unsolved += rigid && !(flat_solved && deep_solved);
      for (std::size_t i = 0; i < polygons.grain_count(); ++i) {
        const auto& flat = polygons.bodies().pose[i].position;
        const auto& deep = prisms.bodies().pose[i];
        const Vector y = Vector::UnitY();
        // The first axis of the body, in the plane.
        const Vector across = deep.rotation * Vector::UnitX();
        const auto flat_across =
            (polygons.bodies().pose[i].rotation * Eigen::Matrix<T, 2, 1>::UnitX()).eval();
        turned =
            std::max(turned, double((across - Vector(flat_across.x(), 0, flat_across.y())).norm()));
        apart = std::max(apart, double((deep.position - Vector(flat.x(), 0, flat.y())).norm()));
        tilted = std::max(tilted, double((deep.rotation * y - y).norm()));
      }
    }
  }
  const std::string name = with_law<Law2>("prisms against polygons, 0.1 s") + ": ";
  const moreau::Space<3, T> space;
  record.vanishes(name + "distance over size", space, apart / 0.02, 1e-9);
  record.vanishes(name + "difference of the angles", space, turned, 1e-9);
  record.vanishes(name + "tilt out of the plane", space, tilted, 1e-9);
  if (rigid) record.vanishes(name + "steps not solved", space, unsolved, 0);
}

template <class T>
void prisms_and_polygons(Record& record, Effort) {
  const Coulomb<Polygon<T>> dry(0.1);
  prisms_against_polygons<T>(record, dry, dry);
  const auto springs = [](double stiffness) {
    return Springs<Polygon<T>>(stiffness, 2 * stiffness / 7, 0.1);
  };
  prisms_against_polygons<T>(record, springs(1e4), springs(5e3));
}

}  // namespace validation
