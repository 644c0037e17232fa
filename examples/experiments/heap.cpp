// SPDX-License-Identifier: MIT
// Heap of spheres on a plate from whose two ends they fall: angle of repose. The correlation of Y. C. Zhou, B. H. Xu, A. B.
// Yu and P. Zulli (Powder Technol. 125 (2002) 45), in degrees with d in mm and the rolling friction mur in mm,
//
//   phi = 68.61 mu_pp^0.27 mu_pw^0.22 mur_pp^0.06 mur_pw^0.12 d^-0.2,
//
// is quoted in the documents of Lethe (plate-discharge.rst), whose set-up is taken: a box 1 m long, 0.2 m deep, a
// plate 0.9 m long at the height 0.4 m, 52,000 spheres of 10 mm, 2400 kg/m^3, friction 0.2, mur = 1 mm, restitution
// 0.9, the ends of the plate closed until 0.75 s. For it the correlation gives 19.7 degrees. The angle is the slope of the
// highest spheres over the plate, 0.15 m to 0.35 m from its middle.
//
// mur is the couple over the normal force. Here it is the coefficient of rolling resistance times the effective radius,
// d/4 of two spheres and d/2 of a sphere and a wall.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/boundary/sink.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/sample/random_deposition.hpp"

#include "session.hpp"
#include "worlds.hpp"

namespace experiments {

namespace heap_parts {

using S = moreau::Space<3>;
using Vector = S::Vector;
using World = moreau::Simulation<moreau::Ball<double>, Rolling>;

constexpr double diameter = 0.01, plate = 0.9, length = 1, height = 0.4, step = 2e-4,
                 tolerance = 1e-3;
constexpr double closed = 0.75, friction = 0.2, rolling = 0.001,
                 restitution = 0.9;  // [s], [-], [m], [-]
const moreau::MaterialId sphere(0), wall(1);

World empty_world(double depth) {
  moreau::Materials<Rolling> laws(2, Rolling(friction, rolling / (diameter / 4), restitution));
  laws.set(sphere, wall, Rolling(friction, rolling / (diameter / 2), restitution));
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 500;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  World world(diameter, laws, moreau::ColouredGaussSeidel(options), tolerances);
  world.set_gravity({0, 0, -9.81});
  for (const double side : {-1.0, 1.0}) {
    world.add_wall(-side * Vector::UnitX(), side * length / 2 * Vector::UnitX(), wall);
    world.add_wall(-side * Vector::UnitY(), (side * depth / 2) * Vector::UnitY(), wall);
  }
  world.add_wall(Vector::UnitZ(), Vector::Zero(), wall);
  // The plate, both sides.
  moreau::TriangleMesh<> mesh;
  for (const double x : {-plate / 2, plate / 2})
    for (const double y : {-depth, depth}) mesh.vertices.push_back({x, y, height});
  mesh.facets = {{0, 2, 3}, {0, 3, 1}};
  world.add_mesh_wall(mesh, {}, moreau::WallSides::both, wall);
  return world;
}

/// Angle of the highest spheres between 0.15 m and 0.35 m from the middle [degrees].
double angle(const World& world) {
  constexpr int bins = 20;
  std::vector<double> top(bins, 0);
  for (const moreau::BodyId grain : world.grains()) {
    const Vector& x = world.pose(grain).position;
    const int bin = int(std::floor((std::abs(x[0]) - 0.15) / 0.2 * bins));
    if (bin >= 0 && bin < bins) top[std::size_t(bin)] = std::max(top[std::size_t(bin)], x[2]);
  }
  double n = 0, sx = 0, sy = 0, xx = 0, xy = 0;
  for (int k = 0; k < bins; ++k) {
    if (top[std::size_t(k)] < height) continue;
    const double x = 0.15 + 0.2 * (k + 0.5) / bins, y = top[std::size_t(k)];
    ++n, sx += x, sy += y, xx += x * x, xy += x * y;
  }
  if (n < 3) return 0;
  return -std::atan((xy - sx * sy / n) / (xx - sx * sx / n)) * 180 / std::numbers::pi;
}

Numbers run_heap(Run& run, std::size_t count, double depth, double until) {
  World world = empty_world(depth);
  std::vector<double> gates;  // indices of the two walls that close the plate
  if (run.is_started()) {
    moreau::reload_snapshot(run.snapshot(), world, gates);
  } else {
    std::mt19937_64 random(20);
    const std::vector<double> radii(count, diameter / 2);
    const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
    for (moreau::Pose<S> pose :
         moreau::random_deposition<S>(radii, std::array<double, 2>{plate, depth}, random)) {
      pose.position += Vector(-plate / 2, -depth / 2, height);
      world.add_grain(shape, pose, 2400, sphere);
    }
    for (const double side : {-1.0, 1.0})
      gates.push_back(
          double(world.add_wall(-side * Vector::UnitX(), side * plate / 2 * Vector::UnitX(), wall)
                     .index()));
  }
  while (world.time() < until) {
    if (!gates.empty() && world.time() >= closed) {
      for (const double gate : gates) {  // outside of the box
        const auto body = world.body_id(std::size_t(gate));
        moreau::Pose<S> pose = world.pose(body);
        pose.position[0] *= 10;
        world.set_pose(body, pose);
      }
      gates.clear();
    }
    world.step(step);
    if (run.must_stop()) {
      moreau::write_snapshot(run.snapshot(), world, gates);
      throw Paused();
    }
  }
  return {angle(world)};
}

}  // namespace heap_parts

void heap(Session& session) {
  using namespace heap_parts;
  const bool quick = session.quick();
  const std::size_t count = quick ? 500 : 52000;
  const double depth = quick ? 0.021 : 0.2, until = quick ? 0.1 : 15;
  const Result result =
      session.once("discharge", [&](Run& run) { return run_heap(run, count, depth, until); });
  Row row;
  row.figure = "angle of repose on the plate [degrees]";
  const double d = 1000 * diameter, mur = 1000 * rolling;
  const double published =
      68.61 * std::pow(friction, 0.49) * std::pow(mur, 0.18) * std::pow(d, -0.2);
  row.published = std::to_string(published).substr(0, 4) + " (correlation)";
  row.measured = result.values[0];
  row.law = "RollingResistance";
  row.step = step;
  row.tolerance = tolerance;
  row.grains = count;
  row.seconds = result.seconds;
  row.verdict = quick                                     ? "not compared"
                : std::abs(row.measured - published) <= 2 ? "within 2 degrees"
                                                          : "no";
  session.row(row);
}

}  // namespace experiments
