// SPDX-License-Identifier: MIT
// The impact of Dosta et al. 2024: a steel ball, d = 20 mm, falls with 5 m/s into a settled bed of M1 balls, d = 2 mm,
// in a steel box. Observable: its height over 0.1 s. The published beds were not to be had: beds are made here, the
// shallow ones by random deposition and settling, deeper ones of copies of a shallow one that settle together.
#include <array>
#include <cstdio>
#include <limits>
#include <numbers>

#include "bulk.hpp"
#include "impact_bed.hpp"
#include "session.hpp"

namespace experiments {

namespace impact_parts {

using namespace bulk;

constexpr std::size_t shallow = 25000;  // balls of the bed that deeper ones are made of

double height(const World& world) {
  return world.pose(steel_ball(world)).position[2];
}

struct Case {
  std::size_t balls;
  std::vector<std::uint64_t> seeds;
  const char* file;  // of the published curves; empty: there is none
  Numerics numerics;
  Preparation preparation = {};

  std::string name() const {
    return std::to_string(balls) + " balls" + (preparation.is_standard() ? "" : ", loose bed");
  }
  /// Name of the file of the curve.
  std::string curve() const {
    return "impact_" + std::to_string(balls / 1000) + "k" +
           (balls == shallow && numerics.step > 5e-5 ? "_twice_the_step" : "") +
           (preparation.is_standard() ? "" : "_loose");
  }
};

struct Outcome {
  Numbers z;  // every millisecond
  double seconds, ms, unsolved, overlap;
};
Outcome one_impact(Session& session, const Case& c, std::uint64_t seed, double until) {
  const int threads = session.options().threads;
  const std::string name = c.name() + ", bed " + std::to_string(seed) + c.preparation.text();
  const Numbers bed = c.balls > shallow
                          ? stacked_bed(session, c.balls / shallow, shallow, seed, c.preparation)
                          : settled_bed(session, {}, c.balls, seed, c.preparation);
  Session::say("  " + name + ": settled to a root mean square velocity of " +
               std::to_string(1000 * bed[bed.size() - 2]) + " mm/s");
  Numbers z;
  Result result;
  try {
    result = session.once(name + ", impact " + c.numerics.text(), [&](Run& run) {
      World world = world_of(diameter, c.numerics, threads);
      const Sums sums = advance(
          run, world, c.numerics, until, 1e-3, z,
          [&](World& empty) { build_impact(empty, {}, bed, start_height, -speed); }, height);
      Numbers values = z;
      sums.append_to(values);
      return values;
    });
  } catch (const Paused&) {
    std::vector<Numbers> rows;
    for (std::size_t k = 0; k < z.size(); ++k) rows.push_back({double(k), z[k]});
    session.curve(c.curve() + "_so_far", {"t [ms]", "z [m]"}, rows);
    throw;
  }
  const Numbers& v = result.values;
  const std::size_t n = v.size() - 5;
  return {Numbers(v.begin(), v.end() - 5), result.seconds, 1000 * v[n + 4] / v[n], v[n + 1] / v[n],
          v[n + 3]};
}

/// Height of the bed as the curve shows it [m]: how far the lowest point of the ball is above the floor when the ball is
/// 0.1 mm above free fall.
/// @param z every millisecond
double height_of_bed(const Numbers& z) {
  constexpr double sought = 1e-4;
  double before = 0;
  for (std::size_t k = 1; k < z.size(); ++k) {
    const double t = 1e-3 * double(k);
    const double lag = z[k] - (start_height - speed * t - gravity * t * t / 2);
    if (lag >= sought) {
      const double share = (sought - before) / (lag - before);
      return z[k - 1] + share * (z[k] - z[k - 1]) - impactor / 2 - floor_height;
    }
    before = lag;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The published curve of a code. LIGGGHTS' is 0.05 ms ahead, which is taken back.
Numbers curve_of(const std::vector<Numbers>& published, std::size_t code) {
  Numbers z;
  for (const Numbers& line : published) z.push_back(line[code]);
  if (code == 1)
    for (std::size_t k = 0; k + 1 < z.size(); ++k) z[k] -= 0.05 * (z[k + 1] - z[k]);
  return z;
}

void compare(Session& session, const Case& c, const std::vector<Outcome>& outcomes) {
  const bool compared = *c.file != 0;
  const std::vector<Numbers> published = compared ? read_data(c.file) : std::vector<Numbers>();
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
  session.curve(c.curve(), heads, rows);
  const std::string bed =
      c.name() + (c.curve().find("step") != std::string::npos ? ", twice the step: " : ": ");
  Numbers per_step, unsolved;
  for (const Outcome& one : outcomes) per_step.push_back(one.ms), unsolved.push_back(one.unsolved);
  row.published = "–";
  row.figure = bed + "milliseconds per step";
  row.measured = mean_of(per_step).value;
  session.row(row);
  row.figure = bed + "steps not solved, share";
  row.measured = mean_of(unsolved).value;
  session.row(row);
  // Balls over the volume below the surface.
  const auto solid = [&](const Numbers& z) {
    constexpr double r = diameter / 2, ball = 4. / 3 * std::numbers::pi * r * r * r;
    return double(c.balls) * ball / (Box{}.length * Box{}.width * height_of_bed(z));
  };
  Numbers fractions;
  for (const Outcome& one : outcomes) fractions.push_back(solid(one.z));
  const auto both = [&](const char* form, double liggghts, double musen) -> std::string {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), form, liggghts, musen);
    return compared ? text.data() : "–";
  };
  row.figure = bed + "solid fraction of the bed, by the height at which the ball meets it";
  if (compared)
    row.published = both("%.3f (LIGGGHTS), %.3f (MUSEN)", solid(curve_of(published, 1)),
                         solid(curve_of(published, 2)));
  row.measured = mean_of(fractions).value;
  row.error = mean_of(fractions).error;
  session.row(row);
  row.error = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t code : {std::size_t(1), std::size_t(2)}) {
    if (!compared) break;
    const Numbers theirs = curve_of(published, code);
    Numbers largest;
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
  row.figure = bed + "lowest height of the ball [mm]";
  constexpr const char* form = "%.1f (LIGGGHTS), %.1f (MUSEN)";
  row.published = both(form, low[0], low[1]);
  row.measured = mean_of(lowest).value;
  row.error = mean_of(lowest).error;
  row.verdict = "";
  session.row(row);
  row.figure = bed + "height at the end [mm]";
  if (compared) row.published = both(form, 1000 * published.back()[1], 1000 * published.back()[2]);
  row.measured = mean_of(end).value;
  row.error = mean_of(end).error;
  session.row(row);
}

}  // namespace impact_parts

void impact(Session& session) {
  using namespace impact_parts;
  // The deep bed has twice the step; the control of it is the first one of the shallow beds.
  const Numerics numerics{5e-5, 1e-3, 0.2}, twice{1e-4, 1e-3, 0.2};
  // The published beds are looser than those of the standard preparation: a control that differs in the bed only.
  const Preparation loose{1, 0.2, 1.3};
  std::vector<Case> cases{{shallow, {1, 2, 3}, "impact_25k.csv", numerics},
                          {shallow, {1}, "impact_25k.csv", twice},
                          {100000, {1}, "impact_100k.csv", twice},
                          {100000, {1}, "impact_100k.csv", twice, loose},
                          {shallow, {1}, "impact_25k.csv", twice, loose},
                          {50000, {1}, "impact_50k.csv", twice, loose},
                          {50000, {1, 2, 3}, "impact_50k.csv", numerics}};
  if (session.quick()) {
    one_impact(session, {1000, {1}, "", numerics}, 1, 0.01);
    return;
  }
  bool complete = true;
  for (const Case& one : cases) {
    if (!session.wants(one.name()) && !session.wants(one.curve())) continue;
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
