// SPDX-License-Identifier: MIT
// The constructors, assignments and the destructor of Simulation.
#pragma once

#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/detail/policies.hpp"
#include "moreau/world/simulation.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>::Simulation(Scalar grain_size,
                                                               const Materials<Law>& materials,
                                                               const Tolerances& tolerances,
                                                               const Parts& parts)
    : grain_size_(grain_size),
      tolerances_(tolerances),
      materials_(materials),
      reach_(detail::reach_of<S>(materials)),
      dynamics_(std::make_from_tuple<Dynamics>(parts)) {
  // Not in the class, where further errors would hide the reason.
  static_assert(sizeof(detail::Policies<S, Law, Integrator, Broad, Solver>) > 0);
  require_positive(grain_size, "Simulation", "grain_size");
  tolerances.check("Simulation");
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>::Simulation(const Simulation&) = default;

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>::Simulation(Simulation&&) = default;

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>&
Simulation<ShapeT, Law, Integrator, Broad, Solver>::operator=(const Simulation&) = default;

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>&
Simulation<ShapeT, Law, Integrator, Broad, Solver>::operator=(Simulation&&) = default;

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
Simulation<ShapeT, Law, Integrator, Broad, Solver>::~Simulation() = default;

}  // namespace moreau
