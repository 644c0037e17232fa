// SPDX-License-Identifier: MIT
// Disks between three walls under a lid that is pressed down, by contact dynamics or with springs.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/measure/force_distribution.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/moreau.hpp"

namespace press {

using S = moreau::Space<2>;
using Disk = moreau::BallIn<S>;
using Vector = S::Vector;
using Springs = moreau::LinearSpringDashpot<double>;
using Coulomb = moreau::SignoriniCoulomb<double>;

constexpr double size = 0.01, width = 0.12, lid_mass = 20, lid_force = 2000, density = 2000,
                 friction = 0.3;

struct State {
  std::vector<double> radii;
  std::vector<moreau::Pose<S>> poses;
  double lid = 0;  ///< height [m]
};

/// Results of one method.
struct Outcome {
  double lid = 0;                            ///< height [m]
  double solid = 0;                          ///< solid fraction away from the walls
  moreau::ForceDistribution<double> forces;  ///< of the contacts with a force
  double overlap = 0;                        ///< mean overlap / diameter
  double seconds = 0;                        ///< wall-clock time of a simulated second
  double contacts = 0;                       ///< per grain

  /// Share of the contacts whose force is more than twice the mean.
  double strong() const {
    double sum = forces.beyond;
    for (std::size_t k = 0; k < forces.density.size(); ++k)
      if (forces.ratio(k) > 2) sum += forces.width * forces.density[k];
    return sum;
  }
};

/// Disks between three walls under a lid that is pressed down.
template <class Law>
class Press {
 public:
  using Simulation = moreau::Simulation<Disk, Law>;

  Press(const State& state, const Law& law) : simulation(size, moreau::Materials<Law>(1, law)) {
    for (std::size_t k = 0; k < state.poses.size(); ++k)
      simulation.add_grain(simulation.add_shape(Disk(state.radii[k])), state.poses[k], density);
    simulation.add_wall({1, 0}, {0, 0});
    simulation.add_wall({-1, 0}, {width, 0});
    simulation.add_wall({0, 1}, {0, 0});
    lid = simulation.add_wall({0, -1}, {0, state.lid});
    simulation.set_wall_mass(lid, lid_mass);
    simulation.set_force(lid, {0, -lid_force});
    simulation.set_gravity({0, -9.81});
  }
  /// The tolerance is small, because states of rest are compared.
  void solve_to(double tolerance) {
    moreau::ColouredOptions options;
    options.tolerance = tolerance;
    simulation.set_solver(moreau::ColouredGaussSeidel(options));
  }
  void run(double duration, double step) {
    for (long k = std::lround(duration / step); k > 0; --k) last = simulation.step(step);
  }
  State state(const State& start) const {
    State out = start;
    for (std::size_t k = 0; k < out.poses.size(); ++k)
      out.poses[k] = simulation.pose(simulation.grain(k));
    out.lid = height();
    return out;
  }
  double height() const { return simulation.pose(lid).position.y(); }

  Simulation simulation;
  moreau::BodyId lid;
  moreau::StepReport last;
};

/// A loose lattice of disks of 8 to 12 mm.
inline State loose(int count, std::uint64_t seed) {
  State state;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> radius(0.004, 0.006), shift(-5e-4, 5e-4);
  constexpr int per_row = 9;
  for (int k = 0; k < count; ++k) {
    const double x = 0.0067 + 0.0133 * (k % per_row) + shift(random);
    state.radii.push_back(radius(random));
    state.poses.push_back({{x, 0.0067 + 0.0133 * (k / per_row)}, S::identity()});
  }
  state.lid = 0.0133 * (count / per_row + 1);
  return state;
}

/// Simulates half a second from the packing on and measures the result.
template <class Law>
Outcome settle(const State& packing, const Law& law, double step) {
  Press<Law> press(packing, law);
  if constexpr (std::is_same_v<Law, Coulomb>) press.solve_to(1e-7);
  const double duration = 0.5;
  const auto start = std::chrono::steady_clock::now();
  press.run(duration, step);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  Outcome out;
  out.seconds = wall.count() / duration;
  out.lid = press.height();
  moreau::Aabb<S> inside;  // two diameters from the walls, the floor and the lid
  inside.lower = {2 * size, 2 * size};
  inside.upper = {width - 2 * size, out.lid - 2 * size};
  moreau::ClipWorkspace<S> workspace;
  out.solid = moreau::solid_fraction<S>(
      inside, press.simulation.grain_count(),
      [&](std::size_t k) { return press.simulation.shape_of_grain(k); },
      [&](std::size_t k) { return press.simulation.pose(press.simulation.grain(k)); }, workspace);
  std::vector<double> pushes;
  for (const Vector& r : press.simulation.contacts().impulses)
    if (r[0] > 0) pushes.push_back(r[0] / step);
  out.forces = moreau::force_distribution<double>(
      pushes.size(), [&](std::size_t k) { return pushes[k]; }, 16, 4.0);
  out.contacts = 2 * double(pushes.size()) / double(packing.radii.size());
  out.overlap = press.last.mean_overlap / size;
  return out;
}

/// The packing of `count` disks, by contact dynamics.
/// @param duration of the simulation [s]
inline State packed(int count, double duration, std::uint64_t seed = 1) {
  const State start = loose(count, seed);
  Press<Coulomb> press(start, Coulomb(friction));
  press.solve_to(1e-5);
  press.run(duration, 2e-4);
  return press.state(start);
}

/// Springs of this stiffness [N/m], and their time step: a twentieth of the duration of a contact.
inline std::pair<Springs, double> springs_of(double stiffness) {
  const Springs law(stiffness, 0.8 * stiffness, friction, 0.3);
  const double lightest = density * std::numbers::pi * 0.004 * 0.004;
  return {law, law.duration(lightest / 2) / 20};
}

}  // namespace press
