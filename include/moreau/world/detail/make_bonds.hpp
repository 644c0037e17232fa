// SPDX-License-Identifier: MIT
// The functions of Simulation that make bonds.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond_touching(
    Scalar gap, std::span<const BodyId> among) requires BondingLaw<Law, SpaceOf<ShapeT>> {
  constexpr const char* self = "Simulation::bond_touching";
  require(gap >= 0 && gap <= lengths().margin, self, "gap", gap, "must lie in [0, margin]");
  std::vector<bool> listed(bodies().size(), among.empty());
  for (const BodyId body : among) {
    assembly_.require_body(body, self);
    listed[body.index()] = true;
  }
  return add_bonds([&](const Contact<S>& contact) {
    return contact.gap <= gap && listed[contact.a] && listed[contact.b];
  });
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond(BodyId a, BodyId b) requires
    BondingLaw<Law, SpaceOf<ShapeT>> {
  constexpr const char* self = "Simulation::bond";
  assembly_.require_body(a, self);
  assembly_.require_body(b, self);
  const auto is_pair = [&](BodyId first, BodyId second) {
    return (first == a && second == b) || (first == b && second == a);
  };
  for (const Bond<S>& one : bonds())
    if (is_pair(one.a, one.b)) return;
  const std::size_t made = add_bonds([&](const Contact<S>& contact) {
    return is_pair(bodies().id[contact.a], bodies().id[contact.b]);
  });
  require(made == 1, self, "b", b, "must be within the margin of a, and one of them free to move");
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_bonds(const auto& keeps) {
  ContactsOf<Law, S> touching;
  detector_.place(std::span<const Pose<S>>(bodies().pose),
                  [&](std::size_t k) -> const ShapeT& { return assembly_.shape_of_grain(k); });
  const Matrix vectors = cell().vectors();
  detector_.find_pairs(lengths());
  if (cell().is_lattice()) dynamics_.bonds().recount_cells(vectors, cell());
  detector_.use_whole_margin();
  detector_.detect(lengths(), bodies(), contacts_, touching);
  return dynamics_.bonds().add(bodies(), cell(), touching, keeps);
}

}  // namespace moreau
