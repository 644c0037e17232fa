// SPDX-License-Identifier: MIT
// Concave grains: letters L and clumps of balls, each made of convex parts, fall into a box and interlock.
#include <iostream>
#include <moreau/measure/check.hpp>
#include <moreau/moreau.hpp>

namespace {

/// The letter L of two rectangles [m].
moreau::Compound<moreau::Polygon<double>> letter(moreau::Space<2>) {
  const moreau::Polygon<double> foot({{0, 0}, {0.02, 0}, {0.02, 0.01}, {0, 0.01}});
  const moreau::Polygon<double> leg({{0, 0.01}, {0.01, 0.01}, {0.01, 0.03}, {0, 0.03}});
  return moreau::Compound<moreau::Polygon<double>>({foot, leg});
}
/// The same letter, 1 cm thick.
moreau::Compound<moreau::Polyhedron<double>> letter(moreau::Space<3>) {
  const auto box = [](double x, double z, double low) {
    return moreau::Polyhedron<double>({{0, 0, low},
                                       {x, 0, low},
                                       {0, 0.01, low},
                                       {x, 0.01, low},
                                       {0, 0, z},
                                       {x, 0, z},
                                       {0, 0.01, z},
                                       {x, 0.01, z}});
  };
  return moreau::Compound<moreau::Polyhedron<double>>({box(0.02, 0.01, 0), box(0.01, 0.03, 0.01)});
}

/// Lets twelve letters fall on a floor. Prints the contact points of the last step.
template <class S>
void run() {
  using Shape = decltype(letter(S{}));
  using Law = moreau::SignoriniCoulomb<double>;
  const typename S::Vector up = S::Vector::Unit(S::dim - 1), aside = S::Vector::UnitX();
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  moreau::Simulation<Shape, Law> simulation(0.01, Law(0.5), {}, tolerances);
  const moreau::ShapeId shape = simulation.add_shape(letter(S{}));
  for (int k = 0; k < 12; ++k)
    simulation.add_grain(
        shape,
        {(0.04 + 0.04 * k) * up + 0.005 * (k % 3) * aside, S::exp(S::Angular::Constant(0.7 * k))},
        2700);
  simulation.add_wall(up, S::Vector::Zero());
  simulation.set_gravity(-9.81 * up);
  moreau::StepReport report;
  for (int step = 0; step < 2000; ++step) report = simulation.step(5e-4);
  std::cout << S::dim << "D: " << report.points << " points of " << report.pairs
            << " pairs of grains; the first is between part "
            << simulation.contacts().keys[0].part_a << " of body "
            << simulation.contacts().keys[0].a << " and body " << simulation.contacts().keys[0].b
            << '\n';
  for (const std::string& warning : moreau::check(simulation, report)) std::cerr << warning << '\n';
}

}  // namespace

int main() {
  run<moreau::Space<2>>();
  run<moreau::Space<3>>();
}
