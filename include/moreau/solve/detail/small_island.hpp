// SPDX-License-Identifier: MIT
// A small island of a contact problem, as IslandSolver keeps it; whether its bodies collide; and the drawing of the islands
// that the direct method attempts in a step, so that attempts take about as long as the rest of the step on average.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"

namespace moreau::detail {

/// @tparam Space of the problem
template <class Space>
struct SmallIsland {
  static constexpr double not_attempted = std::numeric_limits<double>::infinity();
  /// Measured work per contact, in visits of it by a sweep: detection, assembly and all else that is no sweep; a
  /// Newton step of islands that are attempted in every step, as in columns, arches and low walls; a Newton step at
  /// most (that of a long row of balls takes 11 units); all Newton steps before the sweeps at most.
  static constexpr double unit = Space::angular_dim, other_visits = 8 * unit,
                          cheap_visits = 7.5 * unit, most_visits = 11.1 * unit,
                          warm_visits = 50 * unit;

  std::size_t island;
  double cost;    // of a Newton step, in visits of its contacts by a sweep, at first a lower bound
  double defect;  // of the warm start, see IslandNewton::start()
  bool is_new;    // no contact has an impulse in the warm start
  double error;   // relative [-]
  double start_error;     // the same of the impulses from which the direct method started, at least
  bool falls;             // no contact closes, or hardly: IslandSolver::hardly_closes()
  bool collides = false;  // see do_collide()
  bool failed = false;    // IslandSolver::attempt_evenly()
  bool squeezed = false;  // IslandSolver::add_approach(): there is no solution

  /// Whether the island is attempted in this step: drawn by a hash of its state.
  /// @param visits of an attempt, per contact
  MOREAU_INLINED bool is_drawn(double visits, int sweeps) const {
    if (is_new || (cost <= cheap_visits && !collides)) return true;
    if (collides) visits *= 3;  // more than counted steps, for one impact
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
    constexpr int dropped = 44;  // bits of the defect that rounding may change
    // Not std::bit_cast, which the C++ library of Debian 12's emscripten lacks.
    std::uint64_t bits;
    static_assert(sizeof bits == sizeof defect);
    std::memcpy(&bits, &defect, sizeof bits);
    const std::uint64_t hash = ((bits >> dropped) * golden) >> 32;
    return std::ldexp(double(hash), -32) * visits < other_visits + sweeps;
  }
};

/// Whether bodies collide in an island whose warm start is far from a solution: contacts close in an impact. Errors of an
/// impact do not add up from step to step, so that those of sweeps are small enough. But not if all faces land flat: of
/// these even small errors can be seen.
/// @param contacts of the island
template <class Problem>
MOREAU_COLD bool do_collide(const Problem& problem, std::span<const std::uint32_t> contacts) {
  constexpr double most_tilt = 0.01;
  const auto& op = problem.delassus;
  double load = 0, closing = 0, low = 0, high = 0, tilt = 0;
  bool has_faces = false;
  std::array<std::uint32_t, 2> pair{};  // of the contact before
  for (const std::uint32_t c : contacts) {
    const double opening = op.free_velocity(c)[0];
    if (!std::isfinite(opening)) continue;
    const auto bodies = op.bodies(c);
    for (const std::uint32_t body : bodies) load = std::max(load, double(problem.load[body]));
    closing = std::max(closing, -opening);
    if (bodies == pair)
      has_faces = true;
    else
      low = high = opening;
    pair = bodies;
    low = std::min(low, opening);
    high = std::max(high, opening);
    tilt = std::max(tilt, high - low);
  }
  return problem.is_impact(closing, load) && !(has_faces && tilt <= most_tilt * closing);
}

}  // namespace moreau::detail
