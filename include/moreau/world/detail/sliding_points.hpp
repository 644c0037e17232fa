// SPDX-License-Identifier: MIT
// Which contact points slide, for laws with static friction. A point slides if
//
//   1. its impulse lies on the cone of its law,
//   2. its tangential velocity at the end of the step exceeds the rest speed: what the residual of the solver leaves,
//   3. its face slides: of the other points of the same two bodies that push with the same normal, none is slower than
//      the rest speed; in space one may be, about which the face then turns. Under springs none may be.
//
// Condition 1 alone would not do. The points of a face, and all contacts of a structure at rest, can share a
// tangential load in many ways: the cone of some points is reached long before anything slides. If such a point lost
// its static friction, its neighbours would have to bear more, and the face would slide below its threshold. Rigid bodies
// with condition 2 satisfy condition 3. Springs do not: points of a face then slip one after another.
//
// The rest speed. Let rho be the largest of the solver's tolerance, SolveReport::residual, 1e-4 and sqrt(epsilon), w the mean
// of the diagonal of W, and |r| the norm over the N contacts that push. The natural map of all contacts may be rho w |r|,
// and so that of one contact, and its velocity if it sticks, is at most this; its root mean square is
// rho w |r| / sqrt(N). The rest speed is
//
//     min(sqrt(N), 3) rho w |r| / sqrt(N).
//
// It is about 3e-4 of the velocity that the impulse of a contact gives in a step, for a body that lies on a floor
// 3e-4 g h. Smaller tolerances do not reduce it, because 1e-4 is their default: sweeps that start from points that bear
// against each other let the face creep, by several times their residual, until its points bear in one direction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// Finds the contact points that slide, after the solve; the head of this file has the conditions.
template <class Operator, class Law>
class SlidingPoints {
 public:
  using S = typename Operator::Space;
  using Scalar = typename Operator::Scalar;
  using Row = typename Operator::Vector;
  using Problem = ContactProblem<Operator, Law>;

  /// @param problem  its operator carries the velocities of the impulses
  /// @param impulses rows of the operator, one per contact
  /// @param accuracy the larger of the solver's tolerance and SolveReport::residual of these impulses
  /// @param shared   bodies that other processes share: all processes call this; null: none
  MOREAU_INLINED SlidingPoints(const Problem& problem, std::span<const Row> impulses,
                               double accuracy, SharedBodies* shared)
      : problem_(problem),
        impulses_(impulses),
        rest_speed_(rest_speed(problem.delassus, impulses, accuracy, shared)) {}

  /// Conditions 2 and 3.
  /// @param contacts those of the problem
  MOREAU_INLINED bool slides(const DetectedContacts<S>& contacts, std::size_t c) const {
    if (rests(c)) return false;
    std::size_t resting = 0;
    for (std::size_t other = first_of_pair(contacts, c);
         other < contacts.size() && contacts.keys[other].bodies() == contacts.keys[c].bodies();
         ++other)
      resting += impulses_[other][0] > 0 && in_one_plane(contacts, c, other) && rests(other);
    return resting <= pivots;
  }

 private:
  static constexpr bool springs = requires(const Operator op) { op.compliance(std::size_t()); };
  static constexpr std::size_t pivots = springs ? 0 : S::dim - 2;

  MOREAU_INLINED static double rest_speed(const Operator& op, std::span<const Row> impulses,
                                          double accuracy, SharedBodies* shared) {
    double sums[] = {0, 0, 0, 0};  // |r|^2, N, trace of W, rows of W
    for (std::size_t c = 0; c < op.size(); ++c) {
      sums[0] += impulses[c].template cast<double>().squaredNorm();
      sums[1] += impulses[c][0] != 0;
      sums[2] += double(op.trace(c));
      sums[3] += double(Row::RowsAtCompileTime);
    }
    if (shared) shared->sum(sums);
    const double scale = sums[2] / std::max(sums[3], 1.0);
    const double rounding = std::sqrt(double(std::numeric_limits<Scalar>::epsilon()));
    const double rho = std::max({accuracy, 1e-4, rounding});
    return std::min(std::sqrt(sums[1]), 3.0) * rho * scale *
           std::sqrt(sums[0] / std::max(sums[1], 1.0));
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
  double rest_speed_;  // [m/s]
};

}  // namespace moreau::detail
