// SPDX-License-Identifier: MIT
// The part of check() about bonds: a call that made none, and strengths in another unit than N.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/ids.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The weight of the lightest grain that has a bond or had one, if its motion is not prescribed [N]; infinite if there
/// is none.
template <class Simulation>
[[gnu::cold]] double least_bonded_weight(const Simulation& simulation) {
  const auto& bodies = simulation.bodies();
  double least = std::numeric_limits<double>::infinity();
  const auto weigh = [&](BodyId id) {
    const std::size_t body = id.index();
    if (body >= bodies.size() || bodies.id[body] != id || !simulation.is_grain(body) ||
        bodies.is_prescribed(body))
      return;
    least = std::min(least, double(bodies.grain_mass[body] * simulation.gravity().norm()));
  };
  for (const auto& bond : simulation.bonds()) weigh(bond.a), weigh(bond.b);
  for (const auto& breakage : simulation.breakages()) weigh(breakage.a), weigh(breakage.b);
  return least;
}

/// The smallest tension of the laws of the pairs that have a bond or had one [N]; infinite if there is none.
template <class Simulation>
[[gnu::cold]] double least_tension(const Simulation& simulation) {
  const auto& bodies = simulation.bodies();
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](BodyId a, BodyId b) {
    if (!simulation.contains(a) || !simulation.contains(b)) return;
    const auto& law =
        simulation.materials()(bodies.material[a.index()], bodies.material[b.index()]);
    least = std::min(least, double(law.strength().tension));
  };
  for (const auto& bond : simulation.bonds()) look(bond.a, bond.b);
  for (const auto& breakage : simulation.breakages()) look(breakage.a, breakage.b);
  return least;
}

/// @param simulation under a law with bonds
template <class Simulation>
[[gnu::cold]] void check_bonds(Findings& found, const Simulation& simulation,
                               const StepReport& report) {
  if (report.bond_error > 1e-3 && report.solve.residual < report.bond_error) {
    // Bonds that bear next to nothing, as those of bodies that fall freely, may.
    const double error = report.bond_load * report.bond_error * least_tension(simulation);  // [N]
    if (error > 1e-3 * least_bonded_weight(simulation))
      found.say(
          "bonds bear % of their strength on average: their forces have the rounding of the "
          "strength and are known only to about % of themselves. Use double precision, or a "
          "smaller strength",
          {report.bond_load, report.bond_error});
  } else if (report.bond_error > 1e-3)
    found.say(
        "the forces of bonds are known only to about the residual %: structures of many bonds bend "
        "and break at wrong loads. Use a smaller tolerance and more sweeps: "
        "simulation.set_solver(moreau::ColouredGaussSeidel({.tolerance = 1e-6, .max_sweeps = "
        "20000}))",
        {report.bond_error});
  const double missed = double(simulation.missed_gap());
  if (simulation.missed_points() > 0)
    found.say(
        "bond_touching() has bonded nothing: pairs within the gap have at most % contact points, "
        "fewer than fewest_points. Call it with fewest_points = %, or place the bodies so that "
        "their faces lie on each other",
        {double(simulation.missed_points()), double(simulation.missed_points())});
  else if (std::isinf(missed))
    found.say(
        "bond_touching() has bonded nothing: no two bodies that it may bond were within the margin "
        "of % m. Place them so that they touch before the call",
        {simulation.tolerances().margin * double(simulation.grain_size())});
  else if (missed >= 0)
    found.say(
        "bond_touching() has bonded nothing: the smallest gap was % m. Place the bodies closer, or "
        "call it with a larger gap",
        {missed});
  const double tension = least_tension(simulation), weight = least_bonded_weight(simulation);
  if (tension < weight && std::isfinite(weight))
    found.say(
        "a bond of % N (BondStrength::tension) cannot carry the lightest grain that was bonded, "
        "which weighs % N. If it was meant as kN, write tension = %",
        {tension, weight, 1000 * tension});
}

}  // namespace moreau::detail
