// SPDX-License-Identifier: MIT
// Collapse of a column of height a r on a rough floor, after its container has vanished: disks between two sides, r
// half of their distance, and balls in a tube of radius r. Published for experiments (G. Lube et al., J. Fluid Mech. 508
// (2004) 175 and Phys. Rev. E 72 (2005) 041301): run-out over r, for small a, 1.24 a (axisymmetric) and 1.2 a (plane),
// whatever the material; 1.6 sqrt(a) (axisymmetric) for a > 1.7. Their grains are sand, salt, sugar, rice; these are
// balls and disks, which roll: friction is varied. Controls are the plane column of random polygons with the areas of
// the disks, and balls with resistance to rolling: a couple of up to a tenth of the diameter times the normal force, that
// of the heap (heap.cpp). It is not known for the sand of the experiments.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"

#include "session.hpp"
#include "worlds.hpp"

namespace experiments {

namespace columns_parts {

constexpr double size = 0.004, tolerance = 1e-3, gravity = 9.81;  // [m], [-], [m/s^2]
template <class Shape>
constexpr double step = moreau::SpaceOf<Shape>::dim == 3 ? 4e-4 : 2e-4;  // [s]

template <class Shape, class Law>
using World = moreau::Simulation<Shape, Law>;

const moreau::MaterialId grain_material(0), wall_material(1);

/// @param radius effective radius of the contact [m]
template <class Law>
Law law_of(double friction, double radius) {
  if constexpr (std::is_same_v<Law, Rolling>)
    return Law(friction, 0.1 * size / radius);
  else
    return Law(friction);
}

template <class Shape, class Law>
World<Shape, Law> empty_world(double friction) {
  constexpr int up = moreau::SpaceOf<Shape>::dim - 1;
  using Vector = typename moreau::SpaceOf<Shape>::Vector;
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 500;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.15;
  moreau::Materials<Law> laws(2, law_of<Law>(friction, size / 4));
  laws.set(grain_material, wall_material, law_of<Law>(friction, size / 2));
  World<Shape, Law> world(0.9 * size, laws, moreau::ColouredGaussSeidel(options), tolerances);
  world.set_gravity(Vector(-gravity * Vector::Unit(up)));
  world.add_wall(Vector(Vector::Unit(up)), Vector(Vector::Zero()), wall_material);
  return world;
}

template <class Shape>
struct Grain {
  moreau::Pose<moreau::SpaceOf<Shape>> pose;
  Shape shape;
  double volume;
};

/// A random grain with the volume of the ball of this radius.
template <class Shape>
Shape grain_of(double radius, std::mt19937_64& random) {
  using S = moreau::SpaceOf<Shape>;
  const Shape shape = moreau::Ballast<Shape>::draw(random);
  const double ball = moreau::BallIn<S>(1).mass_properties(1).mass;
  return shape.scaled(radius * std::pow(ball / shape.mass_properties(1).mass, 1.0 / S::dim));
}

/// A settled column of the radius r, as high as r times the aspect.
template <class Shape, class Law, class S = moreau::SpaceOf<Shape>>
std::vector<Grain<Shape>> column(Run& run, double r, double aspect, double friction,
                                 std::uint64_t seed) {
  constexpr int up = S::dim - 1;
  using Vector = typename S::Vector;
  World<Shape, Law> world = empty_world<Shape, Law>(friction);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.9, 1.1);
  const double solid = S::dim == 3 ? 0.58 : 0.8;
  const double volume = S::dim == 3 ? std::numbers::pi * r * r * r * aspect : 2 * r * r * aspect;
  std::vector<Shape> shapes;
  double filled = 0;
  // Those outside of the tube are not taken.
  const double surplus = S::dim == 3 ? 4 / std::numbers::pi * 1.1 : 1;
  while (filled < solid * volume * surplus) {
    shapes.push_back(grain_of<Shape>(share(random) * size / 2, random));
    filled += shapes.back().mass_properties(1).mass;
  }
  std::vector<double> radii;
  for (const Shape& shape : shapes) radii.push_back(shape.circumradius());
  const auto poses = moreau::random_deposition<S>(radii, 2 * r, random);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    moreau::Pose<S> pose = poses[k];
    for (int axis = 0; axis < up; ++axis) pose.position[axis] -= r;
    if (pose.position.template head<up>().norm() > r - radii[k]) continue;
    world.add_grain(world.add_shape(shapes[k]), pose, 2500);
  }
  if constexpr (S::dim == 3)
    world.add_cylinder(Vector(Vector::Zero()), Vector(Vector::UnitZ()), r, wall_material);
  else
    for (const double side : {-1.0, 1.0})
      world.add_wall(Vector(-side * Vector::UnitX()), Vector(side * r * Vector::UnitX()),
                     wall_material);
  const int settling = int(std::lround(0.4 / step<Shape>));
  for (int k = 0; k < settling; ++k) {
    world.step(step<Shape>);
    run.progress(0.4 * k / settling);
  }
  std::vector<Grain<Shape>> grains;
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const Shape& shape = world.shape_of_grain(k);
    grains.push_back({world.pose(world.grain(k)), shape, shape.mass_properties(1).mass});
  }
  return grains;
}

/// Radius of the deposit: where its mean height, at the solid fraction of the column, falls below half a grain.
template <class Shape, class S = moreau::SpaceOf<Shape>>
double radius_of(const std::vector<Grain<Shape>>& grains) {
  constexpr int up = S::dim - 1;
  const double solid = S::dim == 3 ? 0.58 : 0.8, ring = 2 * size;
  std::vector<double> volume(400, 0.0);
  for (const Grain<Shape>& grain : grains) {
    const auto k = std::size_t(grain.pose.position.template head<up>().norm() / ring);
    if (k < volume.size()) volume[k] += grain.volume;
  }
  const double least = size / 2;
  double last = 0;
  for (std::size_t k = 0; k < volume.size(); ++k) {
    const double area = S::dim == 3 ? std::numbers::pi * ring * ring * double(2 * k + 1) : 2 * ring;
    const double height = volume[k] / (solid * area);
    if (height >= least) {
      last = height;
      continue;
    }
    // Between the middles of two rings.
    return std::max(
        0.0, ring * (double(k) - 0.5 + (last > height ? (last - least) / (last - height) : 0)));
  }
  return 0;
}

/// Aspect ratio, run-out over r, number of grains.
template <class Shape, class Law, class S = moreau::SpaceOf<Shape>>
Numbers collapse(Run& run, double r, double aspect, double friction, std::uint64_t seed) {
  constexpr int up = S::dim - 1;
  const std::vector<Grain<Shape>> start = column<Shape, Law>(run, r, aspect, friction, seed);
  World<Shape, Law> world = empty_world<Shape, Law>(friction);
  for (const Grain<Shape>& grain : start)
    world.add_grain(world.add_shape(grain.shape), grain.pose, 2500);
  // The height of the column: twice the mean height of its volume.
  double height = 0;
  for (const Grain<Shape>& grain : start)
    height += 2 * grain.pose.position[up] / double(start.size());
  const double duration = 10 * std::sqrt(height / gravity);
  double unsolved = 0;
  while (world.time() < duration) {
    unsolved += !world.step(step<Shape>).solve.converged;
    run.progress(0.4 + 0.6 * world.time() / duration);
  }
  std::vector<Grain<Shape>> deposit = start;
  for (std::size_t k = 0; k < world.grain_count(); ++k)
    deposit[k].pose = world.pose(world.grain(k));
  return {height / r, radius_of(deposit) / r - 1, double(start.size()), unsolved};
}

template <class Shape, class Law = Rigid>
void run(Session& session, const std::string& name, double across, const Numbers& aspects,
         int samples, double slope, double power) {
  const double r = across * size;
  const Numbers frictions{0.3, 0.6};
  std::map<std::pair<double, double>, std::vector<Result>> all;
  bool paused = false;
  try {
    for (int seed = 1; seed <= samples; ++seed)
      for (const double aspect : aspects)
        for (const double friction : frictions) {
          const std::string key = name + " aspect " + std::to_string(aspect) + " friction " +
                                  std::to_string(friction) + " across " + std::to_string(across) +
                                  " seed " + std::to_string(seed);
          if (!session.wants(key)) continue;
          all[{friction, aspect}].push_back(session.once(key, [&](Run& piece) {
            return collapse<Shape, Law>(piece, r, aspect, friction, std::uint64_t(seed));
          }));
        }
  } catch (const Paused&) {
    paused = true;
  }
  std::vector<Numbers> rows;
  for (const double friction : frictions)
    for (const double aspect : aspects) {
      Numbers ratios, runouts;
      Row row;
      double unsolved = 0;
      for (const Result& result : all[{friction, aspect}]) {
        ratios.push_back(result.values[0]);
        runouts.push_back(result.values[1]);
        row.grains = std::size_t(result.values[2]);
        unsolved += result.values[3];
        row.seconds += result.seconds;
      }
      if (ratios.empty()) continue;
      const double a = mean_of(ratios).value;
      const double published = power > 0 && a > 1.7 ? 1.6 * std::sqrt(a) : slope * a;
      row.figure = name + ": run-out over r, a = " + std::to_string(a).substr(0, 4) +
                   ", friction " + std::to_string(friction).substr(0, 3);
      row.published = std::to_string(published).substr(0, 4) + " (experiment)";
      row.measured = mean_of(runouts).value;
      row.error = mean_of(runouts).error;
      row.samples = runouts.size();
      row.law = std::is_same_v<Law, Rolling> ? "RollingResistance" : "SignoriniCoulomb";
      row.step = step<Shape>;
      row.tolerance = tolerance;
      row.verdict = std::abs(row.measured - published) <= 0.15 * published ? "within 15 %" : "no";
      session.row(row);
      rows.push_back({friction, a, row.measured, row.error, published});
      row.figure += ": steps not solved, of all samples";
      row.published = "–", row.verdict = "";
      row.measured = unsolved;
      row.error = std::numeric_limits<double>::quiet_NaN();
      session.row(row);
    }
  if (!rows.empty())
    session.curve("columns_" + name, {"friction", "a", "run-out", "error", "published"}, rows);
  if (paused) throw Paused();
}

}  // namespace columns_parts

void columns(Session& session) {
  using namespace columns_parts;
  if (session.quick()) {
    run<moreau::Disk<double>>(session, "plane", 8, {1}, 1, 1.2, 0);
    run<moreau::Ball<double>>(session, "axisymmetric", 4, {1}, 1, 1.24, 0.5);
    return;
  }
  run<moreau::Disk<double>>(session, "plane", 25, {0.5, 1, 1.7}, 3, 1.2, 0);
  run<moreau::Polygon<double>>(session, "plane_polygons", 25, {0.5, 1, 1.7}, 3, 1.2, 0);
  run<moreau::Ball<double>>(session, "axisymmetric", 10, {0.5, 1, 3}, 2, 1.24, 0.5);
  run<moreau::Ball<double>, Rolling>(session, "axisymmetric_rolling", 10, {0.5, 1, 3}, 2, 1.24,
                                     0.5);
}

}  // namespace experiments
