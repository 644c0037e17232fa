// SPDX-License-Identifier: MIT
// The functions of Simulation that set a periodic cell and how it deforms.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/cell_control.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::set_periodic(int axis, Scalar lower,
                                                                      Scalar upper) {
  constexpr const char* self = "Simulation::set_periodic";
  require(assembly_.meshes().empty(), self, "axis", axis, "must be open, with mesh walls");
  PeriodicCell<S> cell = detector_.cell();
  cell.set(axis, lower, upper, self);
  const auto require_stays = [&](BodyId wall) {
    assembly_.require_walls_stay(cell, wall, this->spin(wall), self);
  };
  for (const BodyId wall : assembly_.walls()) require_stays(wall);
  for (const CylinderBody<S>& wall : assembly_.cylinders()) require_stays(wall.body);
  if constexpr (bonding) {
    const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon() *
                            (cell.length()[axis] + std::abs(cell.lower()[axis]));
    if (!(std::abs(cell.length()[axis] - detector_.cell().length()[axis]) <= rounding))
      for (Bond<S> bond : bonds()) {
        detail::count_cells(bond, bodies(), detector_.cell());
        require(
            bond.cells[axis] == 0, self, "axis", axis,
            "must stay as it is: a bond reaches across it, and would be stretched by the change");
      }
  }
  detector_.place_walls(assembly_.bodies().pose);
  detector_.set_cell(cell, lengths(), self);
  assembly_.note_all_placed();
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::set_cell(
    const Matrix& vectors,
    const VectorArgument<S>& lower) requires SetValuedLaw<Law, SpaceOf<ShapeT>> {
  constexpr const char* self = "Simulation::set_cell";
  require(assembly_.meshes().empty(), self, "cell", "(deforming)", "must be without mesh walls");
  PeriodicCell<S> cell;
  cell.set_vectors(vectors, lower, self);
  cell.reduce();  // an oblique cell may have more room
  if constexpr (bonding)
    for (Bond<S> bond : bonds()) {
      detail::count_cells(bond, bodies(), detector_.cell());
      const Vector before = detector_.cell().shift(bond.cells);
      detail::count_cells(bond, bodies(), cell);
      const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * cell.vectors().norm();
      require(
          (cell.shift(bond.cells) - before).norm() <= rounding, self, "vectors", vectors,
          "must be those before: a bond reaches across them, and would be stretched by the change");
    }
  detector_.place_walls(assembly_.bodies().pose);
  detector_.set_cell(cell, lengths(), self);
  cell_motion_ = {};
  assembly_.note_all_placed();
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::control_cell(
    const CellControl<S>& control) requires SetValuedLaw<Law, SpaceOf<ShapeT>> {
  constexpr const char* self = "Simulation::control_cell";
  require(cell().is_lattice(), self, "cell", "(none)", "must be one of set_cell()");
  control.check(self);
  if constexpr (!AttractiveLaw<Law, S>)
    for (int k = 0; k < S::dim; ++k)
      require(control.mass(k, k) == 0 || control.stress(k, k) >= 0, self, "stress", control.stress,
              "must pull no axis: compression is positive, and the law has no attraction");
  cell_motion_.set_control(control);
}

}  // namespace moreau
