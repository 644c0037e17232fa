// SPDX-License-Identifier: MIT
// Ten dice fall on a floor and come to rest.
#include <iostream>
#include <moreau/moreau.hpp>
#include <vector>

int main() {
  using Shape = moreau::Polyhedron<double>;  // moreau::Polygon<double> makes it a plane world
  using Law = moreau::SignoriniCoulomb<double>;
  using Vector = moreau::SpaceOf<Shape>::Vector;

  moreau::Simulation<Shape, Law> world(0.02, moreau::Materials<Law>(1, Law(0.4)));
  std::vector<Vector> corners;
  for (int k = 0; k < 8; ++k) corners.push_back(0.02 * Vector(k & 1, k >> 1 & 1, k >> 2));
  const moreau::ShapeId die = world.add_shape(Shape(corners));
  for (int k = 0; k < 10; ++k)
    world.add_grain(
        die, {{0.003 * (k % 3), 0, 0.03 + 0.03 * k}, moreau::Space<3>::exp({0.2 * k, 0, 0})}, 2700);
  world.add_wall({0, 0, 1}, {0, 0, 0});
  world.set_gravity({0, 0, -9.81});

  for (int step = 0; step < 2000; ++step) {
    const moreau::StepReport report = world.step(5e-4);
    if (step % 50 == 49)
      std::cout << report.points << " points, " << report.solve.sweeps << " sweeps, residual "
                << report.solve.residual << '\n';
  }
}
