// SPDX-License-Identifier: MIT
// The part of check() about bonds: a call that made none, and strengths in another unit than N.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/ids.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/world/bond.hpp"
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

/// Says which bond is so long that it is none in the sense of a user: soft springs, a fracture energy in another unit, or
/// two bodies whose motions are prescribed.
template <class Simulation>
[[gnu::cold]] void check_stretch(Findings& found, const Simulation& simulation) {
  const double size = double(simulation.grain_size());
  double most = 0;
  BodyId a, b;
  for (const auto& bond : simulation.bonds()) {
    const auto at = place_of(bond, simulation.bodies(), simulation.cell().shift(bond.cells));
    const double stretch = double(at.stretch.norm());
    if (stretch > most) most = stretch, a = bond.a, b = bond.b;
  }
  if (!(most > size / 2)) return;
  found.say(
      "the bond of the bodies % and % is stretched by % m, % times the grain size. Its springs are "
      "too soft, its fracture energy too large (in J for each bond, not J/m^2), or the motion of "
      "both is prescribed",
      {double(a.index()), double(b.index()), most, most / size});
}

/// @param simulation under a law with bonds
template <class Simulation>
[[gnu::cold]] void check_bonds(Findings& found, const Simulation& simulation,
                               const StepReport& report) {
  if (report.bond_error > 1e-3 && report.solve.residual < report.bond_error) {
    // Bonds that bear next to nothing may, as those of bodies that fall freely or, in double precision, without gravity.
    constexpr double rounding = 1e-13;
    const double error = report.bond_load * report.bond_error * least_tension(simulation);  // [N]
    const double weight = least_bonded_weight(simulation);
    if (error > 1e-3 * weight && (weight > 0 || report.bond_load > rounding))
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
  check_stretch(found, simulation);
}

/// Says which bridges reach so far that their volume has another unit.
/// @param simulation under a law with bridges
template <class Simulation>
[[gnu::cold]] void check_bridges(Findings& found, const Simulation& simulation) {
  const double size = double(simulation.grain_size());
  double reach = 0;
  for (const auto& law : simulation.materials().laws())
    reach = std::max(reach, double(law.reach()));
  if (reach > size / 2)
    found.say(
        "bridges reach % m before they break, % times the grain size: the volume of a capillary "
        "bridge is in m^3 (1 mm^3 is 1e-9) and at most a thousandth of the cube of a radius, the "
        "range of a linear one in m",
        {reach, reach / size});
}

}  // namespace moreau::detail
