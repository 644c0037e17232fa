// SPDX-License-Identifier: MIT
// What a Simulation does not allow, because of its law, its shape or an argument: a call ends in the sentence of one
// static_assert.
#pragma once

#include <concepts>
#include <cstddef>

#include "moreau/core/ids.hpp"
#include "moreau/detect/pairs/mesh_collidable.hpp"
#include "moreau/law/concepts.hpp"

namespace moreau::detail {

/// Declared only: never called.
template <class T>
T nothing();

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
template <class ShapeT>
BodyId refuse_mesh_wall() {
  static_assert(MeshCollidable<ShapeT>,
                "Simulation: grains of this shape cannot touch a mesh wall; balls, polygons, "
                "polyhedra, capsules, "
                "rounded shapes of these, OneOf and Compound of these can");
  return {};
}
template <class Simulation, class Number>
const Simulation& refuse_number() {
  static_assert(!std::floating_point<Number>,
                "Simulation(grain size, materials, ...): a number in place of the law; write "
                "moreau::SignoriniCoulomb<>(0.4), not 0.4");
  return nothing<const Simulation&>();
}

}  // namespace moreau::detail
