// SPDX-License-Identifier: MIT
// The part of check() that looks at structures at rest which no direct method has judged: under a law with a solve() of its
// own, with ColouredOptions::islands = false, and in steps that leave heaps to the sweeps. Small errors of many contacts then add up, and the structure creeps.
//
// The residual e is relative to the root of the sum of the squares of all impulses r, with W scaled to a mean diagonal of
// w. So the velocities of all contacts that stick have errors of at most e w |r| together, as a 2-norm. A body that d
// contacts, one above the other, connect to a fixed body moves with at most the sum of d of them: sqrt(d) e w |r|.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The longest way from a fixed body to a body that contacts connect to it, in contacts.
/// @param bodies number of bodies
/// @param pairs  of bodies in contact
/// @param fixed  function: body -> whether it cannot move
MOREAU_INLINED inline int longest_way(std::size_t bodies, const auto& pairs, const auto& fixed) {
  const int far = int(bodies);
  std::vector<int> ways(bodies, far);
  for (std::uint32_t i = 0; i < bodies; ++i)
    if (fixed(i)) ways[i] = 0;
  // A way to one body of a pair goes on to the other, until no way becomes shorter. Structures are small.
  for (bool again = true; again;) {
    again = false;
    for (const auto& pair : pairs)
      for (const int k : {0, 1})
        if (int& way = ways[pair[std::size_t(k)]]; ways[pair[std::size_t(1 - k)]] + 1 < way) {
          way = ways[pair[std::size_t(1 - k)]] + 1;
          again = true;
        }
  }
  int longest = -1;
  for (const int way : ways)
    if (way < far) longest = std::max(longest, way);
  return longest;
}

/// Whether a contact closed in an impact in the step: the impulses are those of the impact, and a residual relative to
/// them says nothing about bodies at rest.
template <class Simulation>
MOREAU_INLINED inline bool has_collided(const Simulation& simulation) {
  if constexpr (requires { simulation.contact_problem(); }) {
    const auto& problem = simulation.contact_problem();
    const auto& contacts = simulation.contacts();
    if (problem.load.size() != simulation.bodies().size() ||
        problem.delassus.size() != contacts.size())
      return false;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& point = contacts.points[c];
      const double load = std::max(double(problem.load[point.a]), double(problem.load[point.b]));
      if (contacts.impulses[c][0] > 0 &&
          problem.is_impact(-double(problem.delassus.free_velocity(c)[0]), load))
        return true;
    }
  }
  return false;
}

/// Says how fast a structure at rest can creep by the residual, if that is more than a hundredth of the grain size in a
/// second. Packings of more bodies than a small island has are not judged.
template <class Simulation>
[[gnu::cold]] void check_creep(Findings& found, const Simulation& simulation,
                               const StepReport& report) {
  using S = typename Simulation::S;
  constexpr std::size_t most_bodies = 200;
  constexpr double share = 0.01, second = 1;
  const double size = double(simulation.grain_size());
  if (report.solve.islands > 0 || !report.solve.converged || report.bonds > 0) return;
  if (simulation.grain_count() > most_bodies || !(report.solve.residual > 0)) return;
  if (has_collided(simulation)) return;
  const auto& bodies = simulation.bodies();
  const auto& contacts = simulation.contacts();
  double trace = 0, squares = 0;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& point = contacts.points[c];
    // Without the couple, which has another unit.
    const double square =
        contacts.impulses[c].template head<S::dim>().template cast<double>().squaredNorm();
    if (square > 0) pairs.push_back({point.a, point.b});
    squares += square;
    for (const bool is_b : {false, true}) {
      // In the axes of the body, which do not change lengths.
      const std::size_t body = is_b ? point.b : point.a;
      const typename S::Vector lever = transposed_product(typename S::Matrix(bodies.axes(body)),
                                                          is_b ? point.lever_b : point.lever_a);
      for (const auto inverse_mass : bodies.inverse_mass[body]) trace += double(inverse_mass);
      for (int k = 0; k < S::angular_dim; ++k)
        trace += double(
            S::spin(typename S::Angular(bodies.inverse_inertia_root_body[body].col(k)), lever)
                .squaredNorm());
    }
  }
  if (pairs.empty()) return;
  const int way =
      longest_way(bodies.size(), pairs, [&](std::size_t i) { return bodies.is_prescribed(i); });
  const double mean = trace / double(S::dim * int(contacts.size()));
  const double creep =
      std::sqrt(double(std::max(way, 0))) * report.solve.residual * mean * std::sqrt(squares);
  if (way < 2 || !(creep * second > share * size)) return;
  // Bodies that are faster than they creep are not at rest.
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies.exists(i) && double(linear<S>(bodies.velocity[i]).norm()) > 30 * creep) return;
  found.say(
      "bodies stand on each other, % contacts high, and no direct method judges their velocities "
      "(a law of your own, islands = false, or many contacts): with a "
      "residual of % they can creep by % m per second, % times the grain size. Take a tolerance % "
      "times smaller (ColouredOptions::tolerance, and as many more max_sweeps): "
      "guide/solve-report.md",
      {double(way), report.solve.residual, creep, creep / size,
       std::ceil(creep * second / (share * size))});
}

}  // namespace moreau::detail
