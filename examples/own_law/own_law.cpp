// SPDX-License-Identifier: MIT
// A contact law of one's own: greased faces. Normal impulses obey Signorini's condition; the
// tangential one is viscous, r_t = -drag u_t. A crate on a slope then slides at the speed where the
// drag of its contact points balances its weight. Prints its speed, which plot.gp draws:
//
//   own_law > own_law.txt; gnuplot plot.gp
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "moreau/moreau.hpp"

struct Greased {
  double drag = 0;  ///< impulse per speed and contact point [N s / (m/s)]: viscosity x time step

  /// A contact may close its gap within the step.
  double velocity_offset(double gap, double, double step) const {
    return std::max(0.0, gap) / step;
  }

  /// u = W r + b with r_t = -drag u_t, and u_n = 0 or r_n = 0: a linear system either way.
  template <class S>
  typename S::Vector solve(const moreau::LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector&) const {
    typename S::Matrix w = block.matrix();
    w.template bottomRows<S::dim - 1>() *= drag;
    w.template bottomRightCorner<S::dim - 1, S::dim - 1>().diagonal().array() += 1;
    typename S::Vector right = -b;
    right.template tail<S::dim - 1>() *= drag;
    const typename S::Vector closed = w.inverse() * right;
    if (closed[0] >= 0) return closed;
    return S::Vector::Zero();  // without pressure there is no grease between the faces
  }

  /// Zero exactly on solutions; the solver's residual is made of it. r is the impulse times scale.
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r, double scale = 1) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    Vector map = r;
    map[0] = std::min(r[0], u[0]);
    if (r[0] > 0) map.template tail<tangents>() += scale * drag * u.template tail<tangents>();
    return map;
  }
};

static_assert(moreau::SetValuedLaw<Greased, moreau::Space<2>>);  // says what is missing

int main() {
  using Crate = moreau::Polygon<double>;
  const double step = 1e-3, viscosity = 5, slope = 0.3;
  moreau::Simulation<Crate, Greased> simulation(0.1,
                                                moreau::Materials<Greased>(1, {viscosity * step}));
  const std::vector<Eigen::Vector2d> corners{
      {-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}};
  const auto shape = simulation.add_shape(Crate(corners));
  moreau::Pose<moreau::Space<2>> pose;
  pose.position = {0, 0.05};
  const auto crate = simulation.add_grain(shape, pose, 500);
  simulation.add_wall({0, 1}, {0, 0});
  simulation.set_gravity({9.81 * std::sin(slope), -9.81 * std::cos(slope)});
  const double mass = simulation.bodies().weight[crate.index()];
  const double drag = 2 * viscosity;  // of two contact points
  int unsolved = 0;
  std::printf("# t [s], speed [m/s], expected [m/s]\n");
  for (int k = 0; k <= 6000; ++k) {
    if (k % 200 == 0) {
      const double t = simulation.time();
      const double expected =
          mass * 9.81 * std::sin(slope) / drag * (1 - std::exp(-drag * t / mass));
      std::printf("%.1f %.6f %.6f\n", t, simulation.bodies().velocity[crate.index()][0], expected);
    }
    if (!simulation.step(step).solve.converged) ++unsolved;
  }
  std::printf("# unsolved steps: %d\n", unsolved);
  return unsolved > 0;
}
