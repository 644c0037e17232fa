// SPDX-License-Identifier: MIT
// Ten grains fall on a floor and come to rest.
#include <iostream>
#include <moreau/measure/check.hpp>
#include <moreau/moreau.hpp>

int main() {
  // Or moreau::Polygon<double>, moreau::Ball<double>, moreau::Disk<double>:
  using Shape = moreau::Polyhedron<double>;
  using S = moreau::SpaceOf<Shape>;
  using Law = moreau::SignoriniCoulomb<double>;
  const S::Vector aside = S::Vector::UnitX(), up = S::Vector::Unit(S::dim - 1);

  // Grains of 2 cm, which all tolerances are relative to; one material with friction 0.4.
  moreau::Simulation<Shape, Law> simulation(0.02, Law(0.4));
  const moreau::ShapeId shape = simulation.add_shape(moreau::regular_shape<Shape>(0.02));
  for (int k = 0; k < 10; ++k) {
    const S::Vector position = 0.003 * (k % 3) * aside + (0.03 + 0.03 * k) * up;
    simulation.add_grain(shape, {position, S::exp(S::Angular::Constant(0.2 * k))}, 2700);  // kg/m^3
  }
  simulation.add_wall(up, S::Vector::Zero());
  simulation.set_gravity(-9.81 * up);

  for (int step = 0; step < 10000; ++step) {
    const moreau::StepReport report = simulation.step(1e-4);  // s
    if (step % 250 != 249) continue;
    std::cout << report.points << " points, " << report.solve.sweeps << " sweeps, residual "
              << report.solve.residual << '\n';
    for (const std::string& warning : moreau::check(simulation, report))
      std::cerr << warning << '\n';
  }
}
