// SPDX-License-Identifier: MIT
// A ball, r = 1 mm, restitution 0.5, falls on a wall of triangles and on a half-space (DEM-Engine #73: there the two
// heights of the rebound differ). Right: e^2 times the height of the fall, on both, wherever the ball hits.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <moreau/moreau.hpp>
#include <random>

#include "session.hpp"

namespace experiments {

namespace rebound_parts {

using Law = moreau::SignoriniCoulomb<double>;
using Vector = Eigen::Vector3d;

constexpr double radius = 0.001, fall = 0.02, restitution = 0.5, gravity = 9.81, step = 1e-5;

/// A square of 2 cm in count x count squares of two triangles.
moreau::TriangleMesh<> square(std::uint32_t count) {
  moreau::TriangleMesh<> mesh;
  for (std::uint32_t i = 0; i <= count; ++i)
    for (std::uint32_t k = 0; k <= count; ++k)
      mesh.vertices.push_back({0.02 * i / count - 0.01, 0.02 * k / count - 0.01, 0});
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = i * (count + 1) + k, b = a + count + 1;
      mesh.facets.push_back({a, b, b + 1});
      mesh.facets.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// Height of the rebound over e^2 times the height of the fall.
/// @param tiles along a side of the mesh; 0: a half-space
double height(std::uint32_t tiles, double x, double y) {
  moreau::Simulation<moreau::Ball<double>, Law> world(
      2 * radius, moreau::Materials<Law>(1, Law(0, restitution)));
  const auto shape = world.add_shape(moreau::Ball<double>(radius));
  const auto ball = world.add_grain(shape, {Vector(x, y, radius + fall)}, 2500);
  if (tiles == 0)
    world.add_wall(Vector::UnitZ(), Vector::Zero());
  else
    world.add_mesh_wall(square(tiles));
  world.set_gravity({0, 0, -gravity});
  double most = 0;
  bool hit = false;
  for (int k = 0; k < 15000; ++k) {
    const double before = world.velocity(ball)[2];
    world.step(step);
    const double now = world.velocity(ball)[2];
    if (hit && before > 0 && now <= 0) break;
    hit = hit || now > 0;
    if (hit) most = std::max(most, world.pose(ball).position[2] - radius);
  }
  return most / (restitution * restitution * fall);
}

}  // namespace rebound_parts

void rebound(Session& session) {
  using namespace rebound_parts;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-0.005, 0.005);
  struct Floor {
    const char* name;
    std::uint32_t tiles;
    int places;
  };
  double plane = 0;
  for (const Floor& floor : {Floor{"half-space", 0, 1},
                             {"mesh of 2 triangles", 1, 10},
                             {"mesh of 800 triangles", 20, 10}}) {
    const Result result = session.once(floor.name, [&](Run&) {
      Numbers heights;
      for (int k = 0; k < floor.places; ++k)
        heights.push_back(height(floor.tiles, place(random), place(random)));
      return heights;
    });
    const auto [low, high] = std::minmax_element(result.values.begin(), result.values.end());
    if (floor.tiles == 0) plane = *low;
    Row row;
    row.figure = std::string(floor.name) + ": height of the rebound over e² × height of the fall";
    row.published = "1";
    row.measured = mean_of(result.values).value;
    row.error = mean_of(result.values).error;
    row.samples = result.values.size();
    row.law = "SignoriniCoulomb";
    row.step = step;
    row.tolerance = 1e-4;
    row.grains = 1;
    row.seconds = result.seconds;
    row.verdict =
        std::abs(row.measured - 1) <= 5e-3 ? "yes" : "no";  // a step of 10 us moves the impact
    session.row(row);
    if (floor.tiles == 0) continue;
    row.figure =
        std::string(floor.name) + ": largest difference to the half-space, over its height";
    row.published = "0; another engine differs";
    row.measured = std::max(std::abs(*low - plane), std::abs(*high - plane)) / plane;
    row.error = std::numeric_limits<double>::quiet_NaN();
    row.verdict = row.measured <= 1e-9 ? "yes" : "no";
    session.row(row);
  }
}

}  // namespace experiments
