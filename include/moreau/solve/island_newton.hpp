// SPDX-License-Identifier: MIT
// The contact problem of one island by a direct method in the coordinates y of its bodies (see
// island_points.hpp). With the shift sigma = mu |u_t|, Coulomb's law is that of convex cones (G. De Saxce and
// Z.-Q. Feng, Math. Comput. Modelling 28 (1998) 225),
//
//     K contains r,   K* contains u + sigma n,   both perpendicular,
//
// and with fixed shifts the problem is convex (V. Acary, F. Cadoux, C. Lemarechal and J. Malick, ZAMM 91 (2011)
// 155). It is solved by the proximal point method: with a centre c of impulses and a compliance s = epsilon w in
// series with every contact, where w is the mean of the diagonal of W_cc,
//
//     r(y): minus the projection of (b + J y + sigma n - s c) / (C + s) onto K,
//     y minimizes  phi(y) = |y|^2 / 2 + r(y) . (C + s) r(y) / 2,    phi' = F = y - J^T r,   phi'' = I + J^T A J,
//
// by a semismooth Newton method with a line search, which converges from everywhere: A = -dr/du is symmetric and
// not negative. phi'' has one block per body and per pair of bodies, and is regular also where contacts are
// redundant. The solution r becomes the next centre, and its velocities give the next shifts. A centre that
// stays where it is, with its shifts, solves the problem of the law. The change of y by one step is the error of
// the velocities of the centre, except for modes whose stiffness is small against epsilon, and for slip. Their
// error shrinks by a factor q per step; q is the ratio of the changes by two steps, and the error is taken as
// change / (1 - q).
//
// Where contacts are redundant, many impulses solve the problem. That of a proximal step is the one nearest to its
// centre in the norm of s. With the warm start as centre, equal s and no shift where contacts stick, what has changed
// is shared among the contacts as if by equal springs: of a pair that touches anew the pressure is even. Sweeps give it
// to the point that they visit first, and with friction such an uneven pressure can turn a body.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/solve/detail/block_factorization.hpp"
#include "moreau/solve/detail/island_points.hpp"

namespace moreau::detail {

/// The direct method for one island; the head of this file has the equations. Keeps its memory.
template <class SpaceT>
class IslandNewton {
 public:
  using Points = IslandPoints<SpaceT>;
  using S = typename Points::S;
  using Impulse = typename SpaceT::Vector;

  /// How to solve an island.
  struct Precision {
    double tolerance;      ///< on the error that solve() returns
    double least_epsilon;  ///< impulses times this times w are velocities that are not resolved
    int most_steps;        ///< of Newton's method, each with a factorization
  };

  /// Takes an island.
  /// @param op       operator of the problem
  /// @param contacts of the island
  /// @param moves    whether impulses move a body, one entry per body
  /// @param free_of  function: contact -> b, D entries [m/s]; not finite if the contact cannot act
  /// @param friction_of function: contact -> mu [-]
  template <class Operator>
  void assign(const Operator& op, std::span<const std::uint32_t> contacts,
              std::span<const unsigned char> moves, const auto& free_of, const auto& friction_of) {
    points_.start(op.body_count());
    for (const std::uint32_t c : contacts) {
      const auto [a, b] = op.bodies(c);
      Vector compliance = Vector::Zero();
      if constexpr (requires { op.compliance(c); })
        compliance = op.compliance(c).template head<S::dim>().template cast<double>();
      points_.add({c, a, b, op.frame(c), op.lever_a(c), op.lever_b(c),
                   free_of(c).template cast<double>(), compliance, friction_of(c)},
                  op.inverse_masses(), moves);
    }
    points_.finish();
    make_room();
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
    matrix_.analyse(points_.bodies(), points_.edges());
    return visits_per_contact * double(points_.points().size()) + visits_per_block * matrix_.work();
  }

  /// Whether a contact has no friction: solve() then refines the impulses.
  bool has_smooth_point() const { return points_.has_smooth(); }
  /// The mass of the heaviest body over that of the lightest [-].
  double mass_ratio() const {
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t i = 0; i < points_.bodies(); ++i) {
      least = std::min(least, points_.speed(i));
      largest = std::max(largest, points_.speed(i));
    }
    return largest > 0 ? largest * largest / (least * least) : 1;
  }

  /// Moves to impulses.
  /// @param impulses [N s]
  /// @returns how far their motion is from that which the laws would make of it with a compliance w in series with
  ///          every contact, relative to the motion [-]: 0 for a solution, about 1 for other impulses. Takes no
  ///          factorization
  double start(std::span<const Impulse> impulses) {
    common_ = 0;
    set_centre(impulses);
    move_to_centre();
    first_shifts();
    const double defect = respond(1, y_).rest, motion = scale(y_);
    return motion > 0 ? defect / motion : defect > 0 ? 1 : 0;
  }

  /// The fastest slip of a contact that presses, with the impulses of start(), relative to the largest change of a
  /// velocity by the impulses [-]: below 1 if the bodies are about at rest to each other.
  double slip() const {
    double fastest = 0;
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      if (!(centre_[k][0] > 0)) continue;
      const auto& point = points_.points()[k];
      const Vector u = point.free + points_.velocity(point, y_);
      fastest = std::max(fastest, slip_of(u));
    }
    const double motion = scale(y_);
    return motion > 0 ? fastest / motion : 0;
  }

  /// Solves the island, from the impulses of start().
  /// @param epsilon of the first proximal step
  /// @returns the largest error of the velocity of a body, relative to the largest change of such a
  ///          velocity by the impulses of the island: estimate of a root mean square over the mass [-]
  double solve(double epsilon, const Precision& precision) {
    const double tolerance = precision.tolerance, least = precision.least_epsilon;
    matrix_.analyse(points_.bodies(), points_.edges());
    steps_ = 0;
    is_better_ = false;
    first_ = 0;
    double error = 0, before = 0, solved = std::numeric_limits<double>::infinity();
    while (proximal_step(epsilon, precision.most_steps, tolerance)) {
      const double change = take_shifts();
      if (!std::isfinite(change)) break;
      const double q = before > 0 ? std::min(largest_q, change / before) : 0;
      error = change / (1 - q);
      if (first_ == 0) first_ = change;
      is_better_ = change <= first_;
      std::swap(centre_, found_);
      std::swap(y_, next_);
      // A mode whose stiffness is `least` shows only the share least / epsilon of its error.
      const bool is_exact = epsilon <= least && change * epsilon <= rounding;
      if (is_exact || error * epsilon <= tolerance * least) {
        if (is_exact || !polishes() || steps_ == 0 || steps_ >= polish_steps ||
            error > polish * solved) {
          if (has_smooth_point()) refine();
          return error;
        }
        solved = error;
      } else if (std::isfinite(solved)) {
        return error;
      }
      before = epsilon <= least ? change : 0;
      epsilon = std::max(least, lower * epsilon);
    }
    return std::max(error, 2 * tolerance);
  }
  /// solve(), but near other impulses than those of start(), of which only the motion is taken. What they do not bear is
  /// shared as if by equal springs. The shifts begin with zero; if some contacts slip, the steps are done again with the
  /// shifts found.
  /// @param before the warm start [N s]
  double solve_near(std::span<const Impulse> before, double epsilon, const Precision& precision) {
    common_ = std::numeric_limits<double>::infinity();
    for (const auto& point : points_.points()) common_ = std::min(common_, point.diagonal);
    std::fill(shift_.begin(), shift_.end(), 0);
    double error = 0;
    for (int pass = 0; pass < 2; ++pass) {
      set_centre(before);
      error = solve(epsilon, precision);
      const bool slips = std::any_of(shift_.begin(), shift_.end(), [](double s) { return s > 0; });
      if (!(error <= precision.tolerance && slips)) break;
    }
    return error;
  }
  /// Whether the impulses that solve() has found are better than those from which it started, as far as is known:
  /// the last proximal step changed the motion no more than the first one.
  bool is_better() const { return is_better_; }
  /// Change of the motion by the first proximal step, an estimate of the error of the impulses from which solve()
  /// started [-]; 0 if that step did not succeed.
  double first_change() const { return first_; }
  /// Writes the impulses that solve() has found [N s].
  void finish(std::span<Impulse> impulses) const {
    for (std::size_t k = 0; k < centre_.size(); ++k)
      impulses[points_.points()[k].contact] = centre_[k].template cast<typename S::Scalar>();
  }

 private:
  using Vector = typename Points::Vector;
  using Coordinates = typename Points::Coordinates;
  static constexpr double lower = 0.1;
  /// Rounding of impulses times their compliance, relative to the motion. Steps go on below the tolerance while the
  /// error falls by `polish`: errors that stay the same in every step add up.
  static constexpr double rounding = 1e-15, polish = 0.1;
  static constexpr int polish_steps = 12;
  static constexpr std::size_t polish_bodies =
      10;  // for more, steps below the tolerance would cost too much
  /// Measured: response and assembly of a contact, and product of two blocks, in visits of a sweep.
  static constexpr double visits_per_contact = 5 * S::angular_dim,
                          visits_per_block = S::dofs * S::dofs / 6;
  static constexpr double largest_q = 0.95;  ///< ratio of the changes of two steps

  /// Makes room for the contacts and bodies of an island.
  MOREAU_COLD void make_room() {
    const std::size_t count = points_.points().size();
    shift_.resize(count);
    stiffness_.resize(count);
    for (auto* impulses : {&centre_, &found_, &slip_}) impulses->resize(count);
    for (auto* motion : {&y_, &next_, &trial_, &f_, &direction_}) motion->resize(points_.bodies());
  }
  /// The speed along the tangents of a contact.
  static double slip_of(const Vector& u) {
    double square = 0;
    for (int k = 1; k < S::dim; ++k) square += u[k] * u[k];
    return std::sqrt(square);
  }
  void set_centre(std::span<const Impulse> impulses) {
    for (std::size_t k = 0; k < centre_.size(); ++k)
      centre_[k] = impulses[points_.points()[k].contact].template cast<double>();
  }
  void move_to_centre() {
    std::fill(y_.begin(), y_.end(), Coordinates::Zero());
    for (std::size_t k = 0; k < centre_.size(); ++k)
      points_.push(points_.points()[k], centre_[k], y_);
  }
  /// Shifts of the motion of the centre.
  void first_shifts() {
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      Vector u = point.free + points_.velocity(point, y_);
      for (int i = 0; i < S::dim; ++i) u[i] += point.compliance[i] * centre_[k][i];
      shift_[k] = point.friction * slip_of(u);
    }
  }
  /// Sets the shifts of the motion that a proximal step has found.
  /// @returns the largest change of a shift and of the velocity of a body by the step, relative to scale() [-]
  MOREAU_INLINED double take_shifts() {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i)
      largest = std::max(largest, Coordinates(next_[i] - y_[i]).norm() * points_.speed(i));
    for (std::size_t k = 0; k < shift_.size(); ++k) {
      const double shift = points_.points()[k].friction * slip_of(slip_[k]);
      if (found_[k][0] > 0) largest = std::max(largest, std::abs(shift - shift_[k]));
      shift_[k] = shift;
    }
    return largest > 0 ? largest / scale(next_) : 0;
  }
  /// Largest velocity of a body in the motion of the centre and in another one [m/s].
  double scale(std::span<const Coordinates> other) const {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i)
      largest = std::max(largest, std::max(y_[i].norm(), other[i].norm()) * points_.speed(i));
    return largest;
  }

  bool polishes() const { return points_.bodies() <= polish_bodies; }
  /// One more proximal step from a solution, of a large compliance. Impulses have the rounding of velocities, divided
  /// by the compliance: 1e-9 of them after the steps of the least one. Friction holds bodies against that. Without it
  /// the tilts of a light body under a heavy one add up, and the load drives it out along the wedge. No line search:
  /// near its solution the problem is linear.
  MOREAU_COLD void refine() {
    constexpr double firm = 0.01, several = 10;
    next_ = y_;
    respond(firm, next_);
    if (!newton_direction()) return;
    for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = along(next_[i], 1, direction_[i]);
    const double left = respond(firm, next_).rest;
    if (!(left <= several * rounding / firm * scale(next_))) return;
    move_by_impulses();
    std::swap(centre_, found_);
    std::swap(y_, next_);
  }
  /// F at a motion: |F|, and the largest velocity of a body in it [m/s].
  struct Value {
    double norm, rest;
  };
  /// Sets found_, slip_, stiffness_ and f_ for a motion y.
  Value respond(double epsilon, std::span<const Coordinates> y) {
    std::copy(y.begin(), y.end(), f_.begin());
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      const double soft = epsilon * (common_ > 0 ? common_ : point.diagonal);
      const Vector caused = points_.velocity(point, y);
      Vector s, b;
      for (int i = 0; i < S::dim; ++i) {
        s[i] = point.compliance[i] + soft;
        b[i] = point.free[i] + caused[i] - soft * centre_[k][i];
      }
      slip_[k] = b;
      b[0] += shift_[k];
      if (is_open<S>(point.friction, b)) {
        found_[k].setZero();  // stiffness_ is not used
        continue;
      }
      const ContactResponse<S> answer = response<S>(point.friction, s, b);
      found_[k] = answer.impulse;
      stiffness_[k] = answer.stiffness;
      Vector back;
      for (int i = 0; i < S::dim; ++i) {
        slip_[k][i] += s[i] * answer.impulse[i];
        back[i] = -answer.impulse[i];
      }
      points_.push(point, back, f_);
    }
    double squares = 0, rest = 0;
    for (std::size_t i = 0; i < f_.size(); ++i) {
      const double square = f_[i].squaredNorm();
      squares += square;
      rest = std::max(rest, std::sqrt(square) * points_.speed(i));
    }
    return {std::sqrt(squares), rest};
  }

  /// One proximal step from y_ and centre_ to next_ and found_.
  /// @returns whether Newton's method has converged
  MOREAU_INLINED bool proximal_step(double epsilon, int most_steps, double tolerance) {
    constexpr double share = 0.03;
    constexpr int most_of_one = 30;  // structures take 2 to 6, packings that come to rest up to 20
    most_steps = std::min(most_steps, steps_ + most_of_one);
    next_ = y_;
    Value value = respond(epsilon, next_);
    double before = std::numeric_limits<double>::infinity();
    for (;;) {
      if (!std::isfinite(value.norm)) return false;
      const double left = value.rest / scale(next_), exact = rounding / epsilon;
      const double aim = std::max(share * tolerance, exact);
      const bool solved = !(left > aim);
      // Once more where it is solved: the problem is linear near its solution, and the step leads to it.
      if (!(left > (polishes() ? exact : aim)) ||
          (solved && (left > polish * before || steps_ == most_steps)))
        break;
      if (steps_ == most_steps) return false;
      ++steps_;
      before = left;
      if (!newton_direction() || !shorten(epsilon, value)) {
        if (!solved) return false;
        respond(epsilon, next_);
        break;
      }
      std::swap(next_, trial_);
    }
    move_by_impulses();
    return true;
  }
  /// Sets next_ to the motion by the impulses of the last respond().
  MOREAU_INLINED void move_by_impulses() {
    for (std::size_t i = 0; i < f_.size(); ++i) next_[i] -= f_[i];
  }
  /// Minimizes phi along direction_, roughly: phi is convex, and its slope is about linear in pieces. trial_ is the
  /// point that the step leads to.
  /// @param value  in: F at next_, out: at trial_
  /// @returns whether there is such a step
  MOREAU_INLINED bool shorten(double epsilon, Value& value) {
    constexpr int most = 30;
    constexpr double enough = 0.3;
    const double first = slope();
    if (!(first < 0)) return false;
    double length = 1, low = 0, low_slope = first, high = 0, high_slope = 0;
    for (int k = 0; k < most; ++k) {
      for (std::size_t i = 0; i < next_.size(); ++i)
        trial_[i] = along(next_[i], length, direction_[i]);
      const Value reached = respond(epsilon, trial_);
      const double here = slope();
      if (std::abs(here) <= -enough * first || reached.norm < value.norm / 2) {
        value = reached;
        return true;
      }
      if (here < 0) {
        if (high == 0) {
          value = reached;
          return true;
        }
        if (low > 0) high_slope /= 2;
        low = length, low_slope = here;
      } else {
        if (high > 0) low_slope /= 2;
        high = length, high_slope = here;
      }
      const double secant = low - low_slope * (high - low) / (high_slope - low_slope);
      length = std::clamp(secant, low + 0.02 * (high - low), high - 0.02 * (high - low));
    }
    return false;
  }
  MOREAU_INLINED double slope() const {
    double sum = 0;
    for (std::size_t i = 0; i < f_.size(); ++i) sum += f_[i].dot(direction_[i]);
    return sum;
  }
  using Block = typename BlockFactorization<S::dofs>::Block;
  /// Adds J^T A J of a contact and two of its bodies, from J of the first and A J of the second.
  MOREAU_COMPILED_ONCE static void add_block(Block& to, const typename Points::Rows& a,
                                             const typename Points::Rows& stiff_b) {
    add_transposed_product(to, a, stiff_b);
  }
  /// A J of a contact and one of its bodies.
  MOREAU_COMPILED_ONCE typename Points::Rows stiff(std::size_t k,
                                                   const typename Points::Rows& j) const {
    typename Points::Rows rows = Points::Rows::Zero();
    add_product(rows, stiffness_[k], j);
    return rows;
  }
  /// Solves phi'' direction_ = -F at the motion of the last respond().
  bool newton_direction() {
    matrix_.clear();
    for (std::size_t i = 0; i < points_.bodies(); ++i) matrix_.diagonal(i).setIdentity();
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      if (found_[k][0] == 0) continue;
      if (point.body_a != Points::none)
        add_block(matrix_.diagonal(point.body_a), point.a, stiff(k, point.a));
      if (point.body_b == Points::none) continue;
      const typename Points::Rows of_b = stiff(k, point.b);
      add_block(matrix_.diagonal(point.body_b), point.b, of_b);
      if (point.body_a == Points::none) continue;
      block_.setZero();
      add_block(block_, point.a, of_b);
      matrix_.add(point.body_a, point.body_b, block_);
    }
    if (!matrix_.factorize()) return false;
    for (std::size_t i = 0; i < f_.size(); ++i) direction_[i] = -f_[i];
    matrix_.solve(direction_);
    return std::all_of(direction_.begin(), direction_.end(),
                       [](const Coordinates& d) { return d.allFinite(); });
  }

  Points points_;
  int steps_ = 0;
  double common_ = 0;       // in place of w, > 0 [1/kg]; 0: each contact has its own
  double first_ = 0;        // see first_change()
  bool is_better_ = false;  // the impulses than those from which solve() started
  std::vector<Vector> centre_, found_, slip_;  // impulses: c, and r at the last motion; velocities
  std::vector<double> shift_;                  // sigma [m/s]
  std::vector<Eigen::Matrix<double, S::dim, S::dim>> stiffness_;  // A at the last motion
  std::vector<Coordinates> y_;                                    // of the centre
  std::vector<Coordinates> next_, trial_, f_, direction_;
  BlockFactorization<S::dofs> matrix_;
  Block block_;
};

}  // namespace moreau::detail
