// SPDX-License-Identifier: MIT
// Friction that sticks. Where other engines report a creep, this measures it: the mean velocity of a body that
// Coulomb's law holds at rest, over the velocity g h that gravity gives in a step.
//
//   grip      a capsule, r = 4 mm, 45 g, between two pads, friction 0.7, squeezed by 12 to 60 N
//   held      a cube of 1 kg, pressed to a wall by 20 N, friction 1
//   stack     two cubes on an incline of slope 0.3, friction 0.5, with mass ratios of 1e-3 to 1e3
//   launched  a cube of 0.1 m on a floor with 6 m/s, friction 0.5: stops after v^2 / (2 mu g)
//   points    a prism on 3, 4 and 8 points: held while 0.9 mu m g pushes it, starts to slide at mu m g
//
// Lengths go from 1 um to 10 m. The time step is a share of sqrt(L / g), L the size of the body.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "session.hpp"
#include "worlds.hpp"

namespace experiments {

namespace sticking_parts {

using S = moreau::Space<3>;
using Vector = S::Vector;
using Polyhedron = moreau::Polyhedron<double>;
using Capsule = moreau::Capsule<double>;

constexpr double gravity = 9.81;  // [m/s^2]

/// Step and criterion of a case.
struct Numerics {
  double share = 1e-2;  ///< of sqrt(L / g): the step [-]
  bool tight = false;   ///< criterion 1e-12, else the default of the solver

  double step(double size) const { return share * std::sqrt(size / gravity); }
};

moreau::ColouredGaussSeidel solver(const Numerics& numerics) {
  moreau::ColouredOptions options;
  if (numerics.tight) {
    options.tolerance = options.velocity_tolerance = 1e-12;
    options.max_sweeps = 20000;
  }
  return moreau::ColouredGaussSeidel(options);
}

/// The law; its springs give by 1e-6 of the size under the weight.
template <class Law>
Law law_of(double friction, double weight, double size) {
  if constexpr (std::is_same_v<Law, Rigid>)
    return Law(friction);
  else
    return Law(Rigid(friction), 1e6 * weight / size);
}
template <class Law>
constexpr const char* name_of() {
  return std::is_same_v<Law, Rigid> ? "SignoriniCoulomb" : "Compliant<SignoriniCoulomb>";
}

template <class Shape, class Law>
moreau::Simulation<Shape, Law> world_of(double size, const Law& law, const Numerics& numerics) {
  moreau::Simulation<Shape, Law> world(size, moreau::Materials<Law>(1, law), solver(numerics));
  world.set_gravity({0, 0, -gravity});
  return world;
}

/// What became of grains that should not move, from 4 to 14 sqrt(L / g).
struct Stay {
  double creep = 0;     ///< largest mean velocity along an axis, over g h
  double lift = 0;      ///< largest way along the normal of the contacts, over L
  double unsolved = 0;  ///< share of all steps
};
template <class World>
Stay stay(World& world, double size, const Numerics& numerics, const Vector& axis,
          const Vector& normal) {
  const double h = numerics.step(size);
  const int first = int(std::lround(4 / numerics.share)),
            last = int(std::lround(14 / numerics.share));
  Stay result;
  std::vector<Vector> before;
  for (int k = 0; k < last; ++k) {
    if (k == first)
      for (const moreau::BodyId grain : world.grains())
        before.push_back(world.pose(grain).position);
    result.unsolved += !world.step(h).solve.converged;
    for (std::size_t g = 0; g < before.size(); ++g) {
      const Vector way = world.pose(world.grain(g)).position - before[g];
      result.lift = std::max(result.lift, normal.dot(way) / size);
      if (k + 1 == last)
        result.creep =
            std::max(result.creep, std::abs(axis.dot(way)) / ((last - first) * h) / (gravity * h));
    }
  }
  result.unsolved /= last;
  return result;
}

/// A cube that a force of 20 N per 9.81 N of its weight presses to a wall.
template <class Law>
Stay held(double size, double, const Numerics& numerics) {
  const double weight = 1000 * size * size * size * gravity;
  auto world = world_of<Polyhedron>(size, law_of<Law>(1, weight, size), numerics);
  const auto shape = world.add_shape(moreau::cuboid<Polyhedron>(Vector::Constant(size / 2)));
  const auto cube = world.add_grain(shape, {Vector(size / 2, 0, 0)}, 1000);
  world.set_force(cube, {-20 / 9.81 * weight, 0, 0});
  world.add_wall(Vector::UnitX(), Vector::Zero());
  return stay(world, size, numerics, Vector::UnitZ(), Vector::UnitX());
}

/// @param ratio mass of the upper cube over that of the lower one
template <class Law>
Stay stack(double size, double ratio, const Numerics& numerics) {
  const double weight = 1000 * size * size * size * gravity * std::max(1.0, ratio);
  auto world = world_of<Polyhedron>(size, law_of<Law>(0.5, weight, size), numerics);
  const double angle = std::atan(0.3);
  world.set_gravity(gravity * Vector(std::sin(angle), 0, -std::cos(angle)));
  const auto shape = world.add_shape(moreau::cuboid<Polyhedron>(Vector::Constant(size / 2)));
  world.add_grain(shape, {Vector(0, 0, size / 2)}, 1000);
  world.add_grain(shape, {Vector(0, 0, 1.5 * size)}, 1000 * ratio);
  world.add_wall(Vector::UnitZ(), Vector::Zero());
  return stay(world, size, numerics, Vector::UnitX(), Vector::UnitZ());
}

/// @param size  diameter of the capsule [m]
/// @param ratio mass of a pad over that of the capsule
template <class Law>
Stay grip(double size, double force, double ratio, const Numerics& numerics) {
  const double radius = size / 2, half_length = 2.5 * size;
  const Capsule capsule(half_length, radius);
  const double volume = capsule.mass_properties(1).mass;
  const double mass = 0.045 * std::pow(size / 0.008, 3), weight = mass * gravity;
  auto world = world_of<Capsule>(size, law_of<Law>(0.7, weight, size), numerics);
  moreau::Pose<S> pose;  // its axis along y
  pose.rotation = S::exp(Vector(0, 0, std::numbers::pi / 2));
  world.add_grain(world.add_shape(capsule), pose, mass / volume);
  for (const double side : {-1.0, 1.0}) {
    const auto pad = world.add_wall(-side * Vector::UnitX(), side * radius * Vector::UnitX());
    world.set_wall_mass(pad, ratio * mass);
    world.set_force(pad, -side * force * Vector::UnitX());
  }
  return stay(world, size, numerics, Vector::UnitZ(), Vector::UnitX());
}

/// A floor of squares, each of two triangles.
moreau::TriangleMesh<> tiles(double from, double to, double side, int count) {
  moreau::TriangleMesh<> mesh;
  const auto n = std::uint32_t(count);
  for (std::uint32_t i = 0; i <= n; ++i)
    for (const double y : {-side, side})
      mesh.vertices.push_back({from + (to - from) * i / n, y, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i;
    mesh.facets.push_back({a, a + 2, a + 3});
    mesh.facets.push_back({a, a + 3, a + 1});
  }
  return mesh;
}

/// A floor: 0: half-space, 1: two triangles, 2: 40 tiles.
template <class World>
void add_floor(World& world, int kind, double from, double to, double side) {
  if (kind == 0)
    world.add_wall(Vector::UnitZ(), Vector::Zero());
  else
    world.add_mesh_wall(tiles(from, to, side, kind == 1 ? 1 : 40));
}

/// What became of the launched cube.
struct Launch {
  double distance = 0, lift = 0, tilt = 0;  ///< over v^2 / (2 mu g), less 1; over L; [rad]
};
template <class Law>
Launch launched(double size, int floor, const Numerics& numerics) {
  const double friction = 0.5, speed = 6 * std::sqrt(size / 0.1);
  const double path = speed * speed / (2 * friction * gravity), h = numerics.step(size);
  const double weight = 1000 * size * size * size * gravity;
  auto world = world_of<Polyhedron>(size, law_of<Law>(friction, weight, size), numerics);
  const auto shape = world.add_shape(moreau::cuboid<Polyhedron>(Vector::Constant(size / 2)));
  const auto cube = world.add_grain(shape, {Vector(0, 0, size / 2)}, 1000);
  add_floor(world, floor, -2 * size, path + 4 * size, 4 * size);
  // Springs are at rest under the weight before the cube is launched.
  const int rest = std::is_same_v<Law, Rigid> ? 0 : int(std::lround(4 / numerics.share));
  for (int k = 0; k < rest; ++k) world.step(h);
  const double start = world.pose(cube).position[0];
  world.set_velocity(cube, {speed, 0, 0});
  Launch launch;
  const int steps = int(1.2 * speed / (friction * gravity) / h);
  for (int k = 0; k < steps; ++k) {
    world.step(h);
    const moreau::Pose<S>& pose = world.pose(cube);
    launch.lift = std::max(launch.lift, pose.position[2] / size - 0.5);
    launch.tilt = std::max(launch.tilt,
                           Vector(pose.rotation * Vector::UnitZ()).cross(Vector::UnitZ()).norm());
  }
  launch.distance = (world.pose(cube).position[0] - start) / path - 1;
  return launch;
}

/// A prism on `corners` points; its weight [N].
template <class Law>
struct OnPoints {
  moreau::Simulation<Polyhedron, Law> world;
  double weight;
};
template <class Law>
OnPoints<Law> prism_on(double size, int corners, int floor, const Numerics& numerics) {
  constexpr double friction = 0.5;
  std::vector<Vector> points;
  for (int k = 0; k < corners; ++k)
    for (const double z : {-0.2, 0.2}) {
      const double angle = 2 * std::numbers::pi * k / corners + 0.1;
      points.push_back(size * Vector(0.5 * std::cos(angle), 0.5 * std::sin(angle), z));
    }
  const Polyhedron prism((std::span<const Vector>(points)));
  const double weight = prism.mass_properties(1000).mass * gravity;
  auto world = world_of<Polyhedron>(0.4 * size, law_of<Law>(friction, weight, size), numerics);
  world.add_grain(world.add_shape(prism), {Vector(0, 0, 0.2 * size)}, 1000);
  add_floor(world, floor, -2 * size, 2 * size, 2 * size);
  return {std::move(world), weight};
}

/// Creep of a prism that 0.9 of the force that starts to slide it pushes along a floor.
template <class Law>
Stay pushed(double size, int corners, int floor, const Numerics& numerics) {
  auto [world, weight] = prism_on<Law>(size, corners, floor, numerics);
  const Vector direction(std::cos(0.3), std::sin(0.3), 0);
  world.set_force(world.grain(0), 0.9 * 0.5 * weight * direction);
  return stay(world, size, numerics, direction, Vector::UnitZ());
}

/// The force along the floor at which a prism on `corners` points starts to slide, over mu m g, less 1.
template <class Law>
double start_of_sliding(int corners, int floor, double direction, const Numerics& numerics) {
  const double friction = 0.5, size = 0.1, h = numerics.step(size);
  auto [world, weight] = prism_on<Law>(size, corners, floor, numerics);
  const auto body = world.grain(0);
  for (int k = 0; k < int(4 / numerics.share); ++k) world.step(h);
  constexpr int steps = 20;
  for (double load = 0.99; load < 1.01; load += 1e-4) {
    world.set_force(body,
                    load * friction * weight * Vector(std::cos(direction), std::sin(direction), 0));
    for (int k = 0; k < steps; ++k) world.step(h);
    // The load 1 + 1e-4 gives 1e-4 mu g h in each step.
    if (world.velocity(body).template head<2>().norm() > 0.6e-4 * steps * friction * gravity * h)
      return load - 1;
  }
  return std::numeric_limits<double>::infinity();
}

/// A variant of a case: its size and two parameters.
struct Variant {
  double size, a, b;
};

std::string text(const char* format, double a, double b = 0) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, a, b);
  return buffer.data();
}

/// Creep of all variants of a case; one row for each step and criterion.
template <class Law, class Case>
void creeps(Session& session, const std::string& name, const std::string& published,
            const std::vector<Variant>& variants, const Case& one, std::vector<Numbers>& table) {
  for (const bool tight : {false, true})
    for (const double share : session.quick() ? Numbers{1e-2} : Numbers{1e-2, 1e-3}) {
      const Numerics numerics{share, tight};
      Row row;
      row.figure =
          name + ": largest creep over g h, " + std::to_string(variants.size()) + " variants";
      row.published = published;
      row.law = name_of<Law>();
      row.tolerance = tight ? 1e-12 : 1e-4;
      row.grains = name == "stack on an incline" ? 2 : 1;
      row.samples = variants.size();
      row.step = numerics.step(variants.front().size);
      Stay worst;
      for (const Variant& v : variants) {
        const Result result = session.once(
            "stay, " + name + ' ' + row.law + text(" %g", v.size) + text(" %g %g", v.a, v.b) +
                text(" share %g tolerance %g", share, row.tolerance),
            [&](Run&) {
              const Stay stays = one(v, numerics);
              return Numbers{stays.creep, stays.lift, stays.unsolved};
            });
        const Numbers& of = result.values;
        row.seconds += result.seconds;
        worst.creep = std::max(worst.creep, of[0]);
        worst.lift = std::max(worst.lift, of[1]);
        worst.unsolved = std::max(worst.unsolved, of[2]);
        table.push_back({double(std::is_same_v<Law, Springs>), v.size, v.a, v.b, share,
                         row.tolerance, of[0], of[1], of[2]});
      }
      row.measured = worst.creep;
      row.verdict = row.measured < (tight ? 1e-6 : 1e-3) ? "yes" : "no";
      session.row(row);
      if (name != "grip") {  // pads and capsule are free along their normal
        row.published = "0";
        row.figure = name + ": largest lift over the size";
        row.measured = worst.lift;
        row.verdict = worst.lift <= 1e-9 ? "yes" : "no";
        session.row(row);
      }
      row.published = "–";
      row.figure = name + ": steps not solved, largest share";
      row.measured = worst.unsolved;
      row.verdict = "";
      session.row(row);
    }
}

template <class Law>
void all_creeps(Session& session, std::vector<Numbers>& table) {
  const std::vector<Variant> sizes{{0.1, 1, 0}, {1e-6, 1, 0}, {10, 1, 0}};
  creeps<Law>(
      session, "held cube", "0; another engine: 4.5 mm/s", sizes,
      [](const Variant& v, const Numerics& n) { return held<Law>(v.size, v.a, n); }, table);
  std::vector<Variant> ratios = sizes;
  for (const double size : {0.1, 1e-6, 10.0})
    for (const double ratio : {1e-3, 1e3}) ratios.push_back({size, ratio, 0});
  creeps<Law>(
      session, "stack on an incline", "0", ratios,
      [](const Variant& v, const Numerics& n) { return stack<Law>(v.size, v.a, n); }, table);
  std::vector<Variant> grips;
  for (const double force : {12.0, 60.0})
    for (const double ratio : {1.0, 1e-3, 1e3}) grips.push_back({0.008, force, ratio});
  for (const double size : {1e-6, 10.0})
    for (const double ratio : {1.0, 1e-3, 1e3})
      grips.push_back({size, 12 * std::pow(size / 0.008, 3), ratio});
  creeps<Law>(
      session, "grip", "0; another engine: 50 to 2300 um/s", grips,
      [](const Variant& v, const Numerics& n) { return grip<Law>(v.size, v.a, v.b, n); }, table);
  std::vector<Variant> prisms;
  for (const double size : {0.1, 1e-6, 10.0})
    for (const double corners : {3, 4, 8})
      for (const double floor : {0, 1, 2}) prisms.push_back({size, corners, floor});
  creeps<Law>(
      session, "prism on points, pushed by 0.9 μ m g", "0", prisms,
      [](const Variant& v, const Numerics& n) {
        return pushed<Law>(v.size, int(v.a), int(v.b), n);
      },
      table);
}

/// The held cube with the step of the report, 10 ms.
template <class Law>
void held_as_reported(Session& session) {
  constexpr double size = 0.1, h = 0.01;
  const Numerics numerics{h / std::sqrt(size / gravity), false};
  Row row;
  row.figure = "held cube, 0.1 m, step of the report: creep [mm/s]";
  row.published = "0; another engine: 4.5";
  row.law = name_of<Law>();
  row.step = h;
  row.tolerance = 1e-4;
  row.grains = 1;
  const Result result = session.once("held as reported " + row.law, [&](Run&) {
    return Numbers{1000 * gravity * h * held<Law>(size, 1, numerics).creep};
  });
  row.seconds = result.seconds;
  row.measured = result.values[0];
  session.row(row);
}

template <class Law>
void launches(Session& session) {
  for (const double share : session.quick() ? Numbers{1e-2} : Numbers{1e-2, 1e-3})
    for (const bool tight : {false, true}) {
      const Numerics numerics{share, tight};
      Row row;
      row.law = name_of<Law>();
      row.tolerance = tight ? 1e-12 : 1e-4;
      row.step = numerics.step(0.1);
      row.grains = 1;
      Launch worst;
      row.samples = 0;
      for (const double size : {0.1, 1e-6, 10.0})
        for (const int floor : {0, 1, 2}) {
          const Result result =
              session.once("launched " + row.law + text(" %g floor %g", size, floor) +
                               text(" share %g tolerance %g", share, row.tolerance),
                           [&](Run&) {
                             const Launch launch = launched<Law>(size, floor, numerics);
                             return Numbers{launch.distance, launch.lift, launch.tilt};
                           });
          row.seconds += result.seconds;
          ++row.samples;
          worst.distance = std::max(worst.distance, std::abs(result.values[0]));
          worst.lift = std::max(worst.lift, result.values[1]);
          worst.tilt = std::max(worst.tilt, result.values[2]);
        }
      row.figure = "launched cube: largest error of the path, over v²/(2 μ g)";
      row.published = "0, required 1e-3";
      row.measured = worst.distance;
      row.verdict = worst.distance <= 1e-3 ? "yes" : "no";
      session.row(row);
      row.figure = "launched cube: largest lift over its edge";
      row.published = "0; another engine: 3.18";
      row.measured = worst.lift;
      row.verdict = worst.lift <= 1e-9 ? "yes" : "no";
      session.row(row);
      row.figure = "launched cube: largest tilt [rad]";
      row.published = "0";
      row.measured = worst.tilt;
      // Springs that give by 1e-6 of the edge under the weight tilt the cube by some 1e-6.
      row.verdict = worst.tilt <= (std::is_same_v<Law, Rigid> ? 1e-9 : 5e-6) ? "yes" : "no";
      session.row(row);
    }
}

template <class Law>
void starts(Session& session) {
  for (const int corners : {3, 4, 8}) {
    const Numerics numerics{1e-2, true};
    Row row;
    row.figure = "prism on " + std::to_string(corners) +
                 " points: force at the start of sliding over μ m g, less 1, largest of three "
                 "floors and three directions";
    row.published = "0; another engine divided it by the points";
    row.law = name_of<Law>();
    row.tolerance = 1e-12;
    row.step = numerics.step(0.1);
    row.grains = 1;
    row.samples = 0;
    row.measured = 0;
    for (const int floor : {0, 1, 2})
      for (const double direction : session.quick() ? Numbers{0.3} : Numbers{0, 0.7, 1.3}) {
        const Result result = session.once(
            "start " + row.law + text(" corners %g floor %g", corners, floor) +
                text(" direction %g", direction),
            [&](Run&) {
              return Numbers{start_of_sliding<Law>(corners, floor, direction, numerics)};
            });
        row.seconds += result.seconds;
        ++row.samples;
        row.measured = std::max(row.measured, std::abs(result.values[0]));
      }
    // The load rises in steps of 1e-4.
    row.verdict = row.measured <= 2.1e-4 ? "yes" : "no";
    session.row(row);
  }
}

}  // namespace sticking_parts

void sticking(Session& session) {
  using namespace sticking_parts;
  std::vector<Numbers> table;
  all_creeps<Rigid>(session, table);
  all_creeps<Springs>(session, table);
  session.curve("sticking",
                {"springs", "size [m]", "a", "b", "step over sqrt(L/g)", "tolerance",
                 "creep over g h", "lift over the size", "steps not solved, share"},
                table);
  held_as_reported<Rigid>(session);
  held_as_reported<Springs>(session);
  launches<Rigid>(session);
  launches<Springs>(session);
  starts<Rigid>(session);
  starts<Springs>(session);
}

}  // namespace experiments
