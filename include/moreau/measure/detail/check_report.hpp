// SPDX-License-Identifier: MIT
// The part of check() that reads the report of a step.
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The sentences of check().
struct Findings {
  std::vector<std::string> sentences;

  /// Adds a sentence.
  /// @param text    each % stands for the next of the numbers
  [[gnu::cold]] void say(std::string_view text, std::initializer_list<double> numbers) {
    std::ostringstream sentence;
    const double* next = numbers.begin();
    for (const char letter : text)
      if (letter == '%' && next != numbers.end())
        sentence << *next++;
      else
        sentence << letter;
    sentences.push_back(sentence.str());
  }
};

/// A sentence with # in place of each number. A number is as a stream writes it: 12, -0.5, 1e-06.
[[gnu::cold]] inline std::string without_numbers(const std::string& sentence) {
  const auto is_digit = [&](std::size_t i) {
    return i < sentence.size() && sentence[i] >= '0' && sentence[i] <= '9';
  };
  const auto is_one_of = [&](std::size_t i, std::string_view letters) {
    return i < sentence.size() && letters.find(sentence[i]) != std::string_view::npos;
  };
  std::string text;
  for (std::size_t i = 0; i < sentence.size();) {
    if (!is_digit(i) && !(is_one_of(i, "-") && is_digit(i + 1))) {
      text += sentence[i++];
      continue;
    }
    text += '#';
    do ++i;
    while (is_digit(i) || (is_one_of(i, ".e") && is_digit(i + 1)) ||
           (is_one_of(i, "e") && is_one_of(i + 1, "+-") && is_digit(i + 2)) ||
           (is_one_of(i, "+-") && is_one_of(i - 1, "e") && is_digit(i + 1)));
  }
  return text;
}

/// The number 1, 2 or 5 times a power of ten that is at most x, to be typed.
inline double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  return (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1) * power;
}

/// Of an overlap that is older than the step.
inline constexpr const char* older_overlap =
    "overlap of % m of the bodies % and %, % of the grain size: it is older than this step, in "
    "which no surfaces approach as far. Use a shorter step, stiffer contacts if they are "
    "compliant, and add no grains inside others";
/// The same where a body of prescribed motion presses.
inline constexpr const char* overlap_by_drive =
    "overlap of % m of the bodies % and %, % of the grain size: it is older than this step. If "
    "body %, whose motion is prescribed, presses grains that cannot give way, they overlap more in "
    "each step: stop it, or let a force move it (set_wall_mass(), set_force()). Else use a shorter "
    "step, and add no grains inside others";
/// The same at a mesh wall with one side.
inline constexpr const char* overlap_from_behind =
    "overlap of % m of the bodies % and %, % of the grain size: it is older than this step. Mesh "
    "wall % holds grains on one side: one that comes from behind is pushed out in front. If grains "
    "shall be held where they come from, turn the order of the corners of the facets round, or "
    "take WallSides::both. Else use a shorter step, and add no grains inside others";
/// The same under a regularized law.
inline constexpr const char* overlap_of_springs =
    "overlap of % m of the bodies % and %, % of the grain size: the springs of the law are as "
    "soft. Use stiffer springs and a shorter step, and add no grains inside others";

/// What the advice on an overlap depends on, besides the report.
struct OverlapScene {
  double margin = 0;                  ///< of detection [m]
  bool is_first = false;              ///< whether no step was made before
  const char* older = older_overlap;  ///< the sentence about an overlap that is older than the step
  double presses = -1;    ///< a body of prescribed motion that presses grains; < 0: none
  double one_sided = -1;  ///< of the deepest overlap: a mesh wall with one side; < 0: none
};

/// Names the deepest overlap, with the advice for its cause:
///   - if two surfaces that approach move as far in the step, it arose in the step: an impact, or a wall that begins to move;
///   - else, in the first step, it was there at the start;
///   - else it arose before, in a step that was too long, with a body that was added, by a body of prescribed motion that
///     presses, of a grain that came through a mesh wall from behind, or by compliance, as is common under a regularized law.
[[gnu::cold]] inline void check_overlap(Findings& found, const StepReport& report, double size,
                                        const OverlapScene& scene) {
  if (!(report.max_overlap > 0.01 * size)) return;
  const double motion = report.approach * scene.margin;
  const std::initializer_list<double> numbers = {
      report.max_overlap, double(report.deepest_a), double(report.deepest_b),
      report.max_overlap / size, scene.presses < 0 ? scene.one_sided : scene.presses};
  if (report.max_overlap <= motion)
    return found.say(
        "overlap of % m of the bodies % and %, % of the grain size: it arose in this step, in "
        "which surfaces approach by % m. Use a shorter step: half the step halves the overlap",
        {report.max_overlap, double(report.deepest_a), double(report.deepest_b),
         report.max_overlap / size, motion});
  if (scene.is_first)
    return found.say(
        "overlap of % m of the bodies % and % at the start, % of the grain size. Add grains that "
        "do not overlap",
        numbers);
  const char* text = scene.older;
  if (text == older_overlap && scene.presses >= 0)
    text = overlap_by_drive;
  else if (text == older_overlap && scene.one_sided >= 0)
    text = overlap_from_behind;
  found.say(text, numbers);
}

/// What the solver did not reach.
MOREAU_INLINED inline void check_solve(Findings& found, const SolveReport& solve) {
  if (solve.unsolved_islands > 0)
    found.say(
        "% of % small structures not solved: velocities of their bodies have an estimated error of "
        "% of the "
        "largest velocity that the contacts gave in the step (g h at rest). If this lasts, a "
        "structure that "
        "should stand can move. Use a shorter step",
        {double(solve.unsolved_islands), double(solve.islands), solve.velocity_error});
  const bool has_approach = solve.relative_approach > SolveReport::max_relative_approach;
  if (solve.capped && has_approach)
    found.say(
        "after % sweeps contacts still approach with % of the velocity that they have without "
        "impulses "
        "(relative_approach). A body that driven walls squeeze, or a wedge that friction jams, has "
        "no "
        "solution: change what drives it. A load that travels through a long chain of contacts "
        "needs "
        "more sweeps: simulation.set_solver(Solver({.max_sweeps = %})) with your solver's name, "
        "ColouredGaussSeidel by default",
        {double(solve.sweeps), solve.relative_approach, 5.0 * solve.sweeps});
  else if (solve.capped && solve.unsolved_islands == 0)
    found.say(
        "the solver stopped after % sweeps at a residual of %, above its tolerance. Use a shorter "
        "step, "
        "or give it more sweeps: simulation.set_solver(Solver({.max_sweeps = %})) with your "
        "solver's "
        "name, ColouredGaussSeidel by default",
        {double(solve.sweeps), solve.residual, 5.0 * solve.sweeps});
}

[[gnu::cold]] inline void check_report(Findings& found, const StepReport& report, double size,
                                       const OverlapScene& scene) {
  if (report.approach > 1)
    found.say(
        "step too long: in one step the surfaces of a contact approach by % times the margin; "
        "contacts "
        "can be missed. Use a step % times shorter, or a larger margin (Tolerances::margin)",
        {report.approach, report.approach});
  check_overlap(found, report, size, scene);
  if (report.correction.limited > 0)
    found.say(
        "overlaps so deep that the correction of % contacts was limited to "
        "OverlapCorrectionOptions::max_shift; the bodies stay inside one another for many steps",
        {double(report.correction.limited)});
  check_solve(found, report.solve);
}

/// Compliant contacts whose forces the residual leaves inaccurate.
[[gnu::cold]] inline void check_compliance(Findings& found, const StepReport& report) {
  const double compliance = report.relative_compliance, residual = report.solve.residual;
  if (residual > 0.1 * compliance && compliance > 0)
    found.say(
        "the residual % is % of the relative compliance 1 / (k h^2 W_nn) = % of the stiffest "
        "contact: its "
        "force is known only to about this part. Use a smaller tolerance: "
        "simulation.set_solver(moreau::ColouredGaussSeidel({.tolerance = %})); or a step % times "
        "shorter; "
        "or a stiffness % times smaller in Compliant(law, stiffness)",
        {residual, residual / compliance, compliance, round_down(0.1 * compliance),
         std::sqrt(10 * residual / compliance), 10 * residual / compliance});
}

}  // namespace moreau::detail
