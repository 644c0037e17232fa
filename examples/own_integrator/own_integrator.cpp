// SPDX-License-Identifier: MIT
// An integrator of one's own: symplectic Euler, for laws that give forces. A ball bounces on an
// undamped spring. Positions follow the same recursion as velocity Verlet's (its velocities are
// those half a step earlier), so that the heights of the bounces err alike, with the square of the
// step.
#include <algorithm>
#include <cstdio>
#include <span>

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/moreau.hpp"

/// v += h M^-1 F, then q += h v. Turns spheres only: their inertia is the same about every axis.
struct SymplecticEuler {
  template <class S>
  void predict_configuration(moreau::Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      typename S::Twist& v = bodies.velocity[i];
      const typename S::Twist load = loads[i] + bodies.force[i];
      const typename S::Vector force = load.template head<S::dim>() + bodies.weight[i] * gravity;
      v.template head<S::dim>() += step * bodies.inverse_mass[i].cwiseProduct(force);
      if (bodies.rotates(i))
        v.template tail<S::angular_dim>() +=
            step / bodies.inertia_body[i](0, 0) * load.template tail<S::angular_dim>();
      bodies.pose[i].position += step * v.template head<S::dim>();
      bodies.pose[i].rotation =
          S::exp(step * v.template tail<S::angular_dim>()) * bodies.pose[i].rotation;
    }
  }
  template <class S>
  void advance_configuration(moreau::Bodies<S>&, std::span<const typename S::Twist>,
                             const typename S::Vector&, typename S::Scalar) const {}
};

static_assert(moreau::ForceIntegrator<SymplecticEuler, moreau::Space<3>>);  // says what is missing

/// Heights of five bounces from one metre.
template <class Integrator>
void bounce(const char* name, double step) {
  using S = moreau::Space<3>;
  using Ball = moreau::Sphere<S>;
  using Law = moreau::LinearSpringDashpot<double>;
  moreau::Simulation<Ball, Law, Integrator> simulation(0.1, moreau::Materials<Law>(1, Law(1e4)));
  const auto shape = simulation.add_shape(Ball(0.05));
  moreau::Pose<S> pose;
  pose.position.setZero();
  pose.position.z() = 1.05;
  const auto ball = simulation.add_grain(shape, pose, 1000);
  simulation.add_wall(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  simulation.set_gravity({0, 0, -9.81});
  std::printf("%-16s h = %.0e s:", name, step);
  double top = 0, speed = 0;
  for (int bounces = 0; bounces < 6;) {
    simulation.step(step);
    const double now = simulation.bodies().velocity[ball.index()][2];
    top = std::max(top, simulation.bodies().pose[ball.index()].position.z() - 0.05);
    if (speed < 0 && now >= 0) {
      if (bounces++ > 0) std::printf(" %.5f", top);
      top = 0;
    }
    speed = now;
  }
  std::printf(" m\n");
}

int main() {
  for (const double step : {4e-4, 1e-4}) {
    bounce<moreau::VelocityVerlet>("VelocityVerlet", step);
    bounce<SymplecticEuler>("SymplecticEuler", step);
  }
}
