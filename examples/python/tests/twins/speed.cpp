// SPDX-License-Identifier: MIT
// Milliseconds per step of the packing in a snapshot, polyhedra under Coulomb's law: the C++ side of speed.py.
// Arguments: snapshot, grain size [m], step [s], steps. Prints the time of each step.
#include <chrono>
#include <cstdlib>
#include <iostream>

#include "moreau/io/snapshot.hpp"

#include "engine.hpp"

int main(int count, char** arguments) {
  if (count != 5) return 2;
  using Law = moreau::SignoriniCoulomb<double>;
  moreau::Simulation<moreau::Polyhedron<double>, Law> simulation(
      std::strtod(arguments[2], nullptr), moreau::Materials<Law>(1, Law(0.4)));
  moreau::read_snapshot(arguments[1], simulation);
  const double h = std::strtod(arguments[3], nullptr);
  for (long k = std::strtol(arguments[4], nullptr, 10); k > 0; --k) {
    const auto start = std::chrono::steady_clock::now();
    simulation.step(h);
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    std::cout << passed.count() << '\n';
  }
}
