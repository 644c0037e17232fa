// SPDX-License-Identifier: MIT
// Plastic dice, tetrahedra to icosahedra: solid fraction of the loosest and of the densest packing (J. Baker and A.
// Kudrolli, Phys. Rev. E 82 (2010) 061304), without walls.
//
// Procedure. Dice of equal volume, in a cell that is periodic along the two horizontal axes, above a floor: no side walls.
//   poured    they lie one above the other in a random deposition of their circumscribed balls, fall from there and come
//             to rest;
//   sediment  the same, but a drag in proportion to the velocity holds them at 0.1 m/s: what a die has of kinetic energy
//             then lifts it by a twentieth of its size;
//   damped    the same, but the drag resists the spin as well, as creeping flow does of a ball of equal volume: the couple
//             over the spin is 4/3 r^2 times the force over the velocity;
//   walled    poured, but between four side walls in place of the periodic axes, with the same friction;
//   slow      sediment, but held at 0.03 m/s, which lifts a die by a two-hundredth of its size;
//   rounded   sediment of dice whose edges are rounded with a tenth of their size, at equal volume;
//   slow rounded  both;
//   dense     the floor shakes the poured ones along the vertical for 4 s, with 25 Hz and an acceleration of 4 g at first,
//             which falls linearly to 0;
//   long      the same for 16 s;
//   smooth    poured and shaken for 4 s like dense, the edges rounded like those of rounded.
// The loosest packing was published for dice that were fluidized, the densest one for dice that were vibrated.
// The solid fraction is that of a slab from 2.5 sizes above the floor to 2.5 sizes below the highest centre. Friction
// between dice is not in the abstract: it is varied. The other kinds are controls.
// Friction 0 is a limit: poured and shaken dice only.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/clip.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/rounded.hpp"

#include "session.hpp"
#include "worlds.hpp"

namespace experiments {

namespace dice_parts {

using S = moreau::Space<3>;
using Vector = S::Vector;
using Shape = moreau::Polyhedron<double>;
using Rounded = moreau::Rounded<Shape>;
using Law = moreau::SignoriniCoulomb<double>;

template <class Shape>
using World = moreau::Simulation<Shape, Law>;

constexpr double size = 0.01, density = 1000;  // edge of a cube of equal volume [m], [kg/m^3]
constexpr double step = 2e-4, slow_step = 5e-4, tolerance = 1e-3, gravity = 9.81;

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

/// The same die with edges and corners of the radius of a tenth of its size, scaled to the same volume.
Rounded rounded(const Shape& die) {
  const Rounded unit(die, 0.1 * size);
  return unit.scaled(size / std::cbrt(unit.volume()));
}

/// @param die sharp. Of rounded dice, which lie with the same centres and axes, the volumes that the slab cuts are those
///            of sharp dice of equal volume.
template <class Shape>
double fraction(const World<Shape>& world, const dice_parts::Shape& die, double length) {
  double top = 0;
  for (const moreau::BodyId grain : world.grains())
    top = std::max(top, world.pose(grain).position[2]);
  const double bottom = world.pose(world.walls()[0]).position[2];
  const moreau::Aabb<S> slab(Vector(0, 0, bottom + 2.5 * size),
                             Vector(length, length, top - 2.5 * size));
  if constexpr (moreau::Polytope<Shape>) {
    return moreau::solid_fraction(world, slab);
  } else {
    // Across the periodic axes the slab is the whole cell: no images are needed.
    moreau::Aabb<S> layer = slab;
    layer.lower.head<2>().setConstant(-1e3);
    layer.upper.head<2>().setConstant(1e3);
    moreau::ClipWorkspace<S> workspace;
    double solid = 0;
    for (const moreau::BodyId grain : world.grains())
      solid += moreau::clipped_volume(die, world.pose(grain), layer, workspace);
    return solid / (length * length * (slab.upper[2] - slab.lower[2]));
  }
}

constexpr double rest = 0.3, terminal = 0.1,
                 slow_terminal = 0.03;  // [s], of the sediment [m/s]

/// How the dice arrive.
enum class Arrival {
  poured,
  sediment,
  damped,
  walled,
  slow,
  rounded,
  slow_rounded,
  poured_rounded
};

struct Sample {
  int faces;
  std::size_t count;
  double across, friction, shaking;  ///< side of the cell over `size`, [-], duration [s]
  std::uint64_t seed;

  double length() const { return across * size; }
};

/// @param walled bounded by walls in place of the periodic axes; the walls are added after the floor
template <class Shape>
World<Shape> empty_world(const Sample& sample, bool walled) {
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 500;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  World<Shape> world(size, moreau::Materials<Law>(1, Law(sample.friction)),
                     moreau::ColouredGaussSeidel(options), tolerances);
  if (!walled)
    for (const int axis : {0, 1}) world.set_periodic(axis, 0, sample.length());
  world.set_gravity({0, 0, -gravity});
  return world;
}

/// Force over the velocity [N s/m], couple over the spin [N m s], of a die.
struct Drag {
  double force = 0, couple = 0;
};

void resist(auto& world, const Drag& drag) {
  for (const moreau::BodyId grain : world.grains()) {
    if (drag.force > 0) world.set_force(grain, -drag.force * world.velocity(grain));
    if (drag.couple > 0) world.set_torque(grain, -drag.couple * world.spin(grain));
  }
}

/// Advances a packing, in pieces if the time of the runner is over.
/// @param build    fills an empty world
/// @param h        step [s]
/// @param velocity of the floor upwards at a time [m/s]
/// @returns solid fraction and share of steps not solved; then, for each die, position and rotation
template <class Shape>
Numbers advance_dice(Run& run, World<Shape> world, const Sample& sample, double duration, double h,
                     const Drag& drag, const auto& build, const auto& velocity) {
  Numbers sums{0, 0};  // steps, those not solved
  if (run.is_started())
    moreau::reload_snapshot(run.snapshot(), world, sums);
  else
    build(world);
  const double last = std::round(duration / h);
  while (sums[0] < last) {
    world.set_velocity(world.walls()[0], velocity(sums[0] * h) * Vector::UnitZ());
    resist(world, drag);
    sums[1] += !world.step(h).solve.converged;
    ++sums[0];
    run.progress(sums[0] / last);
    if (sums[0] == last || !(run.must_stop() || run.must_store())) continue;
    moreau::write_snapshot(run.snapshot(), world, sums);
    run.note_stored();
    if (run.must_stop()) throw Paused();
  }
  Numbers values{fraction(world, die(sample.faces), sample.length()), sums[1] / sums[0]};
  for (const moreau::BodyId grain : world.grains()) {
    const moreau::Pose<S>& pose = world.pose(grain);
    for (const double x : pose.position) values.push_back(x);
    for (const double x : pose.rotation.coeffs()) values.push_back(x);
  }
  return values;
}

template <class Shape>
Numbers loose(Run& run, const Sample& sample, Arrival arrival, const Shape& shape) {
  std::mt19937_64 random(sample.seed);
  const std::vector<double> radii(sample.count, moreau::circumradius(shape));
  const auto poses = moreau::random_deposition<S>(radii, sample.length(), random);
  double top = 0;
  for (const moreau::Pose<S>& pose : poses) top = std::max(top, pose.position[2]);
  const bool walled = arrival == Arrival::walled;
  const auto build = [&](World<Shape>& world) {
    const auto id = world.add_shape(shape);
    for (const moreau::Pose<S>& pose : poses) world.add_grain(id, pose, density);
    world.add_wall(Vector::UnitZ(), Vector::Zero());
    if (!walled) return;
    for (const int axis : {0, 1}) {
      world.add_wall(Vector::Unit(axis), Vector::Zero());
      world.add_wall(-Vector::Unit(axis), sample.length() * Vector::Unit(axis));
    }
  };
  const bool slowly = arrival != Arrival::poured && arrival != Arrival::poured_rounded && !walled;
  const double velocity =
      arrival == Arrival::slow || arrival == Arrival::slow_rounded ? slow_terminal : terminal;
  // The time in which the highest die falls to the floor, and rest.
  const double fall = slowly ? top / velocity : std::sqrt(2 * top / gravity);
  Drag drag;
  if (slowly) drag.force = density * size * size * size * gravity / velocity;
  const double r = size * std::cbrt(3 / (4 * std::numbers::pi));
  if (arrival == Arrival::damped) drag.couple = 4.0 / 3 * r * r * drag.force;
  return advance_dice(run, empty_world<Shape>(sample, walled), sample, fall + rest,
                      slowly ? slow_step : step, drag, build, [](double) { return 0.0; });
}

/// @param start what loose() has returned
template <class Shape>
Numbers dense(Run& run, const Sample& sample, const Numbers& start, const Shape& shape) {
  const auto build = [&](World<Shape>& world) {
    const auto id = world.add_shape(shape);
    for (std::size_t k = 2; k + 6 < start.size(); k += 7) {
      moreau::Pose<S> pose;
      pose.position = Vector(start[k], start[k + 1], start[k + 2]);
      pose.rotation.coeffs() << start[k + 3], start[k + 4], start[k + 5], start[k + 6];
      world.add_grain(id, pose, density);
    }
    world.add_wall(Vector::UnitZ(), Vector::Zero());
  };
  const double rate = 2 * std::numbers::pi * 25;
  const auto shaken = [&](double time) {
    const double share = std::max(0.0, 1 - time / sample.shaking);
    return share * 4 * gravity / rate * std::cos(rate * time);
  };
  Numbers values = advance_dice(run, empty_world<Shape>(sample, false), sample,
                                sample.shaking + rest, step, {}, build, shaken);
  values.resize(2);
  return values;
}

/// A kind of dice with the published solid fractions.
struct Die {
  int faces;
  const char* name;
  double loose, dense;
};

/// What is done with dice.
struct Kind {
  const char* key;     ///< in the name of the run
  const char* figure;  ///< in the table
  Arrival arrival;
  double shaking;  ///< after the arrival [s]
  double h;        ///< step [s]
  bool compared;   ///< the published value is of this procedure
  Numbers frictions;

  bool is_rounded() const {
    return arrival == Arrival::rounded || arrival == Arrival::slow_rounded ||
           arrival == Arrival::poured_rounded;
  }
};
const std::vector<Kind>& all_kinds() {  // the short runs first
  static const std::vector<Kind> kinds{
      {"poured", "poured", Arrival::poured, 0, step, false, {0.5, 0.2, 0, 1}},
      {"poured rounded",
       "poured, edges rounded",
       Arrival::poured_rounded,
       0,
       step,
       false,
       {0.5, 0.2, 0}},
      {"sediment", "loosest, as sediment", Arrival::sediment, 0, slow_step, true, {0.5, 0.2, 1}},
      {"damped", "sediment, spin resisted", Arrival::damped, 0, slow_step, false, {0.5}},
      {"walled", "poured between walls", Arrival::walled, 0, step, false, {0.5}},
      {"rounded", "sediment, edges rounded", Arrival::rounded, 0, slow_step, false, {0.5, 1}},
      {"slow", "sediment at 0.03 m/s", Arrival::slow, 0, slow_step, false, {0.5}},
      {"slow rounded",
       "sediment at 0.03 m/s, edges rounded",
       Arrival::slow_rounded,
       0,
       slow_step,
       false,
       {0.5, 1}},
      {"dense", "densest", Arrival::poured, 4, step, true, {0.5, 0.2, 0, 1}},
      {"smooth", "densest, edges rounded", Arrival::poured_rounded, 4, step, false, {0.5, 0.2, 0}},
      {"long", "densest, shaken for 16 s", Arrival::poured, 16, step, false, {0.5, 0.2}}};
  return kinds;
}

/// Solid fractions of the samples of one kind of dice, by the key of what is done with them.
struct Fractions {
  std::map<std::string, Numbers> samples;
  std::map<std::string, double> seconds;
};

using All = std::map<std::pair<double, int>, Fractions>;  // friction, faces

void report(Session& session, const std::vector<Die>& kinds, const Numbers& frictions,
            std::size_t count, const All& all) {
  std::vector<Numbers> rows;
  for (const double friction : frictions)
    for (const Die& one : kinds) {
      const auto found = all.find({friction, one.faces});
      if (found == all.end()) continue;
      Row row;
      row.law = "SignoriniCoulomb, friction " + std::to_string(friction).substr(0, 3);
      row.tolerance = tolerance;
      row.grains = count;
      const Fractions& f = found->second;
      const auto mean = [&](const char* key) {
        const auto samples = f.samples.find(key);
        return samples == f.samples.end() ? Mean{std::numeric_limits<double>::quiet_NaN()}
                                          : mean_of(samples->second);
      };
      for (const Kind& kind : all_kinds()) {
        if (!f.samples.contains(kind.key)) continue;
        const double published = kind.shaking > 0 ? one.dense : one.loose;
        row.figure = std::string(one.name) + ", " + kind.figure + ": solid fraction";
        row.published = std::to_string(published).substr(0, 4) + " ± 0.01";
        row.measured = mean(kind.key).value;
        row.error = mean(kind.key).error;
        row.samples = f.samples.at(kind.key).size();
        row.seconds = f.seconds.at(kind.key);
        row.step = kind.h;
        row.verdict = !kind.compared                               ? ""
                      : std::abs(row.measured - published) <= 0.02 ? "yes"
                                                                   : "no";
        session.row(row);
      }
      rows.push_back({double(one.faces), friction, mean("sediment").value, one.loose,
                      mean("dense").value, one.dense, mean("poured").value, mean("damped").value,
                      mean("walled").value, mean("slow").value, mean("rounded").value,
                      mean("poured rounded").value, mean("smooth").value, mean("long").value,
                      mean("slow rounded").value});
    }
  session.curve(
      "dice",
      {"faces", "friction", "sediment", "published loose", "dense", "published dense", "poured",
       "damped", "walled", "slow", "rounded", "poured rounded", "smooth", "long", "slow rounded"},
      rows);
}

}  // namespace dice_parts

void dice(Session& session) {
  using namespace dice_parts;
  const bool quick = session.quick();
  const std::size_t count = quick ? 150 : 400;
  const double across = quick ? 5 : 6;
  const std::vector<Die> kinds{{6, "cubes", 0.54, 0.67},
                               {4, "tetrahedra", 0.51, 0.64},
                               {8, "octahedra", 0.52, 0.64},
                               {12, "dodecahedra", 0.51, 0.63},
                               {20, "icosahedra", 0.50, 0.59}};
  const Numbers frictions = quick ? Numbers{0.4} : Numbers{0.5, 0.2, 0, 1};
  All all;
  bool paused = false;
  const auto run = [&](const Kind& kind, std::uint64_t seed) {
    for (const double friction : quick ? frictions : kind.frictions)
      for (const Die& one : kinds) {
        if (quick && one.faces != 6) continue;
        const Sample sample{one.faces, count, across, friction, quick ? 0.2 : kind.shaking, seed};
        const std::string name = std::string(one.name) + " friction " + std::to_string(friction) +
                                 " count " + std::to_string(count) + " seed " +
                                 std::to_string(seed) + ' ';
        if (!session.wants(name + kind.key)) continue;
        const auto with_shape = [&](const auto& call) {
          const Shape sharp = die(one.faces);
          return kind.is_rounded() ? call(rounded(sharp)) : call(sharp);
        };
        const std::string arrival =
            kind.shaking > 0 ? kind.is_rounded() ? "poured rounded" : "poured" : kind.key;
        Result result = session.once(name + arrival, [&](Run& piece) {
          return with_shape(
              [&](const auto& shape) { return loose(piece, sample, kind.arrival, shape); });
        });
        if (kind.shaking > 0) {
          const Result start = result;
          result = session.once(name + kind.key, [&](Run& piece) {
            return with_shape(
                [&](const auto& shape) { return dense(piece, sample, start.values, shape); });
          });
        }
        Fractions& fractions = all[{friction, one.faces}];
        fractions.samples[kind.key].push_back(result.values[0]);
        fractions.seconds[kind.key] += result.seconds;
      }
  };
  try {
    for (const Kind& kind : all_kinds()) {
      if (quick && (kind.h == slow_step || kind.is_rounded() || kind.shaking > 4)) continue;
      for (std::uint64_t seed = 1; seed <= (quick ? 1u : 3u); ++seed) run(kind, seed);
    }
  } catch (const Paused&) {
    paused = true;
  }
  report(session, kinds, frictions, count, all);
  if (paused) throw Paused();
}

}  // namespace experiments
