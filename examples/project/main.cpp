// SPDX-License-Identifier: MIT
// Fifty cubes fall into a box and come to rest.
#include <iostream>
#include <moreau/measure/check.hpp>
#include <moreau/measure/rest_test.hpp>
#include <moreau/moreau.hpp>
#ifdef WITH_PICTURE
#include <moreau/picture/write_picture.hpp>
#endif

int main() {
  // Or moreau::Polygon<double>; moreau::Ball<double> and moreau::Disk<double>, which roll on for a while:
  using Shape = moreau::Polyhedron<double>;
  using S = moreau::SpaceOf<Shape>;
  using Law = moreau::SignoriniCoulomb<double>;
  constexpr double size = 0.02, width = 7.5 * size, h = 5e-4;  // [m], [m], [s]
  constexpr int up = S::dim - 1;

  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;  // of the grain size
  moreau::Simulation<Shape, Law> simulation(size, Law(0.4), {}, tolerances);
  const moreau::ShapeId shape = simulation.add_shape(moreau::regular_shape<Shape>(size));
  for (int k = 0; k < 50; ++k) {
    S::Vector x = S::Vector::Zero();
    int place = k;
    for (int axis = 0; axis < S::dim; ++axis, place /= 4)
      x[axis] = size * (1.8 * (axis < up ? place % 4 : place) + 1 + 0.01 * (k % 7));
    simulation.add_grain(shape, {x, S::exp(S::Angular::Constant(0.2 * k))}, 2700);
  }
  for (int axis = 0; axis < S::dim; ++axis) {
    const S::Vector normal = S::Vector::Unit(axis);
    simulation.add_wall(normal, S::Vector::Zero());
    if (axis < up) simulation.add_wall(-normal, width * normal);
  }
  simulation.set_gravity(-9.81 * S::Vector::Unit(up));

  moreau::RestTest rest;
  moreau::StepReport report;
  do report = simulation.step(h);
  while (!rest.add(simulation, report, h) && simulation.time() < 5);
  std::cout << "t = " << simulation.time() << " s: " << report.points
            << " contact points, residual " << report.solve.residual << ' ' << rest.reason()
            << '\n';
  for (const std::string& warning : moreau::check(simulation, report)) std::cerr << warning << '\n';
#ifdef WITH_PICTURE
  moreau::write_picture("grains.png", simulation);
#endif
}
