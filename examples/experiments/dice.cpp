// SPDX-License-Identifier: MIT
// Plastic dice, tetrahedra to icosahedra: solid fraction of the loosest and of the densest packing (J. Baker and A.
// Kudrolli, Phys. Rev. E 82 (2010) 061304), without walls.
//
// Procedure. Dice of equal volume, in a cell that is periodic along the two horizontal axes, above a floor: no side walls.
//   loose  they lie one above the other in a random deposition of their circumscribed balls, fall from there and come
//          to rest;
//   dense  the floor then shakes them along the vertical, with 25 Hz and an acceleration of 4 g at first, which falls
//          linearly to 0.
// The solid fraction is that of a slab from 2.5 sizes above the floor to 2.5 sizes below the highest centre. Friction
// between dice is not published: it is varied.
#include <array>
#include <cmath>
#include <cstdint>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "moreau/measure/solid_fraction.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/shape/circumradius.hpp"

#include "session.hpp"

namespace experiments {

namespace dice_parts {

using S = moreau::Space<3>;
using Vector = S::Vector;
using Shape = moreau::Polyhedron<double>;
using Law = moreau::SignoriniCoulomb<double>;

constexpr double size = 0.01, step = 2e-4, tolerance = 1e-3,
                 gravity = 9.81;  // edge of a cube of equal volume [m]

Shape die(int faces) {
  const double golden = (1 + std::sqrt(5)) / 2;
  std::vector<Vector> corners;
  const auto signs = [&](double x, double y, double z) {  // all signs of what is not 0
    for (int k = 0; k < 8; ++k) {
      const Vector corner((k & 1) != 0 ? -x : x, (k & 2) != 0 ? -y : y, (k & 4) != 0 ? -z : z);
      if ((x == 0 && (k & 1) != 0) || (y == 0 && (k & 2) != 0) || (z == 0 && (k & 4) != 0))
        continue;
      corners.push_back(corner);
    }
  };
  const auto cyclic = [&](double x, double y, double z) {
    signs(x, y, z), signs(z, x, y), signs(y, z, x);
  };
  switch (faces) {
    case 4:
      corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
      break;
    case 6:
      signs(1, 1, 1);
      break;
    case 8:
      cyclic(1, 0, 0);
      break;
    case 12:
      signs(1, 1, 1), cyclic(0, 1 / golden, golden);
      break;
    default:
      cyclic(0, 1, golden);
  }
  const Shape unit((std::span<const Vector>(corners)));
  return unit.scaled(size / std::cbrt(unit.mass_properties(1).mass));
}

double fraction(const moreau::Simulation<Shape, Law>& world, double length) {
  double top = 0;
  for (const moreau::BodyId grain : world.grains())
    top = std::max(top, world.pose(grain).position[2]);
  double bottom = world.pose(world.walls()[0]).position[2];
  return moreau::solid_fraction(world, moreau::Aabb<S>(Vector(0, 0, bottom + 2.5 * size),
                                                       Vector(length, length, top - 2.5 * size)));
}

/// Solid fraction of the loose and of the dense packing, share of steps not solved.
Numbers pack(int faces, std::size_t count, double across, double friction, double shaking,
             std::uint64_t seed) {
  const double length = across * size;
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 500;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  moreau::Simulation<Shape, Law> world(size, moreau::Materials<Law>(1, Law(friction)),
                                       moreau::ColouredGaussSeidel(options), tolerances);
  const Shape shape = die(faces);
  std::mt19937_64 random(seed);
  const auto id = world.add_shape(shape);
  const std::vector<double> radii(count, moreau::circumradius(shape));
  for (const moreau::Pose<S>& pose : moreau::random_deposition<S>(radii, length, random))
    world.add_grain(id, pose, 1000);
  const auto floor = world.add_wall(Vector::UnitZ(), Vector::Zero());
  for (const int axis : {0, 1}) world.set_periodic(axis, 0, length);
  world.set_gravity({0, 0, -gravity});
  double steps = 0, unsolved = 0;
  const auto advance = [&](double duration, const auto& velocity) {
    for (const double end = world.time() + duration; world.time() < end; ++steps) {
      world.set_velocity(floor, velocity(1 - (end - world.time()) / duration) * Vector::UnitZ());
      unsolved += !world.step(step).solve.converged;
    }
  };
  advance(0.6, [](double) { return 0.0; });
  const double loose = fraction(world, length);
  const double rate = 2 * std::numbers::pi * 25;
  advance(shaking, [&](double share) {
    return (1 - share) * 4 * gravity / rate * std::cos(rate * world.time());
  });
  advance(0.3, [](double) { return 0.0; });
  return {loose, fraction(world, length), unsolved / steps};
}

}  // namespace dice_parts

void dice(Session& session) {
  using namespace dice_parts;
  struct Die {
    int faces;
    const char* name;
    double loose, dense;
  };
  const bool quick = session.quick();
  const std::size_t count = quick ? 150 : 400;
  const double across = quick ? 5 : 6, shaking = quick ? 0.2 : 4;
  std::vector<Numbers> rows;
  for (const double friction : quick ? Numbers{0.4} : Numbers{0.2, 0.5})
    for (const Die& one : {Die{4, "tetrahedra", 0.51, 0.64},
                           {6, "cubes", 0.54, 0.67},
                           {8, "octahedra", 0.52, 0.64},
                           {12, "dodecahedra", 0.51, 0.63},
                           {20, "icosahedra", 0.50, 0.59}}) {
      if (quick && one.faces != 6) continue;
      Numbers loose, dense;
      Row row;
      for (std::uint64_t seed = 1; seed <= (quick ? 1u : 2u); ++seed) {
        const Result result = session.once(
            std::string(one.name) + " friction " + std::to_string(friction) + " count " +
                std::to_string(count) + " seed " + std::to_string(seed),
            [&](Run&) { return pack(one.faces, count, across, friction, shaking, seed); });
        loose.push_back(result.values[0]);
        dense.push_back(result.values[1]);
        row.seconds += result.seconds;
      }
      row.samples = loose.size();
      row.law = "SignoriniCoulomb, friction " + std::to_string(friction).substr(0, 3);
      row.step = step;
      row.tolerance = tolerance;
      row.grains = count;
      const auto add = [&](const char* kind, double published, const Numbers& samples) {
        row.figure = std::string(one.name) + ", " + kind + ": solid fraction";
        row.published = std::to_string(published).substr(0, 4) + " ± 0.01";
        row.measured = mean_of(samples).value;
        row.error = mean_of(samples).error;
        row.verdict = std::abs(row.measured - published) <= 0.02 ? "yes" : "no";
        session.row(row);
      };
      add("loosest", one.loose, loose);
      add("densest", one.dense, dense);
      rows.push_back({double(one.faces), friction, mean_of(loose).value, one.loose,
                      mean_of(dense).value, one.dense});
    }
  session.curve(
      "dice", {"faces", "friction", "loose", "published loose", "dense", "published dense"}, rows);
}

}  // namespace experiments
