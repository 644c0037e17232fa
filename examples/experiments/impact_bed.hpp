// SPDX-License-Identifier: MIT
// The box and the beds of the impact of Dosta et al. 2024.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "moreau/sample/random_deposition.hpp"

#include "bulk.hpp"
#include "session.hpp"
#include "worlds.hpp"

namespace experiments::impact_parts {

using namespace bulk;
using S = moreau::Space<3>;

constexpr double floor_height = -0.0902431;                     // [m]
constexpr double diameter = 0.002, impactor = 0.02, speed = 5;  // [m], [m/s]
constexpr double start_height = 0.06, settling = 0.25;          // [m], [s]

/// The published box; a control has a smaller one.
struct Box {
  double length = 0.1, width = 0.06;  // [m]
};

inline void add_box(auto& world, const Box& box) {
  const Vector corner(box.length / 2, box.width / 2, 0);
  for (int axis : {0, 1})
    for (const double side : {-1.0, 1.0})
      world.add_wall(-side * Vector::Unit(axis), side * corner[axis] * Vector::Unit(axis), steel);
  world.add_wall(Vector::UnitZ(), floor_height * Vector::UnitZ(), steel);
}

/// @param stretch factor of the heights above the floor
inline void add_bed(auto& world, const Box& box, std::size_t count, std::uint64_t seed,
                    double stretch) {
  std::mt19937_64 random(seed);
  const std::vector<double> radii(count, diameter / 2);
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  for (moreau::Pose<S> pose :
       moreau::random_deposition<S>(radii, std::array<double, 2>{box.length, box.width}, random)) {
    pose.position[2] = diameter / 2 + stretch * (pose.position[2] - diameter / 2);
    pose.position += Vector(-box.length / 2, -box.width / 2, floor_height);
    world.add_grain(shape, pose, density_m1, m1);
  }
  add_box(world, box);
}

/// How a bed is prepared. What the publication has is not known to us: the standard is the published materials.
struct Preparation {
  double friction = 0;  ///< of all pairs while the bed settles; 0: the published ones
  double rolling = 0;   ///< then also coefficient of resistance to rolling
  double stretch = 1;   ///< factor of the heights above the floor before the bed settles

  bool is_standard() const { return friction == 0 && stretch == 1; }
  /// For names of runs.
  std::string text() const {
    return is_standard() ? ""
                         : ", settled with friction " + std::to_string(friction) +
                               (rolling > 0 ? ", " + std::to_string(rolling) : "") + " from " +
                               std::to_string(stretch) + " times the height";
  }
  template <class Law>
  moreau::Materials<Law> laws() const {
    return materials_of<Law>([&](moreau::MaterialId, moreau::MaterialId, double mu, double e) {
      const double used = friction > 0 ? friction : mu;
      if constexpr (std::is_same_v<Law, Rolling>)
        return Law(used, rolling, e);
      else
        return Law(used, e);
    });
  }
};

/// A bed that has settled, which the experiments share: positions, then the root of the mean square of the velocities
/// [m/s] and the milliseconds per step.
/// @param add (world): adds balls and box
inline Numbers settle(Session& session, const std::string& key, double duration,
                      const Preparation& preparation, const auto& add) {
  const auto with_law = [&]<class Law>(Run& run, std::type_identity<Law>) {
    const Numerics numerics{2e-4, 1e-2, 0.2};
    auto world =
        world_of<Law>(diameter, numerics, session.options().threads, preparation.laws<Law>());
    Numbers log;
    const Sums sums = advance(run, world, numerics, duration, duration, log, add,
                              [](const auto& settled) { return mean_speed(settled); });
    Numbers state;
    for (const moreau::BodyId grain : world.grains())
      for (const double x : world.pose(grain).position) state.push_back(x);
    state.push_back(mean_speed(world));
    state.push_back(1000 * sums.stepping / sums.steps);
    return state;
  };
  return session
      .once(key,
            [&](Run& run) {
              return preparation.rolling > 0 ? with_law(run, std::type_identity<Rolling>())
                                             : with_law(run, std::type_identity<Law>());
            })
      .values;
}

/// The bed of settle(), made by random deposition.
inline Numbers settled_bed(Session& session, const Box& box, std::size_t count, std::uint64_t seed,
                           const Preparation& preparation = {}) {
  const std::string key = "/bed of " + std::to_string(count) + " balls, seed " +
                          std::to_string(seed) + ", width " + std::to_string(box.width) +
                          preparation.text();
  const double duration = preparation.is_standard() ? settling : 0.15;
  return settle(session, key, session.quick() ? 0.01 : duration, preparation,
                [&](auto& empty) { add_bed(empty, box, count, seed, preparation.stretch); });
}

/// The bed of settle(), made of up to four copies of a settled bed, one above the other: the bed itself, mirrored along
/// the length, along the width, along both. It settles again for 0.06 s, because surface and bottom do not fit. A deep
/// bed that is deposited at random falls by its height, which takes as many steps as the impact.
inline Numbers stacked_bed(Session& session, std::size_t copies, std::size_t count,
                           std::uint64_t seed, const Preparation& preparation = {}) {
  const Numbers bed = settled_bed(session, {}, count, seed, preparation);
  const std::string key = "/bed of " + std::to_string(copies * count) + " balls, " +
                          std::to_string(copies) + " copies, seed " + std::to_string(seed) +
                          preparation.text();
  return settle(session, key, 0.06, preparation, [&](auto& empty) {
    double top = floor_height;
    for (std::size_t k = 0; k + 3 < bed.size(); k += 3) top = std::max(top, bed[k + 2]);
    const double height = top + diameter / 2 - floor_height;
    const auto shape = empty.add_shape(moreau::Ball<double>(diameter / 2));
    for (std::size_t copy = 0; copy < copies; ++copy)
      for (std::size_t k = 0; k + 3 < bed.size(); k += 3)
        empty.add_grain(shape,
                        {Vector((copy % 2 == 0 ? 1 : -1) * bed[k], (copy < 2 ? 1 : -1) * bed[k + 1],
                                bed[k + 2] + height * double(copy))},
                        density_m1, m1);
    add_box(empty, {});
  });
}

/// The balls of a settled bed and the steel ball above it, which falls.
/// @param bed of settled_bed()
/// @param z   height of the ball's centre [m]
/// @param v   its velocity [m/s], < 0
inline void build_impact(auto& world, const Box& box, const Numbers& bed, double z, double v) {
  const auto shape = world.add_shape(moreau::Ball<double>(diameter / 2));
  for (std::size_t k = 0; k + 3 < bed.size(); k += 3)
    world.add_grain(shape, {Vector(bed[k], bed[k + 1], bed[k + 2])}, density_m1, m1);
  const auto ball = world.add_grain(world.add_shape(moreau::Ball<double>(impactor / 2)),
                                    {Vector(0, 0, z)}, density_steel, steel);
  world.set_velocity(ball, {0, 0, v});
  add_box(world, box);
}
inline moreau::BodyId steel_ball(const auto& world) {
  return world.grain(world.grain_count() - 1);
}

}  // namespace experiments::impact_parts
