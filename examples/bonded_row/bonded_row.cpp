// SPDX-License-Identifier: MIT
// A row of ten bonded disks, held at its first disk. A force across the last one grows until a bond breaks. With
// Ball<> in place of Disk<> it is a row of balls in space.
#include <cstdio>
#include <moreau/moreau.hpp>

#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"

using Shape = moreau::Disk<>;
using S = moreau::SpaceOf<Shape>;
using Law = moreau::Compliant<moreau::Bonded<>>;

int main() {
  const double radius = 0.01, normal_stiffness = 1e7, tangential_stiffness = 5e6;  // [m], [N/m]
  const moreau::BondStrength<> strength{100, 80, 60};  // tension, shear, bending [N]
  moreau::ColouredOptions accurate;
  accurate.tolerance = 1e-10;  // errors of the bonds of a row add up
  accurate.max_sweeps = 20000;
  const Law law(moreau::Bonded<>(strength, 0.4), normal_stiffness, tangential_stiffness);
  moreau::Simulation<Shape, Law> simulation(2 * radius, moreau::Materials<Law>(1, law),
                                            moreau::ColouredGaussSeidel(accurate));
  const moreau::ShapeId shape = simulation.add_shape(Shape(radius));
  for (int k = 0; k < 10; ++k)
    simulation.add_grain(shape, moreau::Pose<S>(S::Vector(2 * radius * k * S::Vector::UnitX())),
                         2700);
  const moreau::BodyId first = simulation.grains().front(), last = simulation.grains().back();
  simulation.prescribe_motion(first);
  simulation.bond_touching(1e-6);  // all pairs with a gap of at most 1e-6 m

  std::puts("force [N]  deflection [mm]");
  for (double force = 0.2;; force += 0.2) {
    simulation.set_force(last, S::Vector(-force * S::Vector::UnitY()));
    for (int k = 0; k < 50; ++k) simulation.step(0.05);  // until the row has come to rest
    if (!simulation.breakages().empty()) break;
    std::printf("%9.1f  %15.4f\n", force, -1e3 * simulation.pose(last).position.y());
  }
  const moreau::Breakage& broken = simulation.breakages().front();
  std::printf("grains %u and %u lost their bond at %.2f s; %zu bonds are left\n",
              unsigned(broken.a.index()), unsigned(broken.b.index()), broken.time,
              simulation.bonds().size());
}
