// SPDX-License-Identifier: MIT
// The dynamic angle of repose of grains in a slowly rotating drum. Prints the mean angle and
// writes:
//  - drum.csv: the angle over time
//  - drum.vtm: the grains, the drum and the contacts at the end, for ParaView
//  - drum.png: the grains at the end; a lighter color is a higher speed
//
//   gnuplot -p -e 'set datafile separator ","; plot "drum.csv" using 1:2 skip 1 with lines'
//
// run<moreau::Polygon<double>> simulates a circle in the plane. run<moreau::Polyhedron<double>>
// simulates a slice of a cylinder that is periodic along the axis; it takes some minutes.
#include <cmath>
#include <iostream>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/picture/write_picture.hpp"
#include "moreau/sample/ballast.hpp"

using Law = moreau::SignoriniCoulomb<double>;

namespace setup {
constexpr double radius = 0.1, slice = 0.03;  // radius of the drum; its depth in space [m]
constexpr double size = 0.01;                 // of a grain and of a cell of the initial grid [m]
constexpr double rate = 0.6;                  // angular velocity of the drum [rad/s]
constexpr double h = 5e-4, warm_up = 1.5, duration = 4;  // [s]
}  // namespace setup

/// Adds grains with random shapes on a grid in the lower part of the drum.
template <class Simulation, class Shape>
void fill(Simulation& simulation, const std::vector<Shape>& shapes) {
  using S = typename Simulation::S;
  constexpr int up = S::dim - 1, columns = 20, layers = 3;
  for (int k = 0;; ++k) {
    moreau::Pose<S> pose;
    int rest = k;
    pose.position[0] = setup::size * (rest % columns + 0.5) - setup::radius;
    rest /= columns;
    for (int axis = 1; axis < up; ++axis, rest /= layers)
      pose.position[axis] = setup::size * (rest % layers + 0.5);
    const double height = pose.position[up] = setup::size * (rest + 0.5) - setup::radius;
    if (height > 0.3 * setup::radius) return;
    if (std::hypot(pose.position[0], height) > setup::radius - setup::size / 2) continue;
    pose.rotation = S::exp(S::Angular::Constant(k));
    const auto shape = shapes[std::size_t(k) % shapes.size()].scaled(setup::size / 2);
    simulation.add_grain(simulation.add_shape(shape), pose, 2500);
  }
}

/// Slope of the free surface [degrees], estimated as the angle between the vertical and the line
/// from the axis of the drum to the centre of mass of the grains.
template <class Simulation>
double angle_of_repose(const Simulation& simulation) {
  typename Simulation::Vector sum = Simulation::Vector::Zero();
  for (const moreau::BodyId grain : simulation.grains())
    sum += simulation.bodies().grain_mass[grain.index()] * simulation.pose(grain).position;
  return std::atan2(std::abs(sum[0]), -sum[Simulation::S::dim - 1]) * 180 / std::numbers::pi;
}

/// A lighter color is a higher speed.
void draw(const auto& simulation) {
  moreau::rendering::Picture picture;
  picture.width = picture.height = 700;
  moreau::write_picture(
      "drum.png", simulation,
      [&](moreau::BodyId grain) {
        const double speed = simulation.velocity(grain).norm();
        return moreau::rendering::speed_color(speed / (3 * setup::rate * setup::radius));
      },
      picture);
}

template <class Shape>
bool run() {
  using S = moreau::SpaceOf<Shape>;
  constexpr int up = S::dim - 1;
  std::mt19937_64 random(1);
  moreau::Tolerances tolerances;
  tolerances.margin = 0.05;
  moreau::Simulation<Shape, Law> simulation(setup::size, moreau::Materials<Law>(1, Law(0.5)), {},
                                            tolerances);
  fill(simulation, moreau::ballast_shapes<Shape>(20, random));
  const typename S::Angular axis = S::Angular::Unit(S::angular_dim / 2);
  const auto drum = simulation.add_cylinder(S::Vector::Zero(), axis, setup::radius);
  for (int k = 1; k < up; ++k) simulation.set_periodic(k, 0, setup::slice);
  simulation.set_spin(drum, setup::rate * axis);
  simulation.set_gravity(-9.81 * S::Vector::Unit(up));

  moreau::CsvWriter table("drum.csv", {{"t", "s"}, {"angle", "degrees"}});
  double sum = 0;
  int count = 0, steps = 0, unsolved = 0;
  for (int step = 1; simulation.time() < setup::duration; ++step) {
    unsolved += !simulation.step(setup::h).solve.converged;
    ++steps;
    if (step % 20 != 0) continue;
    const double angle = angle_of_repose(simulation);
    table.row(simulation.time(), angle);
    if (simulation.time() > setup::warm_up) sum += angle, ++count;
  }
  moreau::write_paraview("drum", simulation, setup::h);
  draw(simulation);
  std::cout << simulation.grain_count() << " grains, angle of repose " << sum / count
            << " degrees; " << unsolved << " of " << steps << " steps not converged\n";
  // Expected for angular grains with mu = 0.5: more than the 25 degrees at which spheres flow, less
  // than the angle of a heap of bricks.
  return sum / count > 25 && sum / count < 45 && unsolved <= steps / 100;
}

int main() {
  return run<moreau::Polygon<double>>() ? 0 : 1;
}
