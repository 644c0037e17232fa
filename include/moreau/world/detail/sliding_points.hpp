// SPDX-License-Identifier: MIT
// Which contact points slide, for laws with static friction. A point slides if
//
//   1. its impulse lies on the cone of its law,
//   2. its tangential velocity at the end of the step exceeds the rest speed of its pair of bodies,
//   3. its face slides: of the other points of the same two bodies that push with the same normal, none is slower than
//      the rest speed; in space one may be, about which the face then turns. Under springs none may be.
//
// Condition 1 alone would not do. The points of a face, and all contacts of a structure at rest, can share a
// tangential load in many ways: the cone of some points is reached long before anything slides. If such a point lost
// its static friction, its neighbours would have to carry more, and the face would slide below its threshold. The points of rigid
// bodies satisfy condition 3 if they satisfy condition 2. Under springs this is not so: points of a face slip one after another.
//
// The rest speed of a pair of bodies. Let rho be the largest of the solver's tolerance, 1e-4 and sqrt(epsilon).
// Over the N points of the pair that push, let w be the mean of the diagonal of W, |r| the norm of the
// impulses, and |m| that of the natural map in units of the velocity, with w. The rest speed is
//
//     max(3 rho w |r| / sqrt(N), |m|).
//
// The first term is about 3e-4 of the velocity that the impulse of a contact gives in a step, for a body that lies on a
// floor 3e-4 g h. Smaller tolerances do not reduce it, because 1e-4 is their default. If the tangential impulses of the points of
// a face oppose each other at the start of the sweeps, the face has a velocity of several times the residual until the
// impulses have one direction.
// The residual is relative to the impulses of all contacts. Beside a body of large mass the velocity of a light body can
// therefore have an error far larger than the first term. The second term has this error: if a point should stick, its
// velocity is its natural map.
//
// Other bodies are not considered. With the impulses of all contacts, or with their residual, a light
// body would keep its static friction in slip because a heavy one rests elsewhere, or because a wedge elsewhere is not solved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"

namespace moreau::detail {

/// Finds the contact points of one pair of bodies that slide, after the solve; the head of this file has the conditions.
template <class Operator, class Law>
class SlidingPoints {
 public:
  using S = typename Operator::Space;
  using Scalar = typename Operator::Scalar;
  using Row = typename Operator::Vector;
  using Problem = ContactProblem<Operator, Law>;

  /// @param problem  its operator carries the velocities of the impulses
  /// @param impulses rows of the operator, one per contact
  /// @param accuracy tolerance of the solver; 0: it does not say
  /// @param first    the first contact of the pair
  /// @param last     the one after its last contact
  MOREAU_INLINED SlidingPoints(const Problem& problem, std::span<const Row> impulses,
                               double accuracy, std::size_t first, std::size_t last)
      : problem_(problem),
        impulses_(impulses),
        first_(first),
        last_(last),
        rest_speed_(rest_speed(accuracy)) {}

  /// Conditions 2 and 3.
  /// @param contacts those of the problem
  /// @param c        contact of the pair
  MOREAU_INLINED bool slides(const DetectedContacts<S>& contacts, std::size_t c) const {
    if (rests(c)) return false;
    std::size_t resting = 0;
    for (std::size_t other = first_; other < last_; ++other)
      resting += impulses_[other][0] > 0 && in_one_plane(contacts, c, other) && rests(other);
    return resting <= pivots;
  }

 private:
  static constexpr bool springs = requires(const Operator op) { op.compliance(std::size_t()); };
  static constexpr std::size_t pivots = springs ? 0 : S::dim - 2;

  MOREAU_INLINED double rest_speed(double accuracy) const {
    const Operator& op = problem_.delassus;
    double trace = 0, squared = 0, map = 0;
    int pushing = 0;
    for (std::size_t c = first_; c < last_; ++c) {
      if (impulses_[c][0] == 0) continue;
      ++pushing;
      trace += double(op.trace(c));
      squared += impulses_[c].template cast<double>().squaredNorm();
    }
    if (pushing == 0) return 0;
    const double w = trace / (pushing * double(Row::RowsAtCompileTime));
    for (std::size_t c = first_; c < last_; ++c) {
      if (impulses_[c][0] == 0) continue;
      const Row scaled = impulses_[c] * Scalar(w);
      map += double(natural_map(problem_.law(c), op.velocity(c), scaled, Scalar(w)).squaredNorm());
    }
    const double rounding = std::sqrt(double(std::numeric_limits<Scalar>::epsilon()));
    const double rho = std::max({accuracy, 1e-4, rounding});
    return std::max(3 * rho * w * std::sqrt(squared / pushing), std::sqrt(map));
  }
  /// Whether the normals of two contacts are equal to rounding.
  MOREAU_INLINED static bool in_one_plane(const DetectedContacts<S>& contacts, std::size_t c,
                                          std::size_t other) {
    const Scalar along = contacts.points[c].frame.col(0).dot(contacts.points[other].frame.col(0));
    return along > 1 - std::sqrt(std::numeric_limits<Scalar>::epsilon());
  }
  MOREAU_INLINED bool rests(std::size_t c) const {
    const Row u = problem_.delassus.velocity(c);
    double squared = 0;
    for (int t = 1; t < S::dim; ++t) squared += double(u[t]) * double(u[t]);
    return squared <= rest_speed_ * rest_speed_;
  }

  const Problem& problem_;
  std::span<const Row> impulses_;
  std::size_t first_, last_;
  double rest_speed_;  // [m/s]
};

}  // namespace moreau::detail
