// SPDX-License-Identifier: MIT
// One proximal step of the direct method for an island (solve/island_newton.hpp has the equations): from a centre of
// impulses and lifts, y that minimizes phi, by Newton's method with a line search.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/solve/detail/block_factorization.hpp"
#include "moreau/solve/detail/couple_response.hpp"
#include "moreau/solve/detail/island_points.hpp"
#include "moreau/solve/detail/island_response.hpp"
#include "moreau/solve/detail/island_scales.hpp"
#include "moreau/solve/detail/sliding_face.hpp"

namespace moreau::detail {

/// The points, the centre, the lifts and the motion of an island, and the steps that change them. Keeps its memory.
/// @tparam Couples whether a contact has D + A rows
template <class SpaceT, bool Couples = false>
class ProximalStep {
 public:
  using Points = IslandPoints<SpaceT, Couples>;
  using S = typename Points::S;
  using Impulse = Eigen::Matrix<typename SpaceT::Scalar, Points::rows_of_contact, 1>;
  /// Rounding of impulses times their compliance, relative to the motion. Steps go on below the tolerance while the
  /// error falls by `polish`: errors that stay the same in every step add up.
  static constexpr double rounding = 1e-15, polish = 0.1;

  Points& points() { return points_; }              ///< of the island
  const Points& points() const { return points_; }  ///< the same

  /// Makes room for the contacts and bodies of an island.
  MOREAU_INLINED void make_room() {
    const std::size_t count = points_.points().size();
    lift_.resize(count);
    limit_.resize(count);
    closed_.resize(count);
    if constexpr (Couples) roll_limit_.resize(count);
    stiffness_.resize(count);
    for (auto* impulses : {&centre_, &found_, &slip_}) impulses->resize(count);
    for (auto* motion : {&y_, &next_, &trial_, &f_, &direction_}) motion->resize(points_.bodies());
    scales_.make_room(points_.bodies());
  }
  /// Finds the order of the factorization.
  /// @returns its cost, in products of two blocks
  MOREAU_INLINED double analyse() {
    matrix_.analyse(points_.bodies(), points_.edges());
    return matrix_.work();
  }

  /// Moves to impulses, with the lifts of their motion. The compliance of each contact is epsilon w.
  /// @param impulses [N s]; empty: none
  /// @param least_of function: body of the problem -> velocity that its errors are relative to at least, see
  ///                 IslandScales::find() [m/s]
  void start(std::span<const Impulse> impulses, const auto& least_of) {
    scales_.set_least(points_, least_of);
    common_ = 0;
    has_limits_ = false;
    std::fill(closed_.begin(), closed_.end(), 0);
    if (impulses.empty())
      std::fill(centre_.begin(), centre_.end(), Vector::Zero());
    else
      set_centre(impulses);
    move_to_centre();
    find_scales(centre_, y_);
    first_lifts();
  }
  /// Sets the velocities of the contacts in the motion of the centre, and their lifts.
  void first_lifts() {
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      Vector& u = slip_[k];
      u = point.free + points_.velocity(point, y_);
      u[0] -= closed_[k];
      for (int i = 0; i < rows; ++i) u[i] += point.compliance[i] * centre_[k][i];
      lift_[k] = Law::lift(point, u);
    }
  }
  /// Gives all contacts one compliance, epsilon times the least w, and no lift.
  MOREAU_INLINED void make_even() {
    make_common();
    std::fill(lift_.begin(), lift_.end(), 0);
  }
  /// Gives all contacts one compliance, epsilon times the least w.
  MOREAU_INLINED void make_common() {
    common_ = std::numeric_limits<double>::infinity();
    for (const auto& point : points_.points()) common_ = std::min(common_, point.diagonal);
  }
  bool has_limits() const { return has_limits_; }  ///< after even_faces()
  /// Whether a contact has a lift.
  bool has_lift() const {
    return std::any_of(lift_.begin(), lift_.end(), [](double s) { return s > 0; });
  }
  /// Sets the centre alone [N s].
  void set_centre(std::span<const Impulse> impulses) {
    for (std::size_t k = 0; k < centre_.size(); ++k)
      centre_[k] = impulses[points_.points()[k].contact].template cast<double>();
  }
  /// The change of the motion by the laws, with a compliance w in series with every contact, relative to find_scales() [-].
  MOREAU_INLINED double defect() {
    respond(1, y_);
    find_scales(found_, y_);
    const double defect = scales_.relative(points_, f_);
    return std::isfinite(defect) ? defect : 1;
  }
  /// The fastest slip of a contact that presses, with the impulses of start(), relative to the largest change of a
  /// velocity by the impulses [-]: below 1 if the bodies are about at rest to each other.
  MOREAU_INLINED double slip() const {
    double fastest = 0;
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      if (!(centre_[k][0] > 0)) continue;
      const auto& point = points_.points()[k];
      const Vector u = point.free + points_.velocity(point, y_);
      fastest = std::max(fastest, slip_of<S>(u));
    }
    const double motion = fastest_body();
    return motion > 0 ? fastest / motion : 0;
  }

  /// How many points lie on faces that slide, with the impulses of start(). Faces are those of two points and more.
  MOREAU_INLINED std::size_t sliding_points() {
    return count_sliding<S>(points_.points(), std::span<const Vector>(centre_),
                            std::span<const Vector>(slip_), sliding_scales());
  }
  /// Makes the pressure of each face uniform in the centre. Its sum remains. From now on the friction of each contact
  /// has a limit, which take_lifts() sets. Of the velocity by which an open gap may
  /// close, the part up to the tolerance is left out. After sliding_points().
  /// @param tolerance on the error of velocities, relative to find_scales() [-]
  /// @returns the largest velocity that is left out, relative to find_scales(), at most the tolerance [-]
  MOREAU_INLINED double even_faces(double tolerance) {
    double largest = 0;
    for (std::size_t k = 0; k < closed_.size(); ++k) {
      const auto& point = points_.points()[k];
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t body : {point.body_a, point.body_b})
        if (body != Points::none) least = std::min(least, scales_.of(body));
      const double share = least > 0 ? std::min(tolerance, point.opening / least) : 0;
      closed_[k] = share * least;
      largest = std::max(largest, share);
    }
    first_lifts();
    make_common();
    has_limits_ = true;
    detail::make_even<S>(points_.points(), std::span<const Vector>(slip_), sliding_scales(),
                         std::span<Vector>(centre_), std::span<double>(limit_));
    if constexpr (Couples)
      for (std::size_t k = 0; k < centre_.size(); ++k) {
        const double limit = points_.points()[k].rolling * centre_[k][0],
                     couple = couple_of<S>(centre_[k]);
        roll_limit_[k] = limit;
        for (int i = S::dim; i < rows && couple > limit; ++i) centre_[k][i] *= limit / couple;
      }
    return largest;
  }

  /// Calls take(body of the problem, velocity that its errors are relative to [m/s]).
  void take_scales(const auto& take) const {
    const std::span<const double> all = scales_.all();
    for (std::size_t i = 0; i < all.size(); ++i) take(points_.body(i), all[i]);
  }
  /// Counts the steps of Newton's method from zero.
  void begin() { steps_ = 0; }
  int steps() const { return steps_; }  ///< since begin(), each with a factorization
  /// One proximal step from y_ and centre_ to next_ and found_.
  /// @returns whether Newton's method has converged
  MOREAU_INLINED bool make(double epsilon, int most_steps, double tolerance) {
    constexpr double share = 0.03, several = 10;
    constexpr int most_of_one = 30;  // structures take 2 to 6, packings that come to rest up to 20
    most_steps = std::min(most_steps, steps_ + most_of_one);
    next_ = y_;
    double norm = respond(epsilon, next_), least = norm;
    double before = std::numeric_limits<double>::infinity();
    for (;;) {
      if (!std::isfinite(norm)) return false;
      find_scales(found_, next_);
      const double left = scales_.relative(points_, f_), exact = rounding / epsilon;
      const double aim = std::max(share * tolerance, exact);
      // Rounding can leave a little more, in which steps change nothing, or lead nowhere.
      const bool rounded = !(left > several * exact);
      const bool solved = !(left > aim) || (left > before / 2 && rounded);
      // Once more where it is solved: the problem is linear near its solution, and the step leads to it.
      if (!(left > (polishes() ? exact : aim)) ||
          (solved && (left > polish * before || steps_ == most_steps)))
        break;
      if (steps_ == most_steps) return false;
      ++steps_;
      before = left;
      if (!newton_direction() || !shorten(epsilon, norm, least)) {
        if (!solved && !rounded) return false;
        respond(epsilon, next_);
        break;
      }
      std::swap(next_, trial_);
    }
    move_by_impulses();
    return true;
  }
  /// Sets the lifts, or the limits, of the motion that a proximal step has found.
  /// @returns the largest change of a lift and of the velocity of a body by the step, and by the change of the limits,
  ///          relative to find_scales() [-]
  MOREAU_INLINED double take_lifts() {
    find_scales(found_, next_);
    for (std::size_t i = 0; i < y_.size(); ++i) f_[i] = next_[i] - y_[i];
    double largest = scales_.relative(points_, f_);
    if (has_limits_) return std::max(largest, take_limits());
    for (std::size_t k = 0; k < lift_.size(); ++k) {
      const auto& point = points_.points()[k];
      const double lift = Law::lift(point, slip_[k]), change = std::abs(lift - lift_[k]);
      // A slip is that of both bodies.
      if (found_[k][0] > 0 && change > 0)
        largest = std::max(largest,
                           change / std::max(scales_.of(point.body_a), scales_.of(point.body_b)));
      lift_[k] = lift;
    }
    return largest;
  }
  /// Makes the solution that make() has found the next centre.
  void accept() {
    std::swap(centre_, found_);
    std::swap(y_, next_);
  }
  /// Further proximal steps from a solution, of a large compliance. Impulses have the rounding of velocities, divided
  /// by the compliance: 1e-9 of them after the steps of the least one. Friction holds bodies against that. Without it
  /// the tilt of a light body under a heavy one stays, and the load drives it out along the wedge. The velocities that are
  /// left at the contacts shrink by the compliance in each step, down to rounding. For the same reason the motion is that
  /// for which the contacts ask, and not J^T r: the rounding of r, times the ratio of the masses, tilts the light body.
  /// No line search: near its solution the problem is linear.
  /// @param mass_ratio of the heaviest body and the lightest [-]
  MOREAU_COLD void refine(double mass_ratio) {
    constexpr double several = 10;
    constexpr int most = 4;
    const double firm = std::min(0.01, 1 / mass_ratio);
    for (int k = 0; k < most; ++k) {
      respond(firm, y_);
      if (!newton_direction()) return;
      double change = 0;
      for (std::size_t i = 0; i < next_.size(); ++i) {
        next_[i] = along(y_[i], 1, direction_[i]);
        change = std::max(change, direction_[i].norm() * points_.speed(i));
      }
      respond(firm, next_);
      const double motion = fastest_in(points_, next_);
      if (!(fastest_in(points_, f_) <= several * rounding / firm * motion)) return;
      accept();
      if (change <= rounding * motion) return;
    }
  }
  /// Whether the island is so small that steps below the tolerance cost little.
  bool polishes() const { return points_.bodies() <= polish_bodies; }
  /// Writes the impulses of the centre [N s].
  void finish(std::span<Impulse> impulses) const {
    for (std::size_t k = 0; k < centre_.size(); ++k)
      impulses[points_.points()[k].contact] =
          centre_[k][0] > 0 ? Impulse(centre_[k].template cast<typename SpaceT::Scalar>())
                            : Impulse(Impulse::Zero());
  }
  /// Calls take(body, its change of velocity) for each body, in the motion of the centre.
  MOREAU_INLINED void finish_motion(const auto& take) const {
    for (std::size_t i = 0; i < y_.size(); ++i) take(points_.body(i), points_.change(i, y_[i]));
  }

 private:
  using Vector = typename Points::Vector;
  using Coordinates = typename Points::Coordinates;
  using Law = IslandResponse<SpaceT, Couples>;
  using Response = typename Law::Response;
  static constexpr int rows = Points::rows_of_contact;
  static constexpr std::size_t polish_bodies = 10;

  void move_to_centre() {
    std::fill(y_.begin(), y_.end(), Coordinates::Zero());
    for (std::size_t k = 0; k < centre_.size(); ++k)
      points_.push(points_.points()[k], centre_[k], y_);
  }
  /// Sets the velocities that errors are relative to, see IslandScales::find(): at most the largest velocity of a body in
  /// the motion of the centre or in another one.
  /// @param impulses of the contacts, or those of the centre where these are larger [N s]
  void find_scales(std::span<const Vector> impulses, std::span<const Coordinates> other) {
    scales_.find(points_, impulses, centre_,
                 std::max(fastest_in(points_, y_), fastest_in(points_, other)));
  }
  /// Sets the limits of the friction to mu r_n of the impulses that a step has found [N s].
  /// @returns the largest change of the velocity of a body that one contact would cause if its friction went to its new limit, relative
  ///          to find_scales() [-]
  MOREAU_INLINED double take_limits() {
    double largest = 0;
    for (std::size_t k = 0; k < limit_.size(); ++k) {
      const auto& point = points_.points()[k];
      const double limit = point.friction * found_[k][0], change = std::abs(limit - limit_[k]);
      // Friction that is below its limit does not feel that the limit changes.
      if (slip_of<S>(found_[k]) >= (1 - 1e-9) * std::min(limit, limit_[k]))
        largest =
            std::max({largest, scales_.relative(points_, point.body_a, change * point.mobility_a),
                      scales_.relative(points_, point.body_b, change * point.mobility_b)});
      limit_[k] = limit;
      if constexpr (Couples) {
        const double of_couple = point.rolling * found_[k][0],
                     by = std::abs(of_couple - roll_limit_[k]);
        if (couple_of<S>(found_[k]) >= (1 - 1e-9) * std::min(of_couple, roll_limit_[k]))
          largest =
              std::max({largest, scales_.relative(points_, point.body_a, by * point.mobility_a),
                        scales_.relative(points_, point.body_b, by * point.mobility_b)});
        roll_limit_[k] = of_couple;
      }
    }
    return largest;
  }
  /// Largest velocity of a body in the motion of the centre, or that errors are relative to at least [m/s].
  double fastest_body() const { return scales_.largest_least(fastest_in(points_, y_)); }
  SlidingScales sliding_scales() const {
    constexpr double open = 1e-6;
    return {open * fastest_body(), scales_.all()};
  }
  /// Sets found_, slip_, stiffness_ and f_ for a motion y.
  /// @returns |F|
  double respond(double epsilon, std::span<const Coordinates> y) {
    std::copy(y.begin(), y.end(), f_.begin());
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      const double soft = epsilon * (common_ > 0 ? common_ : point.diagonal);
      const Vector caused = points_.velocity(point, y);
      Vector s, b;
      for (int i = 0; i < rows; ++i) {
        s[i] = point.compliance[i] + soft;
        b[i] = point.free[i] + caused[i] - soft * centre_[k][i];
      }
      b[0] -= closed_[k];
      slip_[k] = b;
      if (has_limits_) {
        take(k, s, Law::within(limit_[k], Couples ? roll_limit_[k] : 0, s, b));
        continue;
      }
      b[0] += lift_[k];
      if (Law::is_without(point, b)) {
        found_[k].setZero();  // stiffness_ is not used
        continue;
      }
      take(k, s, Law::at(point, s, b));
    }
    double squares = 0;
    for (const Coordinates& f : f_) squares += f.squaredNorm();
    return std::sqrt(squares);
  }

  /// Takes the response of a point: its impulse moves f_, and the compliances s add to its slip.
  void take(std::size_t k, const Vector& s, const Response& answer) {
    found_[k] = answer.impulse;
    stiffness_[k] = answer.stiffness;
    Vector back;
    for (int i = 0; i < rows; ++i) {
      slip_[k][i] += s[i] * answer.impulse[i];
      back[i] = -answer.impulse[i];
    }
    points_.push(points_.points()[k], back, f_);
  }

  /// Sets next_ to the motion by the impulses of the last respond().
  MOREAU_INLINED void move_by_impulses() {
    for (std::size_t i = 0; i < f_.size(); ++i) next_[i] -= f_[i];
  }
  /// Minimizes phi along direction_, roughly: phi is convex, and its slope is about linear in pieces. trial_ is the
  /// point that the step leads to. Far from the minimum |F| may grow in a step that reduces phi. A step that halves |F| is taken
  /// even if phi grows, but only if it halves the smallest |F| so far: otherwise the steps can repeat in a cycle.
  /// @param norm  |F|, in: at next_, out: at trial_
  /// @param least the smallest |F| of the steps so far, in and out
  /// @returns whether there is such a step
  MOREAU_INLINED bool shorten(double epsilon, double& norm, double& least) {
    constexpr int most = 30;
    constexpr double enough = 0.3;
    const double first = slope();
    if (!(first < 0)) return false;
    double length = 1, low = 0, low_slope = first, high = 0, high_slope = 0;
    for (int k = 0; k < most; ++k) {
      for (std::size_t i = 0; i < next_.size(); ++i)
        trial_[i] = along(next_[i], length, direction_[i]);
      const double reached = respond(epsilon, trial_);
      const double here = slope();
      if (std::abs(here) <= -enough * first || reached < least / 2 || (here < 0 && high == 0)) {
        norm = reached;
        least = std::min(least, norm);
        return true;
      }
      if (here < 0) {
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
    typename Points::Rows stiff_rows = Points::Rows::Zero();
    add_product(stiff_rows, stiffness_[k], j);
    return stiff_rows;
  }
  /// Solves phi'' direction_ = -F at the motion of the last respond().
  bool newton_direction() {
    matrix_.clear();
    for (std::size_t i = 0; i < points_.bodies(); ++i) matrix_.diagonal(i).setIdentity();
    for (std::size_t k = 0; k < centre_.size(); ++k) {
      const auto& point = points_.points()[k];
      if (found_[k][0] == 0 && !has_limits_) continue;
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
  double common_ = 0;                   // in place of w, > 0 [1/kg]; 0: each contact has its own
  List<Vector> centre_, found_, slip_;  // impulses: c, and r at the last motion; velocities
  List<double> lift_;                   // sigma [m/s]
  bool has_limits_ = false;             // of friction, in place of lifts
  IslandScales<Points> scales_;         // see find_scales()
  List<double> limit_;                  // mu r_n [N s]
  List<double> roll_limit_;             // eta r_n, with couples [N s]
  List<double> closed_;  // part of the opening that is left out, see even_faces() [m/s]
  List<Eigen::Matrix<double, rows, rows>> stiffness_;  // A at the last motion
  List<Coordinates> y_;                                // of the centre
  List<Coordinates> next_, trial_, f_, direction_;
  BlockFactorization<S::dofs> matrix_;
  Block block_;
};

}  // namespace moreau::detail
