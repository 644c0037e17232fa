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
// The smaller version has half of all lengths of the box, with spheres of the same size: a plate 0.45 m long, filled to
// half the height, periodic along the depth of 8 diameters in place of the two walls, the slope from 0.075 m to
// 0.175 m. A sphere whose centre has passed the end of the plate is removed in place of falling to the floor.
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

constexpr double diameter = 0.01, plate = 0.9, length = 1, height = 0.4, tolerance = 1e-3;
constexpr double closed = 0.75, friction = 0.2, rolling = 0.001,
                 restitution = 0.9;  // [s], [-], [m], [-]
const moreau::MaterialId sphere(0), wall(1);

struct Case {
  const char* name;
  std::size_t count;
  double scale, depth;  ///< of the lengths [-], of the box [m]
  bool small;           ///< periodic along the depth, spheres beyond the plate are removed
  double rolling;       ///< couple over normal force [m]
  double until, step;   ///< [s]
};

World empty_world(const Case& c) {
  const double depth = c.depth;
  moreau::Materials<Rolling> laws(2, Rolling(friction, c.rolling / (diameter / 4), restitution));
  laws.set(sphere, wall, Rolling(friction, c.rolling / (diameter / 2), restitution));
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 500;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  World world(diameter, laws, moreau::ColouredGaussSeidel(options), tolerances);
  world.set_gravity({0, 0, -9.81});
  if (c.small) {
    world.set_periodic(1, -depth / 2, depth / 2);
    world.add_wall(Vector::UnitZ(), height * Vector::UnitZ(), wall);
    return world;
  }
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

/// Angle of the highest spheres between 0.15 m and 0.35 m, times the scale, from the middle [degrees].
double angle(const World& world, double scale) {
  const double from = 0.15 * scale, width = 0.01;
  const int bins = int(std::lround(0.2 * scale / width));
  std::vector<double> top(std::size_t(bins), 0.0);
  for (const moreau::BodyId grain : world.grains()) {
    const Vector& x = world.pose(grain).position;
    const int bin = int(std::floor((std::abs(x[0]) - from) / width));
    if (bin >= 0 && bin < bins) top[std::size_t(bin)] = std::max(top[std::size_t(bin)], x[2]);
  }
  double n = 0, sx = 0, sy = 0, xx = 0, xy = 0;
  for (int k = 0; k < bins; ++k) {
    if (top[std::size_t(k)] < height) continue;
    const double x = from + width * (k + 0.5), y = top[std::size_t(k)];
    ++n, sx += x, sy += y, xx += x * x, xy += x * y;
  }
  if (n < 3) return 0;
  return -std::atan((xy - sx * sy / n) / (xx - sx * sx / n)) * 180 / std::numbers::pi;
}

/// @returns angle every 0.25 s from 1 s on; then at the end the number of spheres, their greatest velocity [m/s] and
///          the share of steps not solved
Numbers run_heap(Run& run, const Case& c) {
  World world = empty_world(c);
  const double half = plate * c.scale / 2;
  auto sink = moreau::Sink<S>::outside(
      {Vector(-half, -1e3, -1e3), Vector(half, 1e3, 1e3)});  // of the smaller version
  std::vector<double> gates;   // indices of the two walls that close the plate
  Numbers angles, sums{0, 0};  // steps, those not solved
  if (run.is_started()) {
    moreau::reload_snapshot(run.snapshot(), world, gates, angles, sums);
  } else {
    std::mt19937_64 random(20);
    const std::vector<double> radii(c.count, diameter / 2);
    const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
    for (moreau::Pose<S> pose :
         moreau::random_deposition<S>(radii, std::array<double, 2>{2 * half, c.depth}, random)) {
      pose.position += Vector(-half, -c.depth / 2, height);
      world.add_grain(shape, pose, 2400, sphere);
    }
    for (const double side : {-1.0, 1.0})
      gates.push_back(double(
          world.add_wall(-side * Vector::UnitX(), side * half * Vector::UnitX(), wall).index()));
  }
  while (world.time() < c.until) {
    if (!gates.empty() && world.time() >= closed) {
      for (const double gate : gates) {  // outside of the box
        const auto body = world.body_id(std::size_t(gate));
        moreau::Pose<S> pose = world.pose(body);
        pose.position[0] *= 10;
        world.set_pose(body, pose);
      }
      gates.clear();
    }
    sums[1] += !world.step(c.step).solve.converged;
    ++sums[0];
    if (c.small && gates.empty()) sink.apply(world);
    if (world.time() >= 1 + 0.25 * double(angles.size())) angles.push_back(angle(world, c.scale));
    run.progress(world.time() / c.until);
    if (!run.must_stop() && !run.must_store()) continue;
    moreau::write_snapshot(run.snapshot(), world, gates, angles, sums);
    run.note_stored();
    if (run.must_stop()) throw Paused();
  }
  double fastest = 0;
  for (const moreau::BodyId grain : world.grains())
    fastest = std::max(fastest, world.velocity(grain).norm());
  angles.insert(angles.end(),
                {angle(world, c.scale), double(world.grain_count()), fastest, sums[1] / sums[0]});
  return angles;
}

}  // namespace heap_parts

void heap(Session& session) {
  using namespace heap_parts;
  const bool quick = session.quick();
  std::vector<Case> cases{{"half size", 5200, 0.5, 0.08, true, rolling, 4, 5e-4},
                          {"half size, twice the step", 5200, 0.5, 0.08, true, rolling, 10, 1e-3},
                          {"half size, no rolling friction", 5200, 0.5, 0.08, true, 0, 4, 5e-4},
                          {"discharge", 52000, 1, 0.2, false, rolling, 15, 2e-4}};
  if (quick) cases = {{"discharge", 500, 1, 0.021, false, rolling, 0.1, 2e-4}};
  for (const Case& c : cases) {
    if (!session.wants(c.name)) continue;
    const Result result = session.once(c.name, [&](Run& run) { return run_heap(run, c); });
    const std::size_t n = result.values.size() - 4;
    std::vector<Numbers> rows;
    for (std::size_t k = 0; k < n; ++k) rows.push_back({1 + 0.25 * double(k), result.values[k]});
    session.curve("heap_" + std::to_string(c.count) + (c.rolling > 0 ? "" : "_no_rolling") +
                      (c.until == 10 ? "_long" : ""),
                  {"t [s]", "angle [degrees]"}, rows);
    Row row;
    row.figure = std::string(c.name) + ": angle of repose on the plate [degrees]";
    const double d = 1000 * diameter, mur = 1000 * c.rolling;
    const double published =
        68.61 * std::pow(friction, 0.49) * std::pow(mur, 0.18) * std::pow(d, -0.2);
    row.published = mur > 0 ? std::to_string(published).substr(0, 4) + " (correlation)" : "–";
    row.measured = result.values[n];
    row.law = "RollingResistance";
    row.step = c.step;
    row.tolerance = tolerance;
    row.grains = c.count;
    row.seconds = result.seconds;
    row.verdict = quick || mur == 0                         ? "not compared"
                  : std::abs(row.measured - published) <= 2 ? "within 2 degrees"
                                                            : "no";
    session.row(row);
    row.published = "–", row.verdict = "";
    row.figure = std::string(c.name) + ": spheres left on the plate or in the box";
    row.measured = result.values[n + 1];
    session.row(row);
    row.figure = std::string(c.name) + ": greatest velocity at the end [m/s]";
    row.measured = result.values[n + 2];
    session.row(row);
    row.figure = std::string(c.name) + ": steps not solved, share";
    row.measured = result.values[n + 3];
    session.row(row);
  }
}

}  // namespace experiments
