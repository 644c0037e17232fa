// SPDX-License-Identifier: MIT
// The contact problem of a simulation's last step as matrices: to be written to a file
// (io/fclib.hpp) or handed to another solver (solve/proximal_solver.hpp). Not in moreau.hpp: it
// brings Eigen's sparse matrices.
#pragma once

#include "moreau/core/error.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

/// The problem that the last step solved, in double: u = W r + b with what the law adds to b (gap
/// over step, restitution). Its contacts are numbers into simulation.contacts(); those that could
/// not act are left out. The impulses that solve it are those of simulation.contacts(), each in its
/// contact's frame, normal first [N s]; under adhesion without the adhesion, whose impulse b has.
/// @param simulation with Coulomb's law, with adhesion or without
/// @returns a GatheredProblem
/// @throws std::invalid_argument if the contacts were read from a snapshot and no step was made
///         since
template <class ShapeT, class Law, class Integrator, class Broad, class Solver>
auto contact_problem(const Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation) requires
    CoulombLaw<Law, SpaceOf<ShapeT>> {
  return simulation.visit_contact_problem([&](const auto& op, auto laws, auto law_of) {
    require(op.size() == simulation.contacts().size(), "contact_problem", "contacts",
            simulation.contacts().size(), "must be those of a step made since they were read");
    return gather_problem(op, laws, law_of);
  });
}

}  // namespace moreau
