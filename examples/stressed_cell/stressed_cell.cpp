// SPDX-License-Identifier: MIT
// A hundred disks without walls: the stress of the cell compresses them on all sides, then they are sheared. With
// Ball<> in place of Disk<> they are balls in space (then make `side` 6). Units: diameter, density and stress are 1.
#include <cmath>
#include <cstdio>
#include <moreau/moreau.hpp>
#include <random>

#include "moreau/law/compliant.hpp"

using Shape = moreau::Disk<>;
using S = moreau::SpaceOf<Shape>;
using Law = moreau::Compliant<moreau::SignoriniCoulomb<>>;

int main() {
  const double friction = 0.4, stiffness = 2000;
  const Law law(moreau::SignoriniCoulomb<>(friction), stiffness, stiffness / 2);
  moreau::Simulation<Shape, Law> simulation(1, moreau::Materials<Law>(1, law));
  const int side = 10;
  const double spacing = 1.3;  // more than the largest diameter
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(0.4, 0.6);
  for (int k = 0; k < std::pow(side, S::dim); ++k) {
    S::Vector centre;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side)
      centre[axis] = spacing * (rest % side + 0.5);
    simulation.add_grain(simulation.add_shape(Shape(radius(random))), moreau::Pose<S>(centre), 1);
  }
  double mass = 0;
  for (const double one : simulation.bodies().grain_mass) mass += one;
  simulation.set_cell(spacing * side * S::Matrix::Identity());
  const auto print = [&](const S::Matrix& stress) {
    const S::Matrix deformation = simulation.cell_motion().deformation();
    std::printf("strain %.2f: solid fraction %.3f, pressure %.3f, friction %.3f\n",
                deformation(0, 1) / deformation(1, 1), mass / simulation.cell().volume(),
                stress(1, 1), -(stress(0, 1) + stress(1, 0)) / 2 / stress(1, 1));
  };
  const auto run = [&](int steps) {
    S::Matrix mean = S::Matrix::Zero();
    for (int k = 0; k < steps; ++k) {
      simulation.step(0.02);
      mean += simulation.cell_motion().stress() / steps;
    }
    print(mean);
  };

  moreau::CellControl<S> compress;
  compress.mass = mass * S::Matrix::Identity();  // these components move by their stress
  compress.stress = S::Matrix::Identity();
  compress.damping = 0.1;
  simulation.control_cell(compress);
  for (int k = 0; k < 3000; ++k) simulation.step(0.02);
  run(100);

  moreau::CellControl<S> shear;
  shear.rate(0, 1) = 0.05;  // along x with y; all components but the next are held
  shear.mass(1, 1) = mass;
  shear.stress(1, 1) = 1;
  shear.damping = 0.1;
  simulation.control_cell(shear);
  for (int k = 0; k < 8; ++k) run(500);  // a strain of 0.5 each
}
