// SPDX-License-Identifier: MIT
// The rotating drum of Dosta et al. 2024: 30,000 balls of material M1, r = 1 mm, above 8,000 of M2, r = 2 mm,
// from the published initial state. Observable: number of M1 with x < 0 and z < 0.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

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

/// @param depth half the depth of the drum [m]; if it is less than the published one, the balls of that slice
void build(World& world, double depth) {
  const auto small = world.add_shape(moreau::Ball<double>(0.001));
  const auto large = world.add_shape(moreau::Ball<double>(0.002));
  for (const Start& ball : initial_state()) {
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

}  // namespace drum_parts

void drum(Session& session) {
  using namespace drum_parts;
  const bool quick = session.quick();
  const double depth = quick ? 0.004 : half_depth, interval = 0.1;
  const double until = quick ? 0.2 : 5;
  const std::vector<Numbers> published = read_data("drum_zone2_M1.csv");
  struct Case {
    Numerics numerics;
    double until;
  };
  std::vector<Case> cases{{{2e-4, 1e-3, 0.1}, until}};
  for (const Case& one : cases) {
    Numerics numerics = one.numerics;
    const Result result = session.once(numerics.text(), [&](Run& run) {
      World world = world_of(0.002, numerics, session.options().threads);
      Numbers counts;
      const Sums sums = advance(
          run, world, numerics, one.until, interval, counts,
          [&](World& empty) { build(empty, depth); }, in_quadrant);
      sums.append_to(counts);
      return counts;
    });
    const Numbers counts(result.values.begin(), result.values.end() - 5);
    std::vector<Numbers> rows;
    Numbers liggghts, musen;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const Numbers& line = published[std::min(k, published.size() - 1)];
      rows.push_back({double(k) * interval, counts[k]});
      if (k == 0) continue;  // LIGGGHTS' first sample is at 0.1 s
      liggghts.push_back(line[1]);
      musen.push_back(line[2]);
    }
    session.curve("drum", {"t [s]", "moreau"}, rows);
    Row row;
    row.law = "SignoriniCoulomb";
    row.step = numerics.step;
    row.tolerance = numerics.tolerance;
    row.grains = quick ? 0 : 38000;
    row.seconds = result.seconds;
    const auto steps = result.values[counts.size()];
    row.figure = "steps not solved, share";
    row.published = "–";
    row.measured = result.values[counts.size() + 1] / steps;
    session.row(row);
    row.figure = "milliseconds per step";
    row.measured = 1000 * result.values[counts.size() + 4] / steps;
    session.row(row);
    row.figure = "largest overlap over the small diameter";
    row.measured = result.values[counts.size() + 3] / 0.002;
    session.row(row);
    if (quick) continue;
    const Numbers own(counts.begin() + 1, counts.end());
    const double between = difference(liggghts, musen).mean_square;
    row.figure = "M1 in the quadrant: root mean square difference to LIGGGHTS";
    row.published = "LIGGGHTS to MUSEN: " + std::to_string(int(std::lround(between)));
    row.measured = difference(own, liggghts).mean_square;
    row.verdict = row.measured <= 2 * between ? "yes" : "no";
    session.row(row);
    row.figure = "the same to MUSEN";
    row.measured = difference(own, musen).mean_square;
    row.verdict = row.measured <= 2 * between ? "yes" : "no";
    session.row(row);
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
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), "%.2f (LIGGGHTS)", theirs.time);
      row.figure =
          "time of the " + kind + " near " + std::to_string(turn.time).substr(0, 3) + " s [s]";
      row.published = text.data();
      row.measured = ours.time;
      row.verdict = std::abs(ours.time - theirs.time) <= 0.05 ? "yes" : "no";
      session.row(row);
      std::snprintf(text.data(), text.size(), "%.0f (LIGGGHTS)", theirs.value);
      row.figure = "number at this " + kind;
      row.published = text.data();
      row.measured = ours.value;
      // Within 10 % of the swing from the extremum before: a minimum of 2 has no 10 % of its own.
      row.verdict = std::abs(ours.value - theirs.value) <= 0.1 * std::abs(theirs.value - before)
                        ? "yes"
                        : "no";
      before = theirs.value;
      session.row(row);
    }
  }
}

}  // namespace experiments
