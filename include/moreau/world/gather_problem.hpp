// SPDX-License-Identifier: MIT
// The contact problem of the last step of a simulation as matrices, to write to a file
// (io/fclib.hpp) or to pass to another solver (solve/proximal_solver.hpp). Not in moreau.hpp,
// because it includes Eigen's sparse matrices.
#pragma once

#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

/// The contact problem that the last step solved, in double: u = W r + b, where b contains the
/// velocity offset of the law (gap over step, restitution) and the impulse of adhesion. Contacts
/// that could not act in the step are left out. simulation.contacts().impulses solve the problem,
/// each in the frame of its contact, normal first [N s]; under adhesion, without the adhesion.
/// @param simulation with Coulomb's law, with adhesion or without
/// @returns a GatheredProblem, whose contacts are indices into simulation.contacts()
/// @throws std::invalid_argument if the contacts were read from a snapshot, or grains with contacts
///         were removed, and no step was made since
template <class ShapeT, class Law, class Integrator, class Broad, class Solver>
auto gather_problem(const Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation) requires
    CoulombLaw<Law, SpaceOf<ShapeT>> {
  require(simulation.contact_problem().size() == simulation.contacts().size(), "gather_problem",
          "contacts", simulation.contacts().size(),
          "must be those of a step made since they were read or grains were removed");
  return gather_problem(simulation.contact_problem(),
                        std::span<const Contact<SpaceOf<ShapeT>>>(simulation.contacts().points));
}

}  // namespace moreau
