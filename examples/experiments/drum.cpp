// SPDX-License-Identifier: MIT
// The rotating drum of Dosta et al. 2024: 30,000 balls of material M1, r = 1 mm, above 8,000 of M2, r = 2 mm,
// from the published initial state. Observable: number of M1 with x < 0 and z < 0.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "moreau/sample/spatial_order.hpp"

#include "bulk.hpp"
#include "session.hpp"

namespace experiments {

namespace drum_parts {

using namespace bulk;

constexpr double radius = 0.1, half_depth = 0.03, rate = -2;  // [m], [rad/s] about +y

struct Start {
  bool small;
  Vector position;
};

/// The published initial state, which `xz` unpacks.
std::vector<Start> initial_state() {
  const std::string command = "xz -dc '" + data_path("drum_positions.txt.xz") + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::vector<Start> all;
  int type = 0;
  double x = 0, y = 0, z = 0;
  while (pipe && std::fscanf(pipe.get(), "%d %lf %lf %lf", &type, &x, &y, &z) == 4)
    all.push_back({type == 1, {x, y, z}});
  if (all.size() != 38000) throw std::runtime_error("drum_positions.txt.xz: xz is not installed");
  return all;
}

/// Order in which the balls are added. It decides on the order of the sweeps and with it on the rounding.
enum class Order { spatial, reversed, file };

/// @param depth half the depth of the drum [m]; if it is less than the published one, the balls of that slice
void build(World& world, double depth, Order order) {
  const auto small = world.add_shape(moreau::Ball<double>(0.001));
  const auto large = world.add_shape(moreau::Ball<double>(0.002));
  // The file has the balls in a random order: a step takes less time if neighbours follow one another.
  const std::vector<Start> balls = initial_state();
  std::vector<Vector> positions;
  for (const Start& ball : balls) positions.push_back(ball.position);
  std::vector<std::size_t> numbers(balls.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t(0));
  if (order != Order::file) numbers = moreau::spatial_order<moreau::Space<3>>(positions);
  if (order == Order::reversed) std::reverse(numbers.begin(), numbers.end());
  for (const std::size_t k : numbers) {
    const Start& ball = balls[k];
    const double r = ball.small ? 0.001 : 0.002;
    if (std::abs(ball.position[1]) > depth - r && depth < half_depth) continue;
    if (ball.small)
      world.add_grain(small, {ball.position}, density_m1, m1);
    else
      world.add_grain(large, {ball.position}, density_m2, m2);
  }
  const auto drum = world.add_cylinder({0, 0, 0}, Vector::UnitY(), radius, steel);
  world.set_spin(drum, rate * Vector::UnitY());
  for (const double side : {-1.0, 1.0}) {
    const auto cap = world.add_wall(-side * Vector::UnitY(), side * depth * Vector::UnitY(), steel);
    world.set_spin(cap, rate * Vector::UnitY());
  }
}

double in_quadrant(const World& world) {
  double count = 0;
  for (const moreau::BodyId grain : world.grains()) {
    const Vector& x = world.pose(grain).position;
    count += world.bodies().material[grain.index()] == m1 && x[0] < 0 && x[2] < 0;
  }
  return count;
}

/// Time and value of an extremum, by a parabola through three samples.
struct Extremum {
  double time = 0, value = 0;
};
Extremum extremum_near(const Numbers& counts, double interval, double time, double window,
                       bool maximum) {
  const double sign = maximum ? 1 : -1;
  const auto from = std::size_t(std::max(1.0, (time - window) / interval));
  const auto to = std::min(counts.size() - 2, std::size_t((time + window) / interval));
  std::size_t best = from;
  for (std::size_t k = from; k <= to; ++k)
    if (sign * counts[k] > sign * counts[best]) best = k;
  const double a = counts[best - 1], b = counts[best], c = counts[best + 1];
  const double bend = a - 2 * b + c, shift = bend != 0 ? (a - c) / (2 * bend) : 0;
  return {(double(best) + shift) * interval, b - (a - c) * shift / 4};
}

/// Rows of the comparison with the published counts, every `interval`.
/// @param order of the balls, for the names of the rows
void compare(Session& session, Row row, Numbers counts, double interval,
             const std::vector<Numbers>& published, const std::string& order) {
  counts.resize(std::min(counts.size(), published.size()));  // the published ones end at 4.9 s
  Numbers liggghts, musen;
  for (std::size_t k = 1; k < counts.size(); ++k) {  // LIGGGHTS' first sample is at 0.1 s
    liggghts.push_back(published[k][1]);
    musen.push_back(published[k][2]);
  }
  const Numbers own(counts.begin() + 1, counts.end());
  const double between = difference(liggghts, musen).mean_square;
  const auto text = [](const char* format, double number) {
    std::array<char, 64> written{};
    std::snprintf(written.data(), written.size(), format, number);
    return std::string(written.data());
  };
  const std::string until =
      text("M1 in the quadrant until %.1f s: ", double(counts.size() - 1) * interval);
  for (const auto& [name, theirs] : {std::pair{"LIGGGHTS", &liggghts}, {"MUSEN", &musen}}) {
    row.figure = until + "root mean square difference to " + name + order;
    row.published = text("LIGGGHTS to MUSEN: %.0f", between);
    row.measured = difference(own, *theirs).mean_square;
    row.verdict = row.measured <= 2 * between ? "yes" : "no";
    session.row(row);
  }
  struct Turn {
    double time;
    bool maximum;
  };
  Numbers all_liggghts{15047};  // the state at the start
  all_liggghts.insert(all_liggghts.end(), liggghts.begin(), liggghts.end());
  double before = 15047;  // of LIGGGHTS, at the extremum before
  for (const Turn& turn :
       {Turn{0.3, false}, {0.6, true}, {1.6, false}, {2.5, true}, {3.4, false}, {4.4, true}}) {
    if (turn.time + 0.2 > double(counts.size() - 1) * interval) continue;
    const Extremum theirs = extremum_near(all_liggghts, interval, turn.time, 0.3, turn.maximum);
    const Extremum ours = extremum_near(counts, interval, turn.time, 0.3, turn.maximum);
    const std::string kind = turn.maximum ? "maximum" : "minimum";
    row.figure = "time of the " + kind + text(" near %.1f s [s]", turn.time) + order;
    row.published = text("%.2f (LIGGGHTS)", theirs.time);
    row.measured = ours.time;
    row.verdict = std::abs(ours.time - theirs.time) <= 0.05 ? "yes" : "no";
    session.row(row);
    row.figure = "number at this " + kind + order;
    row.published = text("%.0f (LIGGGHTS)", theirs.value);
    row.measured = ours.value;
    // Within 10 % of the swing from the extremum before: a minimum of 2 has no 10 % of its own.
    row.verdict =
        std::abs(ours.value - theirs.value) <= 0.1 * std::abs(theirs.value - before) ? "yes" : "no";
    before = theirs.value;
    session.row(row);
  }
}

/// A run with its step and criterion. A run that is stopped has the curve so far.
struct Case {
  Numerics numerics;
  double until;       ///< [s]
  double depth;       ///< half the depth of the drum [m]
  const char* curve;  ///< name of the file
  Order order = Order::spatial;
};

void run(Session& session, const Case& c, double interval, const std::vector<Numbers>& published) {
  const bool whole = c.depth >= half_depth;
  const std::string part =
      whole ? "whole drum" : "slice of " + std::to_string(int(std::lround(2000 * c.depth))) + " mm";
  const std::string order = c.order == Order::spatial    ? ""
                            : c.order == Order::reversed ? ", reversed order"
                                                         : ", order of the file";
  const std::string key = c.numerics.text() + (whole ? "" : ' ' + part) + order;
  if (!session.wants(part + order) && !session.wants(key)) return;
  Row row;
  row.law = "SignoriniCoulomb";
  row.step = c.numerics.step;
  row.tolerance = c.numerics.tolerance;
  Numbers counts;
  std::size_t balls = 0;
  const auto show = [&] {
    std::vector<Numbers> rows;
    for (std::size_t k = 0; k < counts.size(); ++k)
      rows.push_back({double(k) * interval, counts[k]});
    session.curve(c.curve, {"t [s]", "moreau"}, rows);
    if (whole && counts.size() > 3) compare(session, row, counts, interval, published, order);
  };
  Result result;
  try {
    result = session.once(key, [&](Run& run) {
      World world = world_of(0.002, c.numerics, session.options().threads);
      const Sums sums = advance(
          run, world, c.numerics, c.until, interval, counts,
          [&](World& empty) { build(empty, c.depth, c.order); }, in_quadrant);
      balls = world.grain_count();
      Numbers values = counts;
      sums.append_to(values);
      values.push_back(double(balls));
      return values;
    });
  } catch (const Paused&) {
    show();
    throw;
  }
  const Numbers& v = result.values;
  const std::size_t n = v.size() - 6;
  counts.assign(v.begin(), v.begin() + std::ptrdiff_t(n));
  row.grains = std::size_t(v[n + 5]);
  row.seconds = result.seconds;
  row.published = "–";
  const std::string of = whole ? order : ", " + key;
  row.figure = "steps not solved, share" + of;
  row.measured = v[n + 1] / v[n];
  session.row(row);
  row.figure = "milliseconds of CPU time per step" + of;
  row.measured = 1000 * v[n + 4] / v[n];
  session.row(row);
  row.figure = "largest overlap over the small diameter" + of;
  row.measured = v[n + 3] / 0.002;
  session.row(row);
  show();
}

/// Volume of the balls whose centres lie in a box away from walls and surface, over the volume of the box; then the mean
/// height of the centres [m].
std::array<double, 2> density(const World& world) {
  constexpr double x = 0.03, y = 0.02, bottom = -0.08, top = -0.03;  // [m]
  double solid = 0, height = 0;
  for (const moreau::BodyId grain : world.grains()) {
    const Vector& p = world.pose(grain).position;
    const double r = world.bodies().material[grain.index()] == m1 ? 0.001 : 0.002;
    height += p[2] / double(world.grain_count());
    if (std::abs(p[0]) < x && std::abs(p[1]) < y && p[2] > bottom && p[2] < top)
      solid += 4. / 3 * std::numbers::pi * r * r * r;
  }
  return {solid / (4 * x * y * (top - bottom)), height};
}

/// The published initial state in a drum that does not turn: is it at rest?
void stand(Session& session, const Numerics& numerics, double until) {
  constexpr double interval = 0.01;
  if (!session.wants("at rest")) return;
  const Result result = session.once("drum at rest, " + numerics.text(), [&](Run& run) {
    World world = world_of(0.002, numerics, session.options().threads);
    Numbers log;
    const Sums sums = advance(
        run, world, numerics, until, interval, log,
        [&](World& empty) {
          build(empty, half_depth, Order::spatial);
          for (const moreau::BodyId wall : empty.walls()) empty.set_spin(wall, Vector::Zero());
        },
        [](const World& now) { return density(now); });
    sums.append_to(log);
    return log;
  });
  const Numbers& v = result.values;
  const std::size_t n = (v.size() - 5) / 2;
  std::vector<Numbers> rows;
  for (std::size_t k = 0; k < n; ++k)
    rows.push_back({1000 * interval * double(k), v[2 * k], 1000 * v[2 * k + 1]});
  session.curve("drum_at_rest", {"t [ms]", "solid fraction", "mean height [mm]"}, rows);
  Row row;
  row.published = "–";
  row.law = "SignoriniCoulomb";
  row.step = numerics.step;
  row.tolerance = numerics.tolerance;
  row.grains = 38000;
  row.seconds = result.seconds;
  const auto add = [&](const std::string& figure, double value) {
    row.figure = figure;
    row.measured = value;
    session.row(row);
  };
  add("initial state without rotation: solid fraction in the middle, at the start", rows[0][1]);
  const std::string end = std::to_string(std::lround(1000 * until)) + " ms";
  add("the same after " + end, rows.back()[1]);
  add("initial state without rotation: mean height of the balls lost in " + end + " [mm]",
      rows[0][2] - rows.back()[2]);
  add("initial state without rotation: steps not solved", v[2 * n + 1]);
}

}  // namespace drum_parts

void drum(Session& session) {
  using namespace drum_parts;
  const std::vector<Numbers> published = read_data("drum_zone2_M1.csv");
  constexpr double interval = 0.1, often = 0.02, slice = 0.004;
  // The step is 1 ms, in which the drum turns by 0.2 mm. Controls of the step and of the rounding: a thin slice.
  const Numerics numerics{1e-3, 3e-3, 0.15, 500, 8};
  Numerics half = numerics, quarter = numerics;
  half.step /= 2;
  quarter.step /= 4;
  if (session.quick()) {
    run(session, {numerics, 0.2, slice, "drum_slice"}, interval, published);
    return;
  }
  stand(session, numerics, 0.1);
  run(session, {numerics, 5, slice, "drum_slice_1ms"}, often, published);
  run(session, {half, 5, slice, "drum_slice_half_ms"}, often, published);
  run(session, {numerics, 5, slice, "drum_slice_1ms_reversed", Order::reversed}, often, published);
  run(session, {numerics, 5, slice, "drum_slice_1ms_file", Order::file}, often, published);
  run(session, {half, 5, slice, "drum_slice_half_ms_reversed", Order::reversed}, often, published);
  run(session, {quarter, 5, slice, "drum_slice_quarter_ms"}, often, published);
  run(session, {numerics, 5, half_depth, "drum"}, interval, published);
  run(session, {numerics, 5, half_depth, "drum_reversed", Order::reversed}, interval, published);
}

}  // namespace experiments
