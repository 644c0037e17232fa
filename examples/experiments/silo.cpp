// SPDX-License-Identifier: MIT
// The silo of Dosta et al. 2024: 100,000 balls, d = 4 mm, in a steel cylinder with a cone, opened at t = 0. Observable:
// number of balls above the orifice. The published packings were not to be had: packings are made here, by random
// deposition and settling.
#include <array>
#include <cstdio>
#include <numbers>

#include "moreau/boundary/sink.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/spatial_order.hpp"

#include "bulk.hpp"
#include "session.hpp"

namespace experiments {

namespace silo_parts {

using namespace bulk;
using S = moreau::Space<3>;

constexpr double radius = 0.1, diameter = 0.004;  // [m]

struct Outlet {
  const char* name;
  double radius, height, cone;  // of the orifice, its height z0, height of the cone [m]
};
constexpr Outlet large{"large", 0.03, -0.0554222, 0.07}, small{"small", 0.02, -0.0593008, 0.08};

struct Case {
  Outlet outlet;
  bool second;  // M2 in place of M1
  std::size_t balls;
  double until, from;  // of the discharge; the rate is the slope from `from` to `until` [s]
  Numerics numerics;

  std::string name() const {
    return std::string(outlet.name) + " orifice, " + (second ? "M2" : "M1") + ", " +
           std::to_string(balls) + " balls";
  }
  bool is_control() const { return numerics.step != 5e-4 || balls == 45000; }
  /// Of this run, in the table and for --part.
  std::string run_name() const { return name() + (numerics.step != 5e-4 ? ", half the step" : ""); }
};

/// The cone, its outside towards the axis. Of a polygon with the area of the circle.
moreau::TriangleMesh<> cone(const Outlet& outlet) {
  constexpr std::uint32_t count = 96;
  const double step = 2 * std::numbers::pi / count, grown = std::sqrt(step / std::sin(step));
  moreau::TriangleMesh<> mesh;
  for (const auto& [r, z] :
       {std::pair{radius, outlet.height + outlet.cone}, std::pair{outlet.radius, outlet.height}})
    for (std::uint32_t k = 0; k < count; ++k)
      mesh.vertices.push_back({grown * r * std::cos(step * k), grown * r * std::sin(step * k), z});
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    mesh.facets.push_back({k, next, k + count});
    mesh.facets.push_back({next, next + count, k + count});
  }
  return mesh;
}

/// Adds the balls and the silo, closed by a floor.
void fill(World& world, const Case& c) {
  std::mt19937_64 random(1);
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  std::size_t left = c.balls;
  const double bottom = c.outlet.height + c.outlet.cone;
  // Of balls in a square those in the circle are taken.
  const std::vector<double> radii(c.balls * 3 / 2, diameter / 2);
  for (moreau::Pose<S> pose : moreau::random_deposition<S>(radii, 2 * radius, random)) {
    pose.position += Vector(-radius, -radius, bottom);
    if (pose.position.head<2>().norm() > radius - diameter / 2 || left == 0) continue;
    world.add_grain(shape, pose, c.second ? density_m2 : density_m1, c.second ? m2 : m1);
    --left;
  }
  if (left > 0) throw std::runtime_error("silo: too few balls");
  world.add_cylinder({0, 0, 0}, Vector::UnitZ(), radius, steel);
  world.add_mesh_wall(cone(c.outlet), {}, moreau::WallSides::outside, steel);
  world.add_wall(Vector::UnitZ(), c.outlet.height * Vector::UnitZ(), steel);
}

/// Positions of the settled balls.
Numbers settled(Run& run, const Case& c, int threads, double duration) {
  const Numerics numerics{5e-4, 1e-2, 0.15, 500, 8};
  World world = world_of(diameter, numerics, threads);
  Numbers log;
  advance(
      run, world, numerics, duration, duration, log, [&](World& empty) { fill(empty, c); },
      [](const World& now) { return mean_speed(now); });
  Numbers state;
  for (const moreau::BodyId grain : world.grains())
    for (const double x : world.pose(grain).position) state.push_back(x);
  return state;
}

void build(World& world, const Case& c, const Numbers& positions) {
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  std::vector<Vector> points;
  for (std::size_t k = 0; k + 2 < positions.size(); k += 3)
    points.emplace_back(positions[k], positions[k + 1], positions[k + 2]);
  for (const std::size_t k : moreau::spatial_order<S>(points))
    world.add_grain(shape, {points[k]}, c.second ? density_m2 : density_m1, c.second ? m2 : m1);
  world.add_cylinder({0, 0, 0}, Vector::UnitZ(), radius, steel);
  world.add_mesh_wall(cone(c.outlet), {}, moreau::WallSides::outside, steel);
}

void write_curve(Session& session, const Case& c, const Numbers& counts) {
  std::vector<Numbers> rows;
  for (std::size_t k = 0; k < counts.size(); ++k)
    rows.push_back({0.1 * double(k), counts[k], counts[0] - counts[k]});
  session.curve(std::string("silo_") + c.outlet.name + (c.second ? "_M2_" : "_M1_") +
                    std::to_string(c.balls / 1000) + "k" +
                    (c.numerics.step != 5e-4 ? "_half_step" : ""),
                {"t [s]", "balls above the orifice", "balls below it"}, rows);
}

struct Outcome {
  Numbers counts;  // above the orifice, every 0.1 s
  double seconds, ms, unsolved;
};
/// A discharge that is stopped has the curve so far.
Outcome discharge(Session& session, const Case& c) {
  const int threads = session.options().threads;
  const Result start = session.once(c.name() + ", settling", [&](Run& run) {
    return settled(run, c, threads, session.quick() ? 0.1 : 0.4);
  });
  Numbers counts;
  Result result;
  try {
    result = session.once(c.name() + ", " + c.numerics.text(), [&](Run& run) {
      World world = world_of(diameter, c.numerics, threads);
      auto sink =
          moreau::Sink<S>::behind(Vector::UnitZ(), (c.outlet.height - 0.03) * Vector::UnitZ());
      const auto count = [&](World& present) {
        sink.apply(present);
        double above = 0;
        for (const moreau::BodyId grain : present.grains())
          above += present.pose(grain).position[2] > c.outlet.height;
        return above;
      };
      const Sums sums = advance(
          run, world, c.numerics, c.until, 0.1, counts,
          [&](World& empty) { build(empty, c, start.values); }, count);
      Numbers values = counts;
      sums.append_to(values);
      return values;
    });
  } catch (const Paused&) {
    write_curve(session, c, counts);
    throw;
  }
  const Numbers& v = result.values;
  const std::size_t n = v.size() - 5;
  counts.assign(v.begin(), v.end() - 5);
  write_curve(session, c, counts);
  return {counts, result.seconds, 1000 * v[n + 4] / v[n], v[n + 1] / v[n]};
}

/// Slope of the count [1/s], by least squares.
double rate_of(const Numbers& counts, double from, double until) {
  double n = 0, t = 0, y = 0, tt = 0, ty = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double time = 0.1 * double(k);
    if (time < from - 0.01 || time > until + 0.01) continue;
    ++n, t += time, y += counts[k], tt += time * time, ty += time * counts[k];
  }
  return -(ty - t * y / n) / (tt - t * t / n);
}

/// Rates of the published curves of M1 at the same times.
std::string published_rates(const Outlet& outlet, double from, double until) {
  std::string text = "at these times";
  std::vector<const char*> names{"LIGGGHTS", "MUSEN"};
  if (outlet.radius < large.radius) names = {"MUSEN"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    Numbers counts;
    for (const Numbers& line : read_data(std::string("silo_") + outlet.name + "_M1.csv"))
      counts.push_back(line[k + 1]);
    std::array<char, 32> rate{};
    std::snprintf(rate.data(), rate.size(), " %.1f", rate_of(counts, from, until) / 1000);
    text += rate.data() + std::string(" (") + names[k] + ")";
  }
  return text;
}

}  // namespace silo_parts

void silo(Session& session) {
  using namespace silo_parts;
  const Numerics numerics{5e-4, 3e-3, 0.15, 500, 8};
  Numerics half = numerics;
  half.step /= 2;
  std::vector<Case> cases;
  if (session.quick())
    cases = {{large, false, 1500, 0.2, 0, numerics}};
  else
    // The smaller silos first; of these one with half the step and one filled higher are controls.
    cases = {{large, false, 30000, 0.6, 0.2, numerics}, {small, false, 30000, 1, 0.2, numerics},
             {large, false, 30000, 0.3, 0.1, half},     {large, false, 45000, 0.3, 0.1, numerics},
             {large, true, 30000, 0.6, 0.2, numerics},  {small, true, 30000, 1, 0.2, numerics},
             {large, false, 100000, 5, 0.5, numerics},  {small, false, 100000, 5, 0.5, numerics},
             {large, true, 100000, 5, 0.5, numerics},   {small, true, 100000, 5, 0.5, numerics}};
  double last_large = 0;
  for (const Case& c : cases) {
    if (!session.wants(c.run_name())) continue;
    const Outcome outcome = discharge(session, c);
    Row row;
    row.law = "SignoriniCoulomb";
    row.step = c.numerics.step;
    row.tolerance = c.numerics.tolerance;
    row.grains = c.balls;
    row.seconds = outcome.seconds;
    row.figure = c.run_name() + ": thousand balls per second";
    const double until = c.balls == 100000 && c.outlet.radius > 0.025 ? 3.5 : c.until;
    row.measured = rate_of(outcome.counts, c.from, until) / 1000;
    const bool compared = !c.second && c.outlet.radius > 0.025 && !session.quick();
    row.published = compared ? "23.2 ± 1.9 (eight codes); " : "";
    if (!c.second) row.published += published_rates(c.outlet, c.from, until);
    if (c.second) row.published = "–";
    if (compared) row.verdict = std::abs(row.measured - 23.2) <= 0.08 * 23.2 ? "yes" : "no";
    session.row(row);
    if (!c.second && c.outlet.radius > 0.025 && !c.is_control()) last_large = row.measured;
    if (!c.second && c.outlet.radius < 0.025 && last_large > 0) {
      row.figure = "rate of the large over that of the small orifice, M1, " +
                   std::to_string(c.balls) + " balls";
      row.published = "3.10 ± 0.06";
      row.measured = last_large / row.measured;
      row.verdict = std::abs(row.measured - 3.1) <= 0.15 ? "yes" : "no";
      session.row(row);
    }
    row.published = "–", row.verdict = "";
    row.figure = c.run_name() + ": milliseconds per step";
    row.measured = outcome.ms;
    session.row(row);
    row.figure = c.run_name() + ": steps not solved, share";
    row.measured = outcome.unsolved;
    session.row(row);
  }
}

}  // namespace experiments
