// SPDX-License-Identifier: MIT
// A crate slides down a slope of greased faces (greased.hpp, a law of one's own) at the speed where
// the drag of its contact points balances its weight. Prints its speed, which plot.gp draws:
//
//   own_law > own_law.txt; gnuplot plot.gp
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "moreau/moreau.hpp"

#include "greased.hpp"

int main() {
  using Crate = moreau::Polygon<double>;
  const double step = 1e-3, viscosity = 5, slope = 0.3;
  moreau::Simulation<Crate, Greased> simulation(0.1,
                                                moreau::Materials<Greased>(1, {viscosity * step}));
  const std::vector<Eigen::Vector2d> corners{
      {-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}};
  const auto shape = simulation.add_shape(Crate(corners));
  const moreau::Pose<moreau::Space<2>> pose{{0, 0.05}, moreau::Space<2>::identity()};
  const auto crate = simulation.add_grain(shape, pose, 500);
  simulation.add_wall({0, 1}, {0, 0});
  simulation.set_gravity({9.81 * std::sin(slope), -9.81 * std::cos(slope)});
  const double mass = simulation.bodies().grain_mass[crate.index()];
  const double drag = 2 * viscosity;  // of two contact points
  int unsolved = 0;
  double worst = 0;
  std::printf("# t [s], speed [m/s], expected [m/s]\n");
  for (int k = 0; k <= 6000; ++k) {
    if (k % 200 == 0) {
      const double t = simulation.time();
      const double expected =
          mass * 9.81 * std::sin(slope) / drag * (1 - std::exp(-drag * t / mass));
      const double speed = simulation.velocity(crate)[0];
      worst = std::max(worst, std::abs(speed - expected));
      std::printf("%.1f %.6f %.6f\n", t, speed, expected);
    }
    if (!simulation.step(step).solve.converged) ++unsolved;
  }
  // Implicit Euler in the drag errs by e^-1 / 2 of a step's gain at most, 0.18.
  const double allowed = 0.2 * 9.81 * std::sin(slope) * step;
  std::printf("# unsolved steps: %d; largest error %.1e m/s, allowed %.1e\n", unsolved, worst,
              allowed);
  return unsolved > 0 || worst > allowed;
}
