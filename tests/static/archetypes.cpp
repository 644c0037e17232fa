// SPDX-License-Identifier: MIT
// A simulation requires of its policies only what their concepts require: it compiles with
// archetypes.
#include "static/archetypes.hpp"

#include "moreau/world/simulation.hpp"

namespace {

using moreau::Simulation;
using moreau::Space;

static_assert(moreau::BroadPhase<archetypes::MinimalBroadPhase<Space<2>>, Space<2>>);
static_assert(moreau::RegularizedLaw<archetypes::MinimalSprings<Space<2>>, Space<2>>);
static_assert(moreau::ForceIntegrator<archetypes::MinimalForceIntegrator<Space<2>>, Space<2>>);

static_assert(moreau::ContactSolver<archetypes::MinimalSolver, archetypes::MinimalLaw, Space<3>>);
static_assert(moreau::ContactSolver<moreau::ColouredGaussSeidel, archetypes::MinimalLaw, Space<3>>);

template <class World>
void run(World& world) {
  using S = typename World::S;
  const auto shape = world.add_shape(archetypes::MinimalConvex<S>());
  world.add_grain(shape, moreau::Pose<S>(), 1000);
  world.add_wall(S::Vector::UnitX(), S::Vector::Zero());
  world.step(1e-3);
}

}  // namespace

void compile_only() {
  Simulation<archetypes::MinimalConvex<Space<3>>, archetypes::MinimalLaw,
             archetypes::MinimalIntegrator<Space<3>>, archetypes::MinimalBroadPhase<Space<3>>,
             archetypes::MinimalSolver>
      impulses(0.01, moreau::Materials<archetypes::MinimalLaw>(1, {}));
  run(impulses);
  using Springs = archetypes::MinimalSprings<Space<2>>;
  Simulation<archetypes::MinimalConvex<Space<2>>, Springs,
             archetypes::MinimalForceIntegrator<Space<2>>, archetypes::MinimalBroadPhase<Space<2>>>
      forces(0.01, moreau::Materials<Springs>(1, {}));
  run(forces);
}
