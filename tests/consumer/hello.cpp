// SPDX-License-Identifier: MIT
#include <iostream>
#include <moreau/moreau.hpp>

int main() {
  std::cout << "moreau " << MOREAU_VERSION_STRING << '\n';
}
