// SPDX-License-Identifier: MIT
// Settings of a simulation that give results which look right and are wrong.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "moreau/measure/detail/check_bonds.hpp"
#include "moreau/measure/detail/check_creep.hpp"
#include "moreau/measure/detail/check_meshes.hpp"
#include "moreau/measure/detail/check_motion.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/measure/detail/check_units.hpp"
#include "moreau/measure/detail/lost_grain.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// Passes each kind of sentence of check() once. The sentences have numbers of the step in them, so a log that compares
/// whole sentences repeats them in every step; here two sentences are of one kind if they differ in numbers only.
///
///     moreau::SentencesOnce once;
///     for (...)
///       for (const std::string& sentence : once(moreau::check(simulation, simulation.step(h))))
///         std::cerr << sentence << '\n';
class SentencesOnce {
 public:
  /// The sentences of a kind that no sentence before had, in the same order.
  std::vector<std::string> operator()(const std::vector<std::string>& sentences) {
    std::vector<std::string> fresh;
    for (const std::string& sentence : sentences)
      if (seen_.insert(detail::without_numbers(sentence)).second) fresh.push_back(sentence);
    return fresh;
  }

 private:
  std::set<std::string> seen_;
};

/// Judges the last step of a simulation.
///
///     for (const std::string& sentence : moreau::check(simulation, report))
///       std::cerr << sentence << '\n';
///
/// @param simulation after step()
/// @param report     what step() returned
/// @returns one sentence with numbers for each of the following faults; empty if there are none:
///          - the surfaces of a contact that was found approached by more than the margin
///            in the step: others may have been missed
///          - the smallest grain whose motion is not prescribed is five times smaller or larger than the grain size, to which all
///            tolerances are relative. A plate or a stick among the grains allows a grain size down to its thickness
///          - an overlap beyond 1 % of the grain size; two bodies are named. The sentence tells an overlap at the
///            start (grains were added inside one another), one that arose in the step (a fast approach: the step
///            is too long), and one that is older, with a body of prescribed motion that presses, or with a
///            mesh wall through which a grain came from behind
///          - the displacement of bodies by the overlap correction was limited
///          - the solver did not reach its tolerance
///          - small structures (islands) whose velocities have an error above the tolerance
///          - bodies at rest on each other, up to 200, whose velocities the direct method does not judge (a law with a solve() of its
///            own, islands = false), and which can creep by more than 1 % of the grain size per second
///          - bonds: their forces are known to less than three digits (StepReport::bond_error); the last call of
///            bond_touching() made none, and there is none; their tension does not carry the weight of a bonded grain (kN);
///            one is longer than half the grain size
///          - bridges that reach farther than half the grain size (mm^3)
///          - compliant contacts: the residual is not small against relative_compliance, so that the
///            forces are not accurate to 10 %
///          - numbers that look like other units. With a gravity between 9 and 11 m/s^2: a density below
///            12 (2.7 g/cm^3 are 2700 kg/m^3), grains all wider than 4 m (mm). A density above 25,000, a
///            gravity of 981 or 9810 (cm/s^2, mm/s^2), a friction from 5 to 90 (degrees). A step so
///            long that gravity moves a grain at rest by more than a fifth of its size (ms)
///          - an attraction is not 0 at the margin of detection, where it ends, and its law has no function range()
///          - gravity points along the last axis, or along another one that is not periodic, and no wall and no obstacle
///            lies there
///          - a force or torque on a body whose motion is prescribed, as that of a wall without a mass, or along a wall that
///            has one; the motion of all bodies is prescribed
///          - a wall with a mass has passed a parallel wall that faces it; two walls lie in the same plane or place; a wall with a mass
///            above grains has no force, as gravity does not act on it; the force on a wall with a mass alone has
///            pulled it away from the grains, since the start or from rest, or set_velocity() holds it back in every step
///          - a grain, a wall or an obstacle turns so fast that its surface moves by more than half a grain size in the step (rpm)
///          - a grain that is not compound lies behind the nearest facet of a mesh wall with one side; all grains lie in a
///            thousandth of a mesh wall, which is probably in mm
///          - the step is longer than a fifth of the duration of an impact of the lightest grains, under a law with duration()
///          - a grain moves by more than a grain size in the step, although no contact approaches as fast
///          - after the first step: gravity is zero, no body has a velocity or a force, and no contact overlaps: nothing
///            will ever move
///          - a grain is lost: far from all others, or so far from the origin that the scalar holds its
///            position only to more than a thousandth of the grain size, also after it has drifted through many periodic cells
template <class Simulation>
[[nodiscard]] std::vector<std::string> check(const Simulation& simulation,
                                             const StepReport& report) {
  detail::Findings found;
  const double size = double(simulation.grain_size());
  // After later steps the time is longer than the step, however much longer this one is than those before.
  const bool is_first = double(simulation.time()) <= (1 + 1e-9) * report.step;
  constexpr const char* older = requires {
    simulation.contact_problem();
  }
  ? detail::older_overlap : detail::overlap_of_springs;
  const bool is_deep = report.max_overlap > 0.01 * size;
  detail::check_report(found, report, size,
                       {simulation.tolerances().margin * size, is_first, older,
                        is_deep ? detail::pressing_body(simulation) : -1,
                        is_deep ? detail::one_sided_wall(simulation, report) : -1});
  detail::check_units(found, simulation, report);
  detail::check_motion(found, simulation, report);
  detail::check_meshes(found, simulation);
  detail::check_creep(found, simulation, report);
  if constexpr (requires { simulation.missed_gap(); })
    detail::check_bonds(found, simulation, report);
  if constexpr (requires { simulation.materials().laws()[0].reach(); })
    detail::check_bridges(found, simulation);
  if constexpr (requires { simulation.materials().laws()[0].normal_compliance(); })
    detail::check_compliance(found, report);
  if (!is_first && detail::is_idle(simulation, report))
    found.say(
        "nothing moves: gravity is zero, and no body has a velocity or a force. Call set_gravity()",
        {});
  detail::check_lost(found, simulation);
  return found.sentences;
}

}  // namespace moreau
