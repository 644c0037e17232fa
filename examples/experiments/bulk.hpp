// SPDX-License-Identifier: MIT
// What silo, drum and impact of Dosta et al. (Comput. Phys. Commun. 296 (2024) 109066) share: materials,
// the settling of a bed, runs in pieces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <moreau/moreau.hpp>
#include <random>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/parallel/thread_team.hpp"

#include "session.hpp"

namespace experiments::bulk {

using Law = moreau::SignoriniCoulomb<double>;
using World = moreau::Simulation<moreau::Ball<double>, Law>;
using Vector = Eigen::Vector3d;

inline const moreau::MaterialId m1(0), m2(1), steel(2);
constexpr double density_m1 = 2500, density_m2 = 2000, density_steel = 7200;  // [kg/m^3]
constexpr double gravity = 9.81;                                              // [m/s^2]

/// The laws of all pairs.
/// @param law_of (material, material, friction, restitution) -> law; the last two as published
template <class Law>
moreau::Materials<Law> materials_of(const auto& law_of) {
  moreau::Materials<Law> all(3, law_of(m1, m1, 0.3, 0.5));
  const auto set = [&](moreau::MaterialId a, moreau::MaterialId b, double mu, double e) {
    all.set(a, b, law_of(a, b, mu, e));
  };
  set(m1, m2, 0.2, 0.45);
  set(m2, m2, 0.4, 0.4);
  set(m1, steel, 0.2, 0.4);
  set(m2, steel, 0.2, 0.4);
  set(steel, steel, 0.5, 0.6);
  return all;
}
inline moreau::Materials<Law> materials() {
  return materials_of<Law>(
      [](moreau::MaterialId, moreau::MaterialId, double mu, double e) { return Law(mu, e); });
}

/// Step and criterion of a run.
struct Numerics {
  double step = 1e-4;       ///< [s]
  double tolerance = 1e-3;  ///< of the solver
  double margin = 0.1;      ///< of detection, of the smallest diameter
  int max_sweeps = 500;     ///< of a step
  int check_interval = 20;  ///< sweeps from one stopping test to the next

  std::string text() const {
    return "step " + std::to_string(step) + " tolerance " + std::to_string(tolerance) +
           (check_interval == 20 ? "" : " interval " + std::to_string(check_interval));
  }
};

/// An empty world of balls.
/// @param size smallest diameter [m]
template <class Law = bulk::Law>
moreau::Simulation<moreau::Ball<double>, Law> world_of(double size, const Numerics& numerics,
                                                       int threads,
                                                       const moreau::Materials<Law>& laws) {
  moreau::ColouredOptions options;
  options.tolerance = numerics.tolerance;
  options.max_sweeps = numerics.max_sweeps;
  options.check_interval = numerics.check_interval;
  moreau::Tolerances tolerances;
  tolerances.margin = numerics.margin;
  tolerances.skin = 0.1;
  moreau::Simulation<moreau::Ball<double>, Law> world(
      size, laws, moreau::ColouredGaussSeidel(options), tolerances);
  world.set_gravity({0, 0, -gravity});
  if (threads > 1) world.set_team(moreau::ThreadTeam(threads));
  return world;
}
/// The same with the published materials.
inline World world_of(double size, const Numerics& numerics, int threads) {
  return world_of(size, numerics, threads, materials());
}

/// What a run in pieces adds up.
struct Sums {
  double steps = 0, unsolved = 0, sweeps = 0, overlap = 0;
  double stepping = 0;  ///< CPU time [s]

  /// @param cpu of the step [s]
  void add(const moreau::StepReport& report, double cpu) {
    ++steps;
    unsolved += !report.solve.converged;
    sweeps += report.solve.sweeps;
    overlap = std::max(overlap, report.max_overlap);
    stepping += cpu;
  }
  /// For Result::values: what sums_of() reads.
  void append_to(Numbers& numbers) const {
    numbers.insert(numbers.end(), {steps, unsolved, sweeps, overlap, stepping});
  }
};

/// Advances a world, in pieces if the time of the runner is over, and calls look(world) every `interval`.
/// @param build fills an empty world
/// @param log   what look() has stored so far
/// @param look  (world) -> a number or an array of numbers
/// @throws Paused after the state was stored
inline Sums advance(Run& run, auto& world, const Numerics& numerics, double until, double interval,
                    Numbers& log, const auto& build, const auto& look) {
  Numbers sums{0, 0, 0, 0, 0};
  if (run.is_started())
    moreau::reload_snapshot(run.snapshot(), world, log, sums);
  else
    build(world);
  Sums s{sums[0], sums[1], sums[2], sums[3], sums[4]};
  const auto store = [&] {
    sums = {s.steps, s.unsolved, s.sweeps, s.overlap, s.stepping};
    moreau::write_snapshot(run.snapshot(), world, log, sums);
    run.note_stored();
  };
  using Seen = decltype(look(world));
  constexpr std::size_t width = [] {
    if constexpr (std::is_same_v<Seen, double>)
      return std::size_t(1);
    else
      return std::tuple_size_v<Seen>;
  }();
  const auto note = [&] {
    const Seen seen = look(world);
    if constexpr (width == 1)
      log.push_back(seen);
    else
      log.insert(log.end(), seen.begin(), seen.end());
  };
  const auto every = static_cast<std::uint64_t>(std::lround(interval / numerics.step));
  const auto last = static_cast<std::uint64_t>(std::lround(until / numerics.step));
  for (auto k = static_cast<std::uint64_t>(s.steps); k < last;) {
    if (k % every == 0 && log.size() / width <= k / every) note();
    const double before = cpu_seconds();
    const moreau::StepReport report = world.step(numerics.step);
    s.add(report, cpu_seconds() - before);
    ++k;
    if (run.must_stop()) {
      store();
      Session::say("  paused at step " + std::to_string(k) + " of " + std::to_string(last) + ", " +
                   std::to_string(1000 * s.stepping / s.steps) + " ms per step, " +
                   std::to_string(s.sweeps / s.steps) + " sweeps");
      throw Paused();
    }
    if (run.must_store()) store();
    run.progress(double(k) / double(last));
  }
  note();
  return s;
}

/// Root of the mean square of the velocities [m/s].
inline double mean_speed(const auto& world) {
  double sum = 0;
  for (const moreau::BodyId grain : world.grains()) sum += world.velocity(grain).squaredNorm();
  return std::sqrt(sum / double(world.grain_count()));
}

/// Largest and root mean square difference of two curves at the same times.
struct Difference {
  double largest = 0, mean_square = 0;
};
inline Difference difference(const Numbers& a, const Numbers& b) {
  Difference d;
  const std::size_t n = std::min(a.size(), b.size());
  for (std::size_t k = 0; k < n; ++k) {
    const double one = std::abs(a[k] - b[k]);
    d.largest = std::max(d.largest, one);
    d.mean_square += one * one / double(n);
  }
  d.mean_square = std::sqrt(d.mean_square);
  return d;
}

}  // namespace experiments::bulk
