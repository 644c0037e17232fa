// SPDX-License-Identifier: MIT
// A ball bounces on an undamped spring, under symplectic Euler (symplectic_euler.hpp, an integrator
// of one's own). Positions follow the same recursion as velocity Verlet's (its velocities are
// those half a step earlier), so that the heights of the bounces err alike, with the square of the
// step. Prints how far, which plot.gp draws:
//
//   own_integrator > own_integrator.txt; gnuplot plot.gp
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/moreau.hpp"

#include "symplectic_euler.hpp"

/// Error of the height of the fifth bounce, which should be that of the drop [m].
template <class Integrator>
double error_of_bounces(double drop, double step) {
  using S = moreau::Space<3>;
  using Ball = moreau::BallIn<S>;
  using Law = moreau::LinearSpringDashpot<double>;
  moreau::Simulation<Ball, Law, Integrator> simulation(0.1, moreau::Materials<Law>(1, Law(1e4)));
  const auto shape = simulation.add_shape(Ball(0.05));
  const auto ball = simulation.add_grain(shape, {{0, 0, 0.05 + drop}, S::identity()}, 1000);
  simulation.add_wall(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  simulation.set_gravity({0, 0, -9.81});
  double top = 0, speed = 0;
  for (int bounces = 0; bounces < 5 || speed > 0;) {
    const double before = speed;
    simulation.step(step);
    speed = simulation.velocity(ball)[2];
    if (before < 0 && speed >= 0) ++bounces, top = 0;
    top = std::max(top, simulation.pose(ball).position.z() - 0.05);
  }
  return std::abs(top - drop);
}

/// Mean over drops from about a metre.
template <class Integrator>
double mean_error(double step) {
  double sum = 0;
  for (int k = 0; k < 10; ++k) sum += error_of_bounces<Integrator>(1 + 0.02 * k, step) / 10;
  return sum;
}

int main() {
  std::printf("# step [s], error with velocity Verlet, with symplectic Euler [m]\n");
  double first = 0, last = 0;
  for (const double step : {8e-4, 4e-4, 2e-4, 1e-4}) {
    last = mean_error<SymplecticEuler>(step);
    if (first == 0) first = last;
    std::printf("%.1e %.3e %.3e\n", step, mean_error<moreau::VelocityVerlet>(step), last);
  }
  const double order = std::log2(first / last) / 3;
  std::printf("# order of symplectic Euler: %.2f\n", order);
  return !(order > 1.5);
}
