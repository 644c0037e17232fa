// SPDX-License-Identifier: MIT
// The contact problem of one island by a direct method in the coordinates y of its bodies (see
// island_points.hpp). With the lift sigma = mu |u_t|, Coulomb's law is that of convex cones (G. De Saxce and
// Z.-Q. Feng, Math. Comput. Modelling 28 (1998) 225),
//
//     K contains r,   K* contains u + sigma n,   both perpendicular,
//
// and with fixed lifts the problem is convex (V. Acary, F. Cadoux, C. Lemarechal and J. Malick, ZAMM 91 (2011)
// 155). It is solved by the proximal point method: with a centre c of impulses and a compliance s = epsilon w in
// series with every contact, where w is the mean of the diagonal of W_cc,
//
//     r(y): minus the projection of (b + J y + sigma n - s c) / (C + s) onto K,
//     y minimizes  phi(y) = |y|^2 / 2 + r(y) . (C + s) r(y) / 2,    phi' = F = y - J^T r,   phi'' = I + J^T A J,
//
// by a semismooth Newton method with a line search, which converges from everywhere: A = -dr/du is symmetric and
// not negative. phi'' has one block per body and per pair of bodies, and is regular also where contacts are
// redundant. The solution r becomes the next centre, and its velocities give the next lifts. A centre that
// stays where it is, with its lifts, solves the problem of the law. The change of y by one step is the error of
// the velocities of the centre, except for modes whose stiffness is small against epsilon, and for slip. Their
// error shrinks by a factor q per step; q is the ratio of the changes by two steps, and the error is taken as
// change / (1 - q). A heavy body held by a light one through all n bodies has about the stiffness of the ratio
// of their masses, over n^2: its q is taken at least. A change by a larger epsilon than the least counts in proportion.
//
// Where contacts are redundant, many impulses solve the problem. That of a proximal step is the one nearest to its
// centre in the norm of s. With the warm start as centre, equal s and no lift where contacts stick, what has changed
// is shared among the contacts as if by equal springs: of a pair that touches anew the pressure is even. Sweeps give it
// to the point that they visit first, and with friction such an uneven pressure can turn a body.
//
// Where faces slide, the lifts would spoil this: an error d of a lift changes an impulse by d / s. There the limit mu r_n of
// the friction of each contact is fixed in a proximal step, in place of the lifts, and the next step has the limit of the
// pressure found (P. D. Panagiotopoulos, Ingenieur-Archiv 44 (1975) 421). The steps begin with a uniform pressure on
// each face, whose sum is that of the impulses before. The pressure that they find is nearest to it: uniform, and what the
// equilibrium of each body adds to it, which is linear in the position. The motion depends on the choice: under an uneven
// pressure a face that spins drifts aside, and a body that slides between two faces turns.
//
// Gaps of bodies that touch have the rounding of positions and the errors of earlier velocities, 1e-15 to 1e-6 of the
// size. Open gaps are part of b and overlaps are not, so that in general no motion of the bodies closes all gaps. Each
// proximal step would then change the pressure by the remaining velocity over s, the same in every step: the steps do
// not converge, or end with the load on few points. Where faces slide, the part of such a velocity up to the tolerance
// on the velocities of the bodies is therefore left out of b, and counts as an error of the velocities.
//
// With couples (law/rolling_resistance.hpp) the rows of a contact are the impulse and the couple / R, the cone has a second disc,
// and the lift is sigma = mu |u_t| + eta |w|: solve/detail/couple_response.hpp. All the rest is the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/solve/detail/island_points.hpp"
#include "moreau/solve/detail/proximal_step.hpp"

namespace moreau::detail {

/// The direct method for one island; the head of this file has the equations. Keeps its memory.
/// @tparam Couples whether a contact has D + A rows
template <class SpaceT, bool Couples = false>
class IslandNewton {
 public:
  using Step = ProximalStep<SpaceT, Couples>;
  using Points = typename Step::Points;
  using S = typename Points::S;
  using Impulse = typename Step::Impulse;

  /// How to solve an island.
  struct Precision {
    double tolerance;      ///< on the error that solve() returns
    double least_epsilon;  ///< impulses times this times w are velocities that are not resolved
    int most_steps;        ///< of Newton's method, each with a factorization
  };

  /// Takes an island.
  /// @param op       operator of the problem
  /// @param contacts of the island
  /// @param free_of  function: contact -> b, its rows [m/s]; not finite if the contact cannot act
  /// @param opening_of function: contact -> part of b_n that an open gap adds, 0 if it is not known [m/s]
  /// @param coefficients_of function: contact -> mu and eta, those of friction and of rolling resistance [-]
  template <class Operator>
  void assign(const Operator& op, std::span<const std::uint32_t> contacts, const auto& free_of,
              const auto& opening_of, const auto& coefficients_of) {
    Points& points = step_.points();
    points.start(op.body_count());
    for (const std::uint32_t c : contacts) {
      const auto [a, b] = op.bodies(c);
      Vector compliance = Vector::Zero();
      if constexpr (requires { op.compliance(c); })
        compliance =
            op.compliance(c).template head<Points::rows_of_contact>().template cast<double>();
      const auto [friction, rolling] = coefficients_of(c);
      double radius = 0;
      if constexpr (Couples) radius = double(op.radius(c));
      points.add(
          {c, a, b, op.frame(c), op.lever_a(c), op.lever_b(c), free_of(c).template cast<double>(),
           opening_of(c), compliance, friction, rolling, radius},
          op.inverse_masses(), op.freedoms());
    }
    points.finish();
    step_.make_room();
  }
  /// A lower bound of cost_of_step(), that of bodies which touch like those of a tree; infinite if more pairs of
  /// bodies touch than in structures.
  /// @param pairs of bodies that touch
  static double least_cost_of_step(std::size_t contacts, std::size_t bodies, std::size_t pairs) {
    constexpr double pairs_per_body = 4;
    if (double(pairs) > pairs_per_body * double(bodies))
      return std::numeric_limits<double>::infinity();
    return visits_per_contact * double(contacts) +
           visits_per_block * (double(bodies) + 2 * double(pairs));
  }
  /// The cost of a step of Newton's method, in visits of a contact by a sweep. Finds the order of the factorization.
  MOREAU_INLINED double cost_of_step() {
    return visits_per_contact * double(step_.points().points().size()) +
           visits_per_block * step_.analyse();
  }

  /// Whether a contact has no friction: solve() then refines the impulses.
  bool has_smooth_point() const { return step_.points().has_smooth(); }
  /// The mass of the heaviest body over that of the lightest [-].
  double mass_ratio() const {
    const Points& points = step_.points();
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t i = 0; i < points.bodies(); ++i) {
      least = std::min(least, points.speed(i));
      largest = std::max(largest, points.speed(i));
    }
    return largest > 0 ? largest * largest / (least * least) : 1;
  }

  /// Moves to impulses.
  /// @param impulses [N s]; empty: none
  /// @param least_of function: body of the problem -> velocity that its errors are relative to at least [m/s]
  /// @returns how far their motion is from that which the laws would make of it with a compliance w in series with
  ///          every contact, relative to the motion [-]: 0 for a solution, about 1 for other impulses. Takes no
  ///          factorization
  double start(std::span<const Impulse> impulses, const auto& least_of) {
    step_.start(impulses, least_of);
    slides_ = step_.sliding_points() >= least_sliding;
    return step_.defect();
  }
  /// Calls take(body of the problem, velocity that its errors are relative to with the impulses of start() [m/s]).
  void take_scales(const auto& take) const { step_.take_scales(take); }
  /// After start(): moves to impulses that do not depend on those of start(), which sweeps may have given to a contact because
  /// they visit it first. They are those of equal springs between the bodies, as by one proximal step, and by another one
  /// with the lifts that it has found.
  /// @param before  where the springs are not stretched: the warm start [N s]
  /// @param epsilon of the step
  /// @returns whether it has succeeded; if not, start() must be called again
  bool start_by_springs(std::span<const Impulse> before, double epsilon,
                        const Precision& precision) {
    step_.analyse();
    step_.begin();
    step_.make_even();
    step_.set_centre(before);
    for (int pass = 0; pass < 2; ++pass) {
      if (!step_.make(epsilon, precision.most_steps, precision.tolerance)) return false;
      step_.take_lifts();
    }
    step_.accept();
    step_.first_lifts();
    slides_ = step_.sliding_points() >= least_sliding;
    return true;
  }

  /// The fastest slip of a contact that presses, with the impulses of start(), relative to the largest change of a
  /// velocity by the impulses [-]: below 1 if the bodies are about at rest to each other.
  MOREAU_INLINED double slip() const { return step_.slip(); }

  /// Solves the island, from the impulses of start().
  /// @param epsilon of the first proximal step
  /// @returns the largest error of the velocity of a body, relative to what its contacts change of it, and where these
  ///          changes cancel at most to the largest change of a velocity in the island (ProximalStep::find_scales()):
  ///          estimate of a root mean square over the mass [-]
  double solve(double epsilon, const Precision& precision) {
    step_.analyse();
    step_.begin();
    is_better_ = false;
    first_ = 0;
    const Errors errors = make_steps(epsilon, precision);
    is_solved_ = errors.is_solved();
    if (!is_solved_) return std::max(errors.last, 2 * precision.tolerance);
    if (has_smooth_point()) {
      step_.refine(mass_ratio());
      is_better_ = true;  // the changes of the steps before are those of rounding
    }
    return errors.last;
  }
  /// solve(), but near other impulses than those of start(), of which only the motion is taken. What they do not bear is
  /// shared as if by equal springs. The lifts begin with zero; if some contacts slip, the steps are done again with the
  /// lifts found.
  /// @param before the warm start [N s]
  double solve_near(std::span<const Impulse> before, double epsilon, const Precision& precision) {
    step_.make_even();
    double error = 0;
    for (int pass = 0; pass < 2; ++pass) {
      step_.set_centre(before);
      error = solve(epsilon, precision);
      if (!(error <= precision.tolerance && step_.has_lift())) break;
    }
    return error;
  }
  /// Whether faces slide, with the impulses of start(). In space their pressure may not be unique. In the plane it is, or
  /// the motion does not depend on it, but lifts converge slowly where faces slide between heavy bodies.
  bool slides_on_faces() const { return slides_; }
  /// solve(), near impulses that press evenly on each face, with limits of friction in place of lifts.
  double solve_evenly(double epsilon, const Precision& precision) {
    const double left_out = step_.even_faces(precision.tolerance);
    const double error = std::max(left_out, solve(epsilon, precision));
    is_better_ = is_solved_;
    return error;
  }
  /// Whether the impulses that solve() has found are better than those from which it started, as far as is known:
  /// the last proximal step changed the motion no more than the first one.
  bool is_better() const { return is_better_; }
  /// Change of the motion by the first proximal step, an estimate of the error of the impulses from which solve()
  /// started [-]; 0 if that step did not succeed.
  double first_change() const { return first_; }
  /// Writes the impulses that solve() has found [N s].
  void finish(std::span<Impulse> impulses) const { step_.finish(impulses); }
  /// Calls take(body, its change of velocity) for each body, in the motion that solve() has found. It is that of
  /// finish() without the rounding of impulses, which a light body under a heavy one would feel multiplied by the ratio
  /// of their masses.
  MOREAU_INLINED void finish_motion(const auto& take) const { step_.finish_motion(take); }

 private:
  using Vector = typename Points::Vector;
  static constexpr double lower = 0.1;
  static constexpr int polish_steps = 12;  // steps below the tolerance only after fewer than these
  /// Measured: response and assembly of a contact, and product of two blocks, in visits of a sweep.
  static constexpr double visits_per_contact = 5 * S::angular_dim,
                          visits_per_block = S::dofs * S::dofs / 6;
  static constexpr double largest_q = 0.95;  ///< ratio of the changes of two steps
  /// Points on sliding faces, at least. Fewer points, in space three of one face, bear a unique pressure.
  static constexpr std::size_t least_sliding = 2 * (S::dim - 1);
  static constexpr double slow_q =
      0.7;  ///< the same, at which limits of friction converge too slowly

  /// The errors of the proximal steps that were taken, as solve() returns them [-].
  struct Errors {
    double last = 0;                                          // of the last step
    double solved = std::numeric_limits<double>::infinity();  // of the last that solves the island
    bool is_solved() const { return std::isfinite(solved); }
  };
  /// Makes proximal steps until the error is below the tolerance and further steps would gain little, until it no
  /// longer falls, or until a step fails.
  MOREAU_INLINED Errors make_steps(double epsilon, const Precision& precision) {
    const double tolerance = precision.tolerance, least = precision.least_epsilon;
    // The ratio of stiffnesses for the mode in which the lightest body holds the heaviest one through all others.
    const double bodies = double(step_.points().bodies());
    const double softest = 1 + least * mass_ratio() * bodies * bodies;
    Errors errors;
    double before = 0;  // change by the step before, with the least epsilon
    bool goes_on = true;
    while (goes_on && step_.make(epsilon, precision.most_steps, tolerance)) {
      const double change = step_.take_lifts();
      const double q = before > 0 ? std::min(largest_q, change / before) : 0;
      const double error = change * std::max(1 / (1 - q), softest) * std::max(1.0, epsilon / least);
      if (!(error <= errors.solved) || !std::isfinite(error)) {
        step_.first_lifts();  // the error is that of rounding: the step before is better
        break;
      }
      // The limits of friction do not converge, or slowly: other methods are faster.
      if (step_.has_limits() && before > 0 && !errors.is_solved() && change > slow_q * before)
        break;
      if (first_ == 0) first_ = change;
      is_better_ = change <= first_;
      step_.accept();
      errors.last = error;
      const bool is_exact = epsilon <= least && change * epsilon <= Step::rounding;
      if (is_exact || error <= tolerance) {
        // Steps below the tolerance are made as long as they are cheap and the error falls.
        goes_on = !is_exact && error <= Step::polish * errors.solved && step_.polishes() &&
                  step_.steps() > 0 && step_.steps() < polish_steps;
        errors.solved = error;
      }
      before = epsilon <= least ? change : 0;
      epsilon = std::max(least, lower * epsilon);
    }
    return errors;
  }

  Step step_;
  double first_ = 0;        // see first_change()
  bool slides_ = false;     // see slides_on_faces()
  bool is_better_ = false;  // the impulses than those from which solve() started
  bool is_solved_ = false;  // the island by solve(): to the tolerance, or to rounding
};

}  // namespace moreau::detail
