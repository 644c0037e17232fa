// SPDX-License-Identifier: MIT
// The contact problem of one island by a direct method: the proximal point method, each step of
// which is solved by a semismooth Newton method in the coordinates y of the bodies (see
// island_points.hpp). With a centre c of impulses, and a compliance s = epsilon w in series with every
// contact, where w is the mean of the diagonal of W_cc,
//
//     r(y): impulse with u = b + J y + C r + s (r - c) and the law, contact by contact,
//     F(y) = y - J^T r(y) = 0,        F' = I + J^T A J,   A = -dr/du.
//
// F' has one block per body and per pair of bodies. It is regular also where contacts are redundant.
// The solution r becomes the next centre. A centre that stays where it is solves the problem of
// the law. The change of y by one step is the error of the velocities of the centre, except for modes
// whose stiffness is small against epsilon. Their error shrinks by a factor q per step; q is the ratio
// of the changes by two steps, and the error is taken as change / (1 - q).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "moreau/solve/detail/block_factorization.hpp"
#include "moreau/solve/detail/island_points.hpp"

namespace moreau::detail {

/// The direct method for one island; the head of this file has the equations. Keeps its memory.
template <class Operator, class Law>
class IslandNewton {
 public:
  using Points = IslandPoints<Operator, Law>;
  using S = typename Points::S;
  using Impulse = typename Operator::Vector;

  /// How to solve an island.
  struct Precision {
    double tolerance;      ///< on the error that solve() returns
    double first_epsilon;  ///< of the first proximal step: `least` from impulses near a solution
    double least_epsilon;  ///< impulses times this times w are velocities that are not resolved
    int most_steps;        ///< of Newton's method, each with a factorization
  };

  /// Takes an island; the arguments are those of IslandPoints::assign.
  void assign(const Operator& op, std::span<const std::uint32_t> contacts, const auto& moves,
              const auto& free_of, const auto& law_of) {
    points_.assign(op, contacts, moves, free_of, law_of);
    stiffness_.resize(points_.points().size());
    for (auto* impulses : {&centre_, &found_}) impulses->resize(points_.points().size());
    for (auto* motion : {&y_, &next_, &trial_, &f_, &direction_}) motion->resize(points_.bodies());
  }
  /// Whether a factorization takes about as long as other work on so many contacts.
  bool is_cheap(std::size_t contacts) {
    constexpr double work_per_contact = 10, edges_per_body = 4;
    if (double(points_.edges().size()) > edges_per_body * double(points_.bodies())) return false;
    matrix_.analyse(points_.bodies(), points_.edges());
    return points_.bodies() <= 3 || matrix_.work() <= work_per_contact * double(contacts);
  }

  /// Solves the island.
  /// @param impulses in: the start [N s]
  /// @returns the largest error of the velocity of a body, relative to the largest change of such a
  ///          velocity by the impulses of the island: estimate of a root mean square over the mass [-]
  double solve(std::span<const Impulse> impulses, const Precision& precision) {
    const double tolerance = precision.tolerance, least = precision.least_epsilon;
    double epsilon = precision.first_epsilon;
    for (std::size_t k = 0; k < centre_.size(); ++k)
      centre_[k] = impulses[points_.points()[k].contact].template cast<double>();
    move_to_centre();
    double error = bound(least), before = 0, first = 0;
    if (error <= tolerance) return error;
    matrix_.analyse(points_.bodies(), points_.edges());
    steps_ = 0;
    is_better_ = monotone_ = false;
    for (int k = 0; k < most_proximal_steps && steps_ < precision.most_steps; ++k) {
      if (!proximal_step(epsilon, precision.most_steps, tolerance)) {
        epsilon = std::min(most_compliant, raise * epsilon);
        before = 0;
        monotone_ = !monotone_;
        continue;
      }
      const double change = largest_change();
      const double q = before > 0 ? std::min(largest_q, change / before) : 0;
      error = change / (1 - q);
      if (first == 0) first = change;
      is_better_ = change <= first;
      const bool solved = error <= tolerance && epsilon <= least;
      const double further = !solved && q > slow ? q / (1 - q) : 0;
      for (std::size_t c = 0; c < centre_.size(); ++c)
        centre_[c] = found_[c] + further * (found_[c] - centre_[c]);
      if (solved) return error;
      before = further == 0 && epsilon <= least ? change : 0;
      epsilon = std::max(least, lower * epsilon);
      move_to_centre();
    }
    return std::max(error, 2 * tolerance);
  }
  /// Whether the impulses that solve() has found are better than those from which it started, as far as is known:
  /// the last proximal step changed the motion no more than the first one.
  bool is_better() const { return is_better_; }
  /// Writes the impulses that solve() has found [N s].
  void finish(std::span<Impulse> impulses) const {
    for (std::size_t k = 0; k < centre_.size(); ++k)
      impulses[points_.points()[k].contact] = centre_[k].template cast<typename Operator::Scalar>();
  }

 private:
  using Vector = typename Points::Vector;
  using Coordinates = typename Points::Coordinates;
  static constexpr int most_proximal_steps = 40;
  static constexpr double most_compliant = 1, raise = 30, lower = 0.1;
  /// Ratio of the changes of two steps from which the centre is extrapolated, and largest ratio.
  static constexpr double slow = 0.3, largest_q = 0.95;

  void move_to_centre() {
    std::fill(y_.begin(), y_.end(), Coordinates::Zero());
    for (std::size_t k = 0; k < centre_.size(); ++k)
      points_.push(points_.points()[k], centre_[k], y_);
  }
  /// Largest velocity of a body in the motion of the centre and in another one [m/s].
  double scale(std::span<const Coordinates> other) const {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i)
      largest = std::max(largest, std::max(y_[i].norm(), other[i].norm()) * points_.speed(i));
    return largest;
  }
  /// Largest change of the velocity of a body by the last proximal step, relative to scale() [-].
  double largest_change() const {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i)
      largest = std::max(largest, (next_[i] - y_[i]).norm() * points_.speed(i));
    return largest > 0 ? largest / scale(next_) : 0;
  }
  /// An upper bound of the error, without a factorization: F' >= I.
  double bound(double epsilon) {
    const double norm = respond(epsilon, y_);
    double fastest = 0;
    for (std::size_t i = 0; i < points_.bodies(); ++i)
      fastest = std::max(fastest, points_.speed(i));
    return norm > 0 ? norm * fastest / scale(f_) : 0;
  }
  /// Sets found_, stiffness_ and f_ for a motion y.
  /// @returns |F|
  double respond(double epsilon, std::span<const Coordinates> y) {
    std::copy(y.begin(), y.end(), f_.begin());
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      const double soft = epsilon * point.diagonal;
      const Vector s = point.compliance.array() + soft;
      const Vector b = point.free + points_.velocity(point, y) - soft * centre_[k];
      const ContactResponse<S> answer = response<S>(*point.law, s, b);
      found_[k] = answer.impulse;
      stiffness_[k] = answer.stiffness;
      points_.push(point, -answer.impulse, f_);
    }
    double sum = 0;
    for (const Coordinates& f : f_) sum += f.squaredNorm();
    return std::sqrt(sum);
  }

  /// One proximal step from y_ and centre_ to next_ and found_.
  /// @returns whether Newton's method has converged
  bool proximal_step(double epsilon, int most_steps, double tolerance) {
    constexpr double rounding = 1e-12, share = 0.01;
    constexpr int most = 20;
    constexpr std::size_t memory = 4;
    std::array<double, memory> recent{};
    next_ = y_;
    double norm = respond(epsilon, next_), size = 0;
    for (const Coordinates& y : y_) size += y.squaredNorm();
    for (int k = 0; k < most && steps_ < most_steps; ++k) {
      if (!std::isfinite(norm)) return false;
      if (norm <= rounding * std::sqrt(size)) return true;
      ++steps_;
      double length = 1;
      recent[std::size_t(k) % memory] = norm;
      double bound = 0;
      for (const double one : recent) bound = std::max(bound, monotone_ ? norm : one);
      if (!newton_direction() || !shorten(epsilon, bound, norm, length)) return false;
      std::swap(next_, trial_);
      double moved = 0;
      for (std::size_t i = 0; i < next_.size(); ++i)
        moved = std::max(moved, direction_[i].norm() * points_.speed(i));
      if (length == 1 && moved <= share * tolerance * scale(next_)) return true;
    }
    return false;
  }
  /// Halves the step until |F| is below a bound; trial_ is the point that it leads to.
  /// @param bound  the largest |F| of the last few points (L. Grippo, F. Lampariello and S. Lucidi, SIAM J.
  ///               Numer. Anal. 23 (1986) 707)
  /// @param norm   out: |F| at trial_
  /// @param length out: of the step, relative to direction_
  /// @returns whether there is such a step
  bool shorten(double epsilon, double bound, double& norm, double& length) {
    constexpr int halvings = 6;
    for (int k = 0; k < halvings; ++k, length /= 2) {
      for (std::size_t i = 0; i < next_.size(); ++i) trial_[i] = next_[i] + length * direction_[i];
      const double reached = respond(epsilon, trial_);
      if (!(reached < bound)) continue;
      norm = reached;
      return true;
    }
    return false;
  }
  /// Solves F' direction_ = -F at the motion of the last respond().
  bool newton_direction() {
    matrix_.clear();
    for (std::size_t i = 0; i < points_.bodies(); ++i) matrix_.block(i, i).setIdentity();
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      if (stiffness_[k](0, 0) == 0 && stiffness_[k].isZero(0)) continue;
      const auto add = [&](std::uint32_t column, const typename Points::Rows& j) {
        if (column == Points::none) return;
        const typename Points::Rows rows = stiffness_[k] * j;
        if (point.body_a != Points::none)
          matrix_.block(point.body_a, column).noalias() += point.a.transpose() * rows;
        if (point.body_b != Points::none)
          matrix_.block(point.body_b, column).noalias() += point.b.transpose() * rows;
      };
      add(point.body_a, point.a);
      add(point.body_b, point.b);
    }
    if (!matrix_.factorize()) return false;
    for (std::size_t i = 0; i < f_.size(); ++i) direction_[i] = -f_[i];
    matrix_.solve(direction_);
    return std::all_of(direction_.begin(), direction_.end(),
                       [](const Coordinates& d) { return d.allFinite(); });
  }

  Points points_;
  int steps_ = 0;
  bool is_better_ = false;              // the impulses than those from which solve() started
  bool monotone_ = false;               // line search; in turn, where a proximal step fails
  std::vector<Vector> centre_, found_;  // impulses: c, and r at the last motion
  std::vector<Eigen::Matrix<double, S::dim, S::dim>> stiffness_;  // A at the last motion
  std::vector<Coordinates> y_;                                    // of the centre
  std::vector<Coordinates> next_, trial_, f_, direction_;
  BlockFactorization<S::dofs> matrix_;
};

}  // namespace moreau::detail
