// SPDX-License-Identifier: MIT
// The contacts of one island in double precision, in the coordinates y of its bodies that make the
// mass matrix the identity: with M^-1 = R R^T of a body, a change of its velocity is R y, and
//
//     u = b + J y + C r,        y = J^T r  for a solution,
//
// where J stands for J R, and C is the compliance of the contacts, which is zero for rigid ones. |y|^2 / 2 is a
// kinetic energy. Axes along which a body cannot move have a zero column in R. With couples a contact has A rows more
// (law/rolling_block.hpp).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/solve/detail/dense_mass.hpp"
#include "moreau/solve/detail/jacobian_rows.hpp"

namespace moreau::detail {

/// The impulse of one contact as a function of u, and its derivative.
/// @tparam Rows of the contact: D, with couples D + A
template <int Rows>
struct ContactResponse {
  Eigen::Matrix<double, Rows, 1> impulse;       ///< [N s]
  Eigen::Matrix<double, Rows, Rows> stiffness;  ///< - d impulse / d u [kg], symmetric, not negative
};

/// Whether response() has no impulse: b is in K*.
template <class S>
bool is_open(double mu, const Eigen::Matrix<double, S::dim, 1>& b) {
  double square = 0;
  for (int k = 1; k < S::dim; ++k) square += b[k] * b[k];
  return b[0] >= 0 && mu * mu * square <= b[0] * b[0];
}

/// The impulse r in Coulomb's cone K with K* containing s r + b, perpendicular to r: minus the projection of b / s
/// onto K in the norm of s (SignoriniCoulomb::project() has that of s = 1), with the derivative.
/// @param mu friction coefficient [-]
/// @param s  diagonal of the compliance, equal for all tangents, > 0 [1/kg]
template <class S>
ContactResponse<S::dim> response(double mu, const Eigen::Matrix<double, S::dim, 1>& s,
                                 const Eigen::Matrix<double, S::dim, 1>& b) {
  constexpr int dim = S::dim;
  ContactResponse<S::dim> answer;
  answer.stiffness.setZero();
  // In the coordinates sqrt(s) r the projection is orthogonal, onto a cone of another angle.
  const double stretch = std::sqrt(s[1] / s[0]), slope = mu * stretch;
  const double normal = -b[0] / s[0];
  Eigen::Matrix<double, dim, 1> direction;  // of the slip; entry 0 is not used
  double square = 0;
  for (int k = 1; k < dim; ++k) {
    direction[k] = b[k] * (-stretch / s[1]);
    square += direction[k] * direction[k];
  }
  const double length = std::sqrt(square);
  if (slope * length <= -normal) {
    answer.impulse.setZero();
    return answer;
  }
  if (length < slope * normal) {
    for (int k = 0; k < dim; ++k) {
      answer.impulse[k] = -b[k] / s[k];
      answer.stiffness(k, k) = 1 / s[k];
    }
    return answer;
  }
  for (int k = 1; k < dim; ++k) direction[k] = length > 0 ? direction[k] / length : 0;
  const double share = 1 / (1 + slope * slope), reached = (normal + slope * length) * share;
  const double across = length > 0 ? slope * reached / length : 0;
  const double along = share / s[0], turned = across / s[1];
  answer.impulse[0] = reached;
  answer.stiffness(0, 0) = along;
  for (int k = 1; k < dim; ++k) {
    answer.impulse[k] = mu * reached * direction[k];
    answer.stiffness(k, 0) = answer.stiffness(0, k) = mu * along * direction[k];
    for (int l = 1; l < dim; ++l)
      answer.stiffness(k, l) = (mu * mu * along - turned) * direction[k] * direction[l];
    answer.stiffness(k, k) += turned;
  }
  return answer;
}

/// The contacts of one island; the head of this file has the coordinates.
/// @tparam Couples whether a contact has D + A rows
template <class SpaceT, bool Couples = false>
class IslandPoints {
 public:
  using S = SpaceT;
  static constexpr int dim = S::dim, dofs = S::dofs, rows_of_contact = Couples ? dofs : dim;
  using Vector = Eigen::Matrix<double, rows_of_contact, 1>;
  using Rows = Eigen::Matrix<double, rows_of_contact, dofs>;
  using Coordinates = Eigen::Matrix<double, dofs, 1>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// A contact.
  struct Point {
    Rows a, b;          ///< J of its bodies
    Vector free;        ///< b [m/s]
    double opening;     ///< part of b_n by which an open gap may close, >= 0 [m/s]
    Vector compliance;  ///< C [1/kg]
    double diagonal;    ///< mean of the diagonal of W_cc [1/kg]
    /// Root mean square over the axes of |J^T| of its bodies [kg^-1/2]
    double mobility_a, mobility_b;
    std::uint32_t body_a, body_b;  ///< in the island; none: cannot move
    std::uint32_t contact;         ///< in the problem
    double friction, rolling;      ///< mu, eta [-]
    std::uint32_t face;  ///< contacts that follow one another, of two bodies and with one normal
  };

  /// A contact as the problem has it.
  struct Source {
    std::uint32_t contact, body_a, body_b;
    const typename S::Matrix& frame;              ///< columns n, t[, s], world axes
    const typename S::Vector &lever_a, &lever_b;  ///< from the centres to the point, world axes [m]
    Vector free;                                  ///< b [m/s]; not finite if the contact cannot act
    double opening;                               ///< part of b_n that an open gap adds [m/s]
    Vector compliance;                            ///< C [1/kg]
    double friction, rolling;                     ///< mu, eta [-]
    double radius = 0;                            ///< R, with couples [m]
  };

  /// Begins an island of a problem with so many bodies.
  void start(std::size_t bodies) {
    number_.resize(bodies, none);
    points_.clear();
    roots_.clear();
    speeds_.clear();
    bodies_.clear();
    edges_.clear();
    faces_ = 0;
    has_smooth_ = false;
  }
  /// Adds a contact, unless it cannot act. Contacts of the same two bodies follow one another.
  /// @param masses of all bodies
  /// @param moves  not 0 if impulses move them
  void add(const Source& source, std::span<const InverseMass<S>> masses,
           std::span<const unsigned char> moves) {
    if (!source.free.allFinite()) return;
    Point point;
    point.free = source.free;
    point.opening = source.opening;
    point.compliance = source.compliance;
    point.contact = source.contact;
    point.friction = source.friction;
    point.rolling = source.rolling;
    const auto number = [&](std::uint32_t body) {
      return moves[body] ? local(body, masses[body]) : none;
    };
    point.body_a = number(source.body_a);
    point.body_b = number(source.body_b);
    point.a = rows(source, point.body_a, source.lever_a, -1);
    point.b = rows(source, point.body_b, source.lever_b, 1);
    const double square_a = point.a.squaredNorm() / rows_of_contact,
                 square_b = point.b.squaredNorm() / rows_of_contact;
    point.mobility_a = std::sqrt(square_a);
    point.mobility_b = std::sqrt(square_b);
    point.diagonal = square_a + square_b;
    if (!(point.diagonal > 0)) return;
    if (point.body_a != none && point.body_b != none &&
        (edges_.empty() || edges_.back() != std::array{point.body_a, point.body_b}))
      edges_.push_back({point.body_a, point.body_b});
    has_smooth_ = has_smooth_ || point.friction == 0;
    point.face = faces_;
    const Normal normal = source.frame.col(0).template cast<double>();
    if (!points_.empty() && (pair_ != std::array{source.body_a, source.body_b} ||
                             !(normal.dot(normal_) > in_one_plane)))
      point.face = ++faces_;
    pair_ = {source.body_a, source.body_b};
    normal_ = normal;
    points_.push_back(point);
  }
  /// Ends the island.
  void finish() {
    for (const std::uint32_t body : bodies_) number_[body] = none;
  }

  std::span<const Point> points() const { return points_; }
  std::size_t bodies() const { return roots_.size(); }
  bool has_smooth() const { return has_smooth_; }  ///< whether a contact has no friction
  /// The pairs of bodies that both move.
  std::span<const std::array<std::uint32_t, 2>> edges() const { return edges_; }
  /// The speed of a body for |y| = 1 of the body [kg^-1/2]: the root mean square over its mass.
  double speed(std::size_t body) const { return speeds_[body]; }

  /// The body of the problem that has a number in the island.
  std::uint32_t body(std::size_t number) const { return bodies_[number]; }
  /// R y of a body, the change of its velocity (v, w) in world axes [m/s, rad/s].
  MOREAU_INLINED Coordinates change(std::size_t body, const Coordinates& y) const {
    Coordinates sum = Coordinates::Zero();
    for (int k = 0; k < dofs; ++k)
      for (int i = k; i < dofs; ++i) sum[i] += roots_[body](i, k) * y[k];
    return sum;
  }
  /// Change of the relative velocity of a contact by the motion y of the bodies [m/s].
  Vector velocity(const Point& point, std::span<const Coordinates> y) const {
    Vector u = Vector::Zero();
    if (point.body_a != none) add_product(u, point.a, y[point.body_a]);
    if (point.body_b != none) add_product(u, point.b, y[point.body_b]);
    return u;
  }
  /// Adds J^T r of one contact.
  void push(const Point& point, const Vector& r, std::span<Coordinates> y) const {
    if (point.body_a != none) add_transposed_product(y[point.body_a], point.a, r);
    if (point.body_b != none) add_transposed_product(y[point.body_b], point.b, r);
  }

 private:
  using Root = Eigen::Matrix<double, dofs, dofs>;
  using Normal = Eigen::Matrix<double, dim, 1>;
  static constexpr double in_one_plane = 1 - 1e-6;

  /// The number of a body in the island.
  MOREAU_COLD std::uint32_t local(std::uint32_t body, const InverseMass<S>& mass) {
    std::uint32_t& number = number_[body];
    if (number != none) return number;
    number = static_cast<std::uint32_t>(bodies_.size());
    bodies_.push_back(body);
    const Root inverse = dense<Space<dim, double>>(mass);
    roots_.push_back(root(inverse, 8 * double(std::numeric_limits<typename S::Scalar>::epsilon())));
    const double linear_trace = trace(inverse, 0, dim);
    const double speed = linear_trace > 0 ? linear_trace / dim : trace(inverse, dim, dofs);
    speeds_.push_back(std::sqrt(speed));
    return number;
  }
  /// The sum of the diagonal entries from first to last - 1.
  static double trace(const Root& m, int first, int last) {
    double sum = 0;
    for (int k = first; k < last; ++k) sum += m(k, k);
    return sum;
  }
  /// R of a positive semidefinite matrix R R^T, lower triangle; a zero pivot gives a zero column.
  /// @param rounding of a part of the matrix, as a share of its trace
  static Root root(const Root& m, double rounding) {
    const double linear = rounding * trace(m, 0, dim), angular = rounding * trace(m, dim, dofs);
    Root l = Root::Zero();
    const auto rest = [&](int i, int k) {
      double sum = m(i, k);
      for (int j = 0; j < k; ++j) sum -= l(i, j) * l(k, j);
      return sum;
    };
    for (int k = 0; k < dofs; ++k) {
      const double pivot = rest(k, k);
      if (!(pivot > (k < dim ? linear : angular))) continue;
      l(k, k) = std::sqrt(pivot);
      for (int i = k + 1; i < dofs; ++i) l(i, k) = rest(i, k) / l(k, k);
    }
    return l;
  }
  MOREAU_COMPILED_ONCE Rows rows(const Source& source, std::uint32_t body,
                                 const typename S::Vector& lever, double sign) const {
    Rows by_root = Rows::Zero();
    if (body == none) return by_root;
    if constexpr (Couples)
      add_product(by_root, jacobian_rows<S>(source.frame, lever, source.radius, sign),
                  roots_[body]);
    else
      add_product(by_root, jacobian_rows<S>(source.frame, lever, sign), roots_[body]);
    return by_root;
  }

  List<Point> points_;
  List<Root> roots_;
  List<double> speeds_;
  List<std::uint32_t> bodies_, number_;
  List<std::array<std::uint32_t, 2>> edges_;
  bool has_smooth_ = false;
  // Of the last point: its face, normal and bodies in the problem.
  std::uint32_t faces_ = 0;
  Normal normal_;
  std::array<std::uint32_t, 2> pair_;
};

}  // namespace moreau::detail
