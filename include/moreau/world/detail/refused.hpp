// SPDX-License-Identifier: MIT
// What the law of a Simulation does not allow: a call ends in the sentence of one static_assert.
#pragma once

#include <cstddef>

#include "moreau/law/concepts.hpp"

namespace moreau::detail {

template <class Law, class S>
std::size_t refuse_bonds() {
  static_assert(
      BondingLaw<Law, S>,
      "Simulation: the law has no bonds, so that bond() and bond_touching() have none to make; use "
      "moreau::Bonded<> or moreau::Compliant<moreau::Bonded<>> (moreau/law/bonded.hpp)");
  return 0;
}
template <class Law, class S>
void refuse_cell() {
  static_assert(
      SetValuedLaw<Law, S>,
      "Simulation: a cell of set_cell() needs a law for impulses, such as "
      "moreau::Compliant<moreau::SignoriniCoulomb<>>; under a regularized law use set_periodic()");
}

}  // namespace moreau::detail
