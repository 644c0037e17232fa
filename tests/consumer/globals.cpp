// SPDX-License-Identifier: MIT
// Global variables of a user that have the same names as variables inside the library.
inline double size = 1, x = 0, y = 0, k = 0, mass = 1, gap = 0, normal = 0, offset = 0;

#include <iostream>
#include <moreau/moreau.hpp>

inline int shape = 0, rank = 0, points = 0, friction = 0, radius = 0;
inline int count() {
  return 0;
}

int main() {
  using Law = moreau::SignoriniCoulomb<>;
  moreau::Simulation<moreau::Disk<>, Law> world(size, moreau::Materials<Law>(1, Law(0.4)));
  world.add_grain(world.add_shape(moreau::Disk<>(size)), {}, mass);
  world.step(0.1);
  std::cout << "moreau " << MOREAU_VERSION_STRING << '\n';
  return world.time() > 0 ? 0 : 1;
}
