// SPDX-License-Identifier: MIT
#include <iostream>
#include <moreau/moreau.hpp>

std::size_t pairs_of_another_unit(const moreau::Contacts<moreau::Space<2>>& contacts);

int main() {
  std::cout << "moreau " << MOREAU_VERSION_STRING << '\n';
  return pairs_of_another_unit({}) == 0 ? 0 : 1;
}
