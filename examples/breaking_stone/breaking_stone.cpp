// SPDX-License-Identifier: MIT
// A ballast stone is crushed between two plates, in the plane and in space from one source. The stone is a Compound; its
// parts become grains that bonds hold together. The program prints, over the displacement of the upper plate, the force
// on it, the bonds, the mean share of their strength that is left, and the number of fragments.
//
//   breaking_stone [folder for files of ParaView]
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <string>

#include "moreau/io/write_paraview.hpp"
#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/measure/bond_state.hpp"
#include "moreau/sample/bonded_parts.hpp"
#include "moreau/sample/compound_ballast.hpp"

namespace {

using Law = moreau::Compliant<moreau::Bonded<double>>;
constexpr double size = 0.02;                                          // radius of the stone [m]
constexpr double stiffness = 1e7;                                      // [N/m]
constexpr moreau::BondStrength<double> strength{400, 400, 400, 0.02};  // [N], [J]
constexpr double speed = 0.05, step = 2e-5;                            // of the plate [m/s]; [s]

template <class Part>
void crush(const char* name, const std::string& folder) {
  using S = moreau::SpaceOf<Part>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  const Law law(moreau::Bonded<double>(strength, 0.5), stiffness, stiffness / 2);
  moreau::Simulation<Part, Law> simulation(size / 2, moreau::Materials<Law>(1, law));
  std::mt19937_64 random(7);
  const auto stone = moreau::ballast_shapes<moreau::Compound<Part>>(1, random)[0].scaled(size);
  const auto parts = moreau::add_bonded_parts(simulation, stone, moreau::Pose<S>(), 2700,
                                              moreau::MaterialId(0), 1e-6);
  const auto box = stone.bounding_box(moreau::Pose<S>());
  simulation.add_wall(up, box.lower);
  const moreau::BodyId plate = simulation.add_wall(-up, box.upper);
  simulation.set_velocity(plate, -speed * up);
  std::printf("# %s: %zu parts, %zu bonds\n", name, parts.size(), simulation.bonds().size());
  std::printf("# displacement [mm], force [N], bonds, strength left, fragments\n");
  const int steps = 4000, rows = 100;
  double largest = 0, force = 0;
  for (int k = 1; k <= steps; ++k) {
    simulation.step(step);
    force = simulation.contact_impulse(plate).dot(up) / step;
    largest = std::max(largest, force);
    if (k % (steps / rows) != 0) continue;
    const moreau::BondState state = moreau::bond_state(simulation);
    std::printf("%6.3f %9.1f %3zu %6.3f %3zu\n", 1e3 * speed * simulation.time(), force,
                state.bonds, state.strength_left, state.fragments);
    if (!folder.empty())
      moreau::write_paraview(
          std::filesystem::path(folder) / (name + std::to_string(k * rows / steps)), simulation,
          step);
  }
  std::printf("# largest force %.1f N, ", largest);
  if (simulation.breakages().empty())
    std::printf("no bond broke\n\n\n");
  else
    std::printf("first bond broke at %.3f mm\n\n\n", 1e3 * speed * simulation.breakages()[0].time);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string folder = argc > 1 ? argv[1] : "";
    if (!folder.empty()) std::filesystem::create_directories(folder);
    crush<moreau::Polygon<>>("polygons", folder);
    crush<moreau::Polyhedron<>>("polyhedra", folder);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
