// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "moreau/solve/proximal_fallback.hpp"

#include "scene.hpp"

namespace validation {

namespace detail {

/// A block of an arch of mean radius 1 between two radial cuts.
/// @param thickness relative to the radius
template <class ShapeT>
ShapeT voussoir(double from, double to, double thickness, bool starts, bool ends) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  std::vector<Vector> corners;
  for (const double angle : {from, to})
    for (const double radius : {1 - thickness / 2, 1 + thickness / 2})
      for (const double side : {-0.15, 0.15}) {
        if (S::dim == 2 && side > 0) continue;
        Vector x = Vector::Constant(side);
        x[0] = -radius * std::cos(angle);
        // sin(pi) is not zero in floating point.
        const bool flat = (starts && angle == from) || (ends && angle == to);
        x[S::dim - 1] = flat ? 0 : radius * std::sin(angle);
        corners.push_back(x);
      }
  return ShapeT(corners);
}

/// Behaviour of an arch under its weight. Sweeps alone leave a step of some arches unsolved, with some
/// compilers: the proximal point method solves it.
struct ArchRun {
  double fall;   ///< displacement of the crown, downwards [m]
  int unsolved;  ///< steps that did not converge
};
template <class ShapeT>
ArchRun stand_arch(int blocks, double thickness, double time) {
  using S = SpaceOf<ShapeT>;
  constexpr int up = S::dim - 1;
  auto world = world_of<ShapeT, Coulomb<ShapeT>, moreau::ProximalFallback<>>(
      thickness, Coulomb<ShapeT>(0.7), tight(1e-6));
  world.set_contact_points(moreau::ContactPoints::all);
  world.add_wall(S::Vector::Unit(up), S::Vector::Zero());
  world.set_gravity(tilted_gravity<S>(0));
  for (int k = 0; k < blocks; ++k) {
    const double unit = std::numbers::pi / blocks;
    const ShapeT shape =
        voussoir<ShapeT>(unit * k, unit * (k + 1), thickness, k == 0, k + 1 == blocks);
    world.add_grain(world.add_shape(shape), {shape.centroid_of_input()}, 1000);
  }
  const auto crown = world.grain(std::size_t(blocks) / 2).index();
  const double start = world.bodies().pose[crown].position[up];
  ArchRun run{0, 0};
  while (world.time() < time && run.fall < 0.01) {
    run.unsolved += !world.step(2e-3).solve.converged;
    run.fall = start - world.bodies().pose[crown].position[up];
  }
  return run;
}

}  // namespace detail

/// A semicircular arch with radial joints stands iff its thickness is at least 0.1075 of its mean
/// radius and friction prevents sliding (M. Milankovitch, Z. Math. Phys. 55 (1907) 1; H. Alexakis
/// and N. Makris, Arch. Appl. Mech. 85 (2015) 1363).
template <class ShapeT>
void arch(Record& record, int blocks, int bisections) {
  using S = SpaceOf<ShapeT>;
  const double exact = 0.1075;
  Curve& curve = record.curve("arch", S{}, {"thickness", "fall"});
  int unsolved = 0;
  const auto stands = [&](double thickness) {
    const auto run = detail::stand_arch<ShapeT>(blocks, thickness, 0.5);
    curve.rows.push_back({thickness, run.fall});
    unsolved += run.unsolved;
    return run.fall < 1e-3;
  };
  const double found = threshold(0.9 * exact, 1.1 * exact, bisections, stands);
  std::sort(curve.rows.begin(), curve.rows.end());
  const std::string name = with_shape<ShapeT>("arch of " + std::to_string(blocks));
  record.compare_relative(name + ": least thickness over radius", S{}, exact, found, 0.02);
  record.vanishes(name + ": steps not solved", S{}, unsolved, 0);
}

inline void semicircular_arch(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick;
  arch<Polygon<>>(record, 31, quick ? 4 : 6);
  if (!quick) arch<Polyhedron<>>(record, 31, 5);
}

}  // namespace validation
