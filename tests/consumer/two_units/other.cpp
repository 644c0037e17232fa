// SPDX-License-Identifier: MIT
// A second translation unit with the same headers. It tests that no definition in them is
// duplicated.
#include <moreau/measure/pair_forces.hpp>
#include <moreau/moreau.hpp>

std::size_t pairs_of_another_unit(const moreau::Contacts<moreau::Space<2>>& contacts) {
  std::vector<moreau::PairForce<moreau::Space<2>>> pairs;
  moreau::pair_forces(contacts, 1.0, pairs);
  return pairs.size();
}
