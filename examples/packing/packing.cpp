// SPDX-License-Identifier: MIT
// Fills a box with random polyhedra of three sizes, lets them fall, and stops when the packing is at
// rest. Prints the state every 0.1 s of simulated time, then solid fraction, number of
// neighbours and overlap, and writes packing.snapshot, from which another program can continue.
// Returns 0 if the packing came to rest.
#include <cmath>
#include <cstddef>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"

// Or moreau::Polygon<double>, moreau::Ball<double>, moreau::Disk<double>:
using Shape = moreau::Polyhedron<double>;
using S = moreau::SpaceOf<Shape>;
using Vector = S::Vector;
using Law = moreau::SignoriniCoulomb<double>;
using Simulation = moreau::Simulation<Shape, Law>;

constexpr double width = 0.15, density = 2700;  // of the box [m]; of the grains [kg/m^3]
constexpr double gravity = 9.81, h = 5e-4;      // [m/s^2], [s]

/// Adds the floor and the side walls of an open box. The last axis is the vertical.
void add_box(Simulation& simulation) {
  for (int axis = 0; axis < S::dim; ++axis) simulation.add_wall(Vector::Unit(axis), Vector::Zero());
  for (int axis = 0; axis < S::dim - 1; ++axis)
    simulation.add_wall(-Vector::Unit(axis), width * Vector::Unit(axis));
  simulation.set_gravity(-gravity * Vector::Unit(S::dim - 1));
}

/// Adds grains of random shapes, sizes, places and rotations. They do not touch.
void add_grains(Simulation& simulation, const moreau::SizeDistribution& distribution,
                std::size_t count) {
  std::mt19937_64 random(1);
  std::vector<double> radii;  // of the circumscribed spheres [m]
  std::vector<moreau::ShapeId> shapes;
  for (const double diameter : distribution.sample(count, random)) {
    radii.push_back(diameter / 2);
    const Shape shape = moreau::Ballast<Shape>::draw(random);  // its circumradius is 1
    shapes.push_back(simulation.add_shape(shape.scaled(diameter / 2)));
  }
  const std::vector<moreau::Pose<S>> poses = moreau::random_deposition<S>(radii, width, random);
  for (std::size_t k = 0; k < count; ++k) simulation.add_grain(shapes[k], poses[k], density);
}

/// Weight of all grains [N].
double weight(const Simulation& simulation) {
  double mass = 0;
  for (const double grain : simulation.bodies().grain_mass) mass += grain;
  return mass * gravity;
}

/// Force by which floor and side walls carried the grains in the last step, upwards [N].
double carried(const Simulation& simulation) {
  double impulse = 0;
  for (const moreau::BodyId wall : simulation.walls())
    impulse -= simulation.contact_impulse(wall)[S::dim - 1];
  return impulse / h;
}

/// Whether the step was solved, the grains are slow, and floor and walls carry the whole weight. The
/// grains are slow if their kinetic energy would lift them by less than 1e-5 of the smallest grain.
bool is_calm(const Simulation& simulation, const moreau::StepReport& report) {
  const double load = weight(simulation);
  return report.solve.converged &&
         moreau::kinetic_energy(simulation).total() <= 1e-5 * load * simulation.grain_size() &&
         std::abs(carried(simulation) - load) <= 0.01 * load;
}

/// Prints the solid fraction inside the packing and the mean number of neighbours.
void print(const Simulation& simulation) {
  moreau::Aabb<S> inner{Vector::Constant(0.03), Vector::Constant(width - 0.03)};
  inner.upper[S::dim - 1] = 0.09;  // below the surface of the packing
  std::cout << "solid fraction " << moreau::solid_fraction(simulation, inner)
            << ", mean number of neighbours " << moreau::coordination(simulation, 2).neighbours
            << '\n';
}

int main() {
  moreau::Tolerances tolerances;
  tolerances.margin = 0.08;  // of the grain size: in one step a falling grain moves by up to 1.5 mm
  Simulation simulation(0.02, moreau::Materials<Law>(1, Law(0.4)), {}, tolerances);
  add_box(simulation);
  add_grains(simulation, moreau::SizeDistribution({{0.02, 0.5}, {0.03, 0.3}, {0.04, 0.2}}), 300);

  // The packing is at rest if 100 steps in a row were calm.
  int calm = 0;
  double overlap = 0;
  for (int step = 1; calm < 100 && simulation.time() < 5; ++step) {
    const moreau::StepReport report = simulation.step(h);
    calm = is_calm(simulation, report) ? calm + 1 : 0;
    overlap = report.max_overlap;
    if (step % 200 == 0)
      std::cout << "t = " << simulation.time() << " s: kinetic energy "
                << moreau::kinetic_energy(simulation).total() << " J, carried "
                << carried(simulation) / weight(simulation) << " of the weight\n";
  }
  const bool at_rest = calm >= 100;
  std::cout << (at_rest ? "at rest" : "not at rest") << " at t = " << simulation.time()
            << " s; largest overlap " << overlap / simulation.grain_size()
            << " of the smallest grain\n";
  print(simulation);
  moreau::write_snapshot("packing.snapshot", simulation);
  return at_rest ? 0 : 1;
}
