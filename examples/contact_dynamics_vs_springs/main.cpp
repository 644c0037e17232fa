// SPDX-License-Identifier: MIT
// The same packing by contact dynamics and by springs of rising stiffness: where the lid comes to
// stand, how dense the packing is and how its forces are distributed, with the time step that each
// takes and what a simulated second costs. Writes contact_dynamics_vs_springs.csv, which
// `gnuplot plot.gp` draws. With the argument --quick it stops at a moderate stiffness.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/moreau.hpp"

namespace {

using S = moreau::Space<2>;
using Disk = moreau::Sphere<S>;
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

/// What came out of one method.
struct Outcome {
  double lid = 0;       ///< height [m]
  double solid = 0;     ///< solid fraction
  double strong = 0;    ///< share of contacts that carry more than twice the mean force
  double overlap = 0;   ///< mean over diameter
  double seconds = 0;   ///< wall clock per simulated second
  double contacts = 0;  ///< per grain
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
  /// What is compared are states of rest: they are solved for to the last digit that counts.
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
      out.poses[k] = simulation.bodies().pose[simulation.grain(k).index()];
    out.lid = height();
    return out;
  }
  double height() const { return simulation.bodies().pose[lid.index()].position.y(); }

  Simulation simulation;
  moreau::BodyId lid;
  moreau::StepReport last;
};

/// A loose lattice of disks of 8 to 12 mm.
State loose(int count) {
  State state;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> radius(0.004, 0.006), shift(-5e-4, 5e-4);
  constexpr int per_row = 9;
  for (int k = 0; k < count; ++k) {
    moreau::Pose<S> pose;
    pose.position = {0.0067 + 0.0133 * (k % per_row) + shift(random),
                     0.0067 + 0.0133 * (k / per_row)};
    state.radii.push_back(radius(random));
    state.poses.push_back(pose);
  }
  state.lid = 0.0133 * (count / per_row + 1);
  return state;
}

/// From the packing on, for half a second.
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
  double area = 0, sum = 0, count = 0, strong = 0;
  for (const double r : packing.radii) area += std::numbers::pi * r * r;
  out.solid = area / (width * out.lid);
  const auto& impulses = press.simulation.contacts().impulses;
  for (const Vector& r : impulses)
    if (r[0] > 0) sum += r[0], ++count;
  for (const Vector& r : impulses) strong += r[0] > 2 * sum / count;
  out.strong = strong / count;
  out.contacts = 2 * count / double(packing.radii.size());
  out.overlap = press.last.mean_overlap / size;
  return out;
}

void write(std::FILE* file, const char* name, double stiffness, double step, const Outcome& o) {
  std::printf("%-18s %8.0e %9.1e %10.6f %9.5f %8.3f %8.3f %9.1e %9.3f\n", name, stiffness, step,
              1e3 * o.lid, o.solid, o.contacts, o.strong, o.overlap, o.seconds);
  std::fprintf(file, "%g,%g,%.9g,%.9g,%g,%g,%g,%g\n", stiffness, step, o.lid, o.solid, o.contacts,
               o.strong, o.overlap, o.seconds);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const State start = loose(200);
  Press<Coulomb> press(start, Coulomb(friction));
  press.solve_to(1e-5);
  press.run(quick ? 0.5 : 1.5, 2e-4);
  const State packing = press.state(start);

  std::FILE* file = std::fopen("contact_dynamics_vs_springs.csv", "w");
  if (!file) {
    std::fprintf(stderr, "contact_dynamics_vs_springs.csv: cannot be written\n");
    return 1;
  }
  std::fprintf(file,
               "stiffness_N_per_m,step_s,lid_m,solid_fraction,contacts_per_grain,"
               "strong_share,mean_overlap_over_d,seconds_per_second\n");
  std::printf("%-18s %8s %9s %10s %9s %8s %8s %9s %9s\n", "method", "k [N/m]", "h [s]", "lid [mm]",
              "solid", "contacts", "strong", "overlap/d", "cost s/s");
  for (const double step : {1e-3, 2e-4})
    write(file, "contact dynamics", 0, step, settle(packing, Coulomb(friction), step));
  const double lightest = density * std::numbers::pi * 0.004 * 0.004;
  for (const double k : {1e5, 1e6, 1e7, 1e8, 1e9}) {
    if (quick && k > 1e6) break;
    const Springs law(k, 0.8 * k, friction, 0.3);
    const double step = law.duration(lightest / 2) / 20;
    write(file, "springs", k, step, settle(packing, law, step));
  }
  std::fclose(file);
  return 0;
}
