// SPDX-License-Identifier: MIT
// The impact of Dosta et al. 2024: a steel ball, d = 20 mm, falls with 5 m/s into a settled bed of M1 balls, d = 2 mm,
// in a steel box. Observable: its height over 0.1 s. The published beds were not to be had: beds are made here,
// by random deposition and settling.
#include <array>
#include <cstdio>

#include "moreau/sample/random_deposition.hpp"

#include "bulk.hpp"
#include "session.hpp"

namespace experiments {

namespace impact_parts {

using namespace bulk;
using S = moreau::Space<3>;

constexpr double length = 0.1, width = 0.06, floor_height = -0.0902431;  // [m]
constexpr double diameter = 0.002, impactor = 0.02, speed = 5;           // [m], [m/s]
constexpr double settling = 0.25;                                        // [s]

void add_box(World& world) {
  const Vector corner(length / 2, width / 2, 0);
  for (int axis : {0, 1})
    for (const double side : {-1.0, 1.0})
      world.add_wall(-side * Vector::Unit(axis), side * corner[axis] * Vector::Unit(axis), steel);
  world.add_wall(Vector::UnitZ(), floor_height * Vector::UnitZ(), steel);
}

void add_bed(World& world, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<double> radii(count, diameter / 2);
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  for (moreau::Pose<S> pose :
       moreau::random_deposition<S>(radii, std::array<double, 2>{length, width}, random)) {
    pose.position += Vector(-length / 2, -width / 2, floor_height);
    world.add_grain(shape, pose, density_m1, m1);
  }
  add_box(world);
}

/// Positions of a settled bed.
Numbers settled_bed(Run& run, std::size_t count, std::uint64_t seed, int threads, double duration) {
  const Numerics numerics{2e-4, 1e-2, 0.2};
  World world = world_of(diameter, numerics, threads);
  Numbers log;
  const Sums sums = advance(
      run, world, numerics, duration, duration, log,
      [&](World& empty) { add_bed(empty, count, seed); }, mean_speed);
  Numbers state;
  for (const moreau::BodyId grain : world.grains())
    for (const double x : world.pose(grain).position) state.push_back(x);
  state.push_back(mean_speed(world));
  state.push_back(1000 * sums.stepping / sums.steps);
  return state;
}

void build_impact(World& world, const Numbers& bed) {
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  for (std::size_t k = 0; k + 3 < bed.size(); k += 3)
    world.add_grain(shape, {Vector(bed[k], bed[k + 1], bed[k + 2])}, density_m1, m1);
  const auto ball = world.add_grain(world.add_shape(moreau::Ball<double>(impactor / 2)),
                                    {Vector(0, 0, 0.06)}, density_steel, steel);
  world.set_velocity(ball, {0, 0, -speed});
  add_box(world);
}
double height(const World& world) {
  return world.pose(world.grain(world.grain_count() - 1)).position[2];
}

struct Case {
  std::size_t balls;
  std::vector<std::uint64_t> seeds;
  const char* file;  // of the published curves
  Numerics numerics;
};

struct Outcome {
  Numbers z;  // every millisecond
  double seconds, ms, unsolved, overlap;
};
Outcome one_impact(Session& session, const Case& c, std::uint64_t seed, double until) {
  const int threads = session.options().threads;
  const std::string name = std::to_string(c.balls) + " balls, bed " + std::to_string(seed);
  const double duration = session.quick() ? 0.02 : settling;
  const Result bed = session.once(name + ", settling", [&](Run& run) {
    return settled_bed(run, c.balls, seed, threads, duration);
  });
  const Result result = session.once(name + ", impact " + c.numerics.text(), [&](Run& run) {
    World world = world_of(diameter, c.numerics, threads);
    Numbers z;
    const Sums sums = advance(
        run, world, c.numerics, until, 1e-3, z,
        [&](World& empty) { build_impact(empty, bed.values); }, height);
    sums.append_to(z);
    return z;
  });
  const Numbers& v = result.values;
  const std::size_t n = v.size() - 5;
  return {Numbers(v.begin(), v.end() - 5), result.seconds, 1000 * v[n + 4] / v[n], v[n + 1] / v[n],
          v[n + 3]};
}

void compare(Session& session, const Case& c, const std::vector<Outcome>& outcomes) {
  const std::vector<Numbers> published = read_data(c.file);
  Numbers mean;
  std::vector<Numbers> rows;
  Row row;
  row.law = "SignoriniCoulomb";
  row.step = c.numerics.step;
  row.tolerance = c.numerics.tolerance;
  row.grains = c.balls + 1;
  row.samples = outcomes.size();
  for (const Outcome& one : outcomes) row.seconds += one.seconds;
  for (std::size_t k = 0; k < outcomes[0].z.size(); ++k) {
    Numbers line{double(k)};
    Numbers samples;
    for (const Outcome& one : outcomes) samples.push_back(one.z[k]);
    mean.push_back(mean_of(samples).value);
    line.push_back(mean.back());
    line.insert(line.end(), samples.begin(), samples.end());
    rows.push_back(line);
  }
  std::vector<std::string> heads{"t [ms]", "mean [m]"};
  for (std::size_t k = 0; k < outcomes.size(); ++k) heads.push_back("bed " + std::to_string(k + 1));
  session.curve("impact_" + std::to_string(c.balls / 1000) + "k", heads, rows);
  const std::string bed = std::to_string(c.balls) + " balls: ";
  Numbers per_step, unsolved;
  for (const Outcome& one : outcomes) per_step.push_back(one.ms), unsolved.push_back(one.unsolved);
  row.published = "–";
  row.figure = bed + "milliseconds per step";
  row.measured = mean_of(per_step).value;
  session.row(row);
  row.figure = bed + "steps not solved, share";
  row.measured = mean_of(unsolved).value;
  session.row(row);
  for (const std::size_t code : {std::size_t(1), std::size_t(2)}) {
    Numbers theirs, largest;
    for (const Numbers& line : published) theirs.push_back(line[code]);
    // LIGGGHTS' curve is 0.05 ms ahead.
    if (code == 1)
      for (std::size_t k = 0; k + 1 < theirs.size(); ++k)
        theirs[k] -= 0.05 * (theirs[k + 1] - theirs[k]);
    for (const Outcome& one : outcomes) largest.push_back(1000 * difference(one.z, theirs).largest);
    row.figure = bed + "largest difference of a bed's curve to " +
                 (code == 1 ? "LIGGGHTS" : "MUSEN") + " [mm]";
    row.published = "3, required";
    row.measured = mean_of(largest).value;
    row.error = mean_of(largest).error;
    row.verdict = c.balls < 100000 ? "not compared" : row.measured <= 3 ? "yes" : "no";
    session.row(row);
    row.figure = bed + "difference of the mean curve to " + (code == 1 ? "LIGGGHTS" : "MUSEN") +
                 ", root mean square [mm]";
    row.published = "–";
    row.measured = 1000 * difference(mean, theirs).mean_square;
    row.error = std::numeric_limits<double>::quiet_NaN();
    row.verdict = "";
    session.row(row);
  }
  if (c.balls >= 100000) return;
  // The lowest point of the ball, and how high it is at the end.
  Numbers lowest, end;
  for (const Outcome& one : outcomes) {
    lowest.push_back(1000 * *std::min_element(one.z.begin(), one.z.end()));
    end.push_back(1000 * one.z.back());
  }
  std::array<double, 2> low{0, 0};
  for (const Numbers& line : published)
    for (const std::size_t code : {std::size_t(0), std::size_t(1)})
      low[code] = std::min(low[code], 1000 * line[code + 1]);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.1f (LIGGGHTS), %.1f (MUSEN)", low[0], low[1]);
  row.figure = bed + "lowest height of the ball [mm]";
  row.published = text.data();
  row.measured = mean_of(lowest).value;
  row.error = mean_of(lowest).error;
  row.verdict = "";
  session.row(row);
  std::snprintf(text.data(), text.size(), "%.1f (LIGGGHTS), %.1f (MUSEN)",
                1000 * published.back()[1], 1000 * published.back()[2]);
  row.figure = bed + "height at the end [mm]";
  row.published = text.data();
  row.measured = mean_of(end).value;
  row.error = mean_of(end).error;
  session.row(row);
}

}  // namespace impact_parts

void impact(Session& session) {
  using namespace impact_parts;
  const Numerics numerics{5e-5, 1e-3, 0.2};
  std::vector<Case> cases{{25000, {1, 2, 3}, "impact_25k.csv", numerics},
                          {100000, {1}, "impact_100k.csv", numerics}};
  if (session.quick()) {
    one_impact(session, {1000, {1}, "", numerics}, 1, 0.01);
    return;
  }
  bool complete = true;
  for (const Case& one : cases) {
    std::vector<Outcome> outcomes;
    try {
      for (const std::uint64_t seed : one.seeds)
        outcomes.push_back(one_impact(session, one, seed, 0.1));
    } catch (const Paused&) {
      complete = false;
    }
    if (!outcomes.empty()) compare(session, one, outcomes);
    if (!complete) throw Paused();
  }
}

}  // namespace experiments
