// SPDX-License-Identifier: MIT
// A periodic cell: a body that leaves the cell on one side enters it on the opposite side.
//
// There are two kinds. A box has some periodic axes, parallel to the axes of the world. A lattice is
// periodic along D vectors, the columns of a matrix H, and can deform: a point x has the images x + H n
// for all vectors n of whole numbers.
//
// Room. Two boxes of grains, each at most w wide, overlap only if the difference d of their centres has
// components of at most w. Two images of a pair would then differ by a lattice vector H n != 0 with
// components of at most 2 w. Row k of H^-1 bounds its whole number n_k:
//
//     |n_k| <= |row_k(H^-1)|_1 2 w,
//
// so no pair overlaps through two images if h_k = 1 / |row_k(H^-1)|_1 > 2 w for all k. For a box h_k is
// its length.
//
// Reduction. A cell that is sheared for long becomes thin, although its lattice stays wide. The same
// lattice has other vectors: a vector minus whole multiples of another one. Such multiples are subtracted
// while this makes a vector shorter (in the plane this is the algorithm of Lagrange and Gauss). Each
// subtraction shortens a vector, so that the algorithm ends.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/value.hpp"

namespace moreau {

/// The periodic axes of the world and the bounds of the cell along them, or a lattice. Until set() or
/// set_vectors() is called, no axis is periodic. The images of a point x in a box are x + k length(axis)
/// Unit(axis) for all integers k and all periodic axes; in a lattice they are x + vectors() n for all
/// vectors n of integers.
template <EuclideanSpace S>
class PeriodicCell {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;

  /// Makes an axis periodic. With infinite bounds the axis becomes open (not periodic) again.
  /// @param axis         0 for x, 1 for y, ...
  /// @param lower,upper  bounds of the cell along this axis [m]
  /// @param function     the public function that the caller of the library called, for error
  ///                     messages
  /// @throws std::invalid_argument if the axis does not exist, unless lower < upper, or for a lattice
  void set(int axis, Scalar lower, Scalar upper, const char* function = "PeriodicCell::set") {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    require(axis >= 0 && axis < S::dim, function, "axis", axis, "must be an axis of the space");
    require(!is_lattice_, function, "axis", axis, "must not be of a cell given by vectors");
    const bool opens = lower == -infinity && upper == infinity;
    require(opens || std::isfinite(lower), function, "lower", lower, "must be finite");
    require(opens || (std::isfinite(upper) && upper > lower && std::isfinite(upper - lower)),
            function, "upper", upper, "must be finite and above lower");
    lower_[axis] = opens ? Scalar(0) : lower;
    length_[axis] = opens ? Scalar(0) : upper - lower;
  }

  /// Makes the cell a lattice: the parallelepiped of the vectors at `lower`.
  /// @param vectors  the vectors of the cell as columns, world axes [m]; linearly independent, right-handed
  /// @param lower    corner of the cell, world axes [m]
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument for numbers that are not finite, or a volume that is not positive
  void set_vectors(const Matrix& vectors, const VectorArgument<S>& lower,
                   const char* function = "PeriodicCell::set_vectors") {
    require(all_finite(vectors), function, "vectors", vectors, "must be finite");
    require(all_finite(lower), function, "lower", lower, "must be finite");
    const Scalar volume = vectors.determinant();
    require(std::isfinite(volume) && volume > 0, function, "vectors", vectors,
            "must have a positive determinant");
    is_lattice_ = true;
    lower_ = lower;
    assign(vectors);
  }
  /// Whether the cell is a lattice, which set_vectors() has made.
  bool is_lattice() const { return is_lattice_; }
  /// The vectors of the cell as columns, world axes [m]. Those of a box are parallel to the axes, and
  /// zero along open axes.
  Value<Matrix> vectors() const {
    Matrix columns = vectors_;
    for (int k = 0; k < S::dim && !is_lattice_; ++k) columns(k, k) = length_[k];
    return columns;
  }
  /// Volume of a lattice [m^3], in the plane its area [m^2].
  Scalar volume() const { return vectors().determinant(); }

  /// Deforms a lattice: its corner stays where it is, its vectors H become H + increment H. Many small increments add up
  /// without loss.
  /// @param increment [-]; I + increment has a positive determinant
  void deform(const Matrix& increment) {
    Matrix vectors = vectors_, lost = lost_;
    grow(vectors, lost, increment);
    assign(vectors);
    lost_ = lost;
  }
  /// The place of a point that moves with the deforming lattice, world axes [m].
  /// @param increment as in deform()
  Value<Vector> deformed(const Matrix& increment, const VectorArgument<S>& x) const {
    return x + product(increment, Vector(x - lower_));
  }
  /// Replaces the vectors of a lattice by short ones of the same lattice, as the head of this file says.
  /// @returns whether the vectors have changed
  bool reduce() {
    Matrix reduced = vectors_;
    bool changed = false;
    for (bool again = true; again;) {
      again = false;
      for (int i = 0; i < S::dim; ++i)
        for (int j = 0; j < S::dim; ++j) {
          if (i == j) continue;
          const Vector one = reduced.col(i), other = reduced.col(j);
          const Scalar along = one.dot(other) / other.squaredNorm();
          // If two vectors have the same length, the present one is kept.
          if (!(std::abs(along) > Scalar(0.5) + Scalar(1e-3))) continue;
          reduced.col(i) = moreau::along(one, -std::round(along), other);
          again = changed = true;
        }
      again = shorten(reduced) || again;
      changed = changed || again;
    }
    if (changed) assign(reduced);
    return changed;
  }

  /// Displacement by whole numbers of cells, world axes [m].
  /// @param cells signed numbers of cells along the axes or the vectors, whole numbers
  Value<Vector> shift(const VectorArgument<S>& cells) const {
    if (is_lattice_) return product(vectors_, Vector(cells));
    Vector shift = cells;
    for (int k = 0; k < S::dim; ++k) shift[k] *= length_[k];
    return shift;
  }
  /// The whole numbers of cells nearest to a displacement [m], rounded to the nearest number; zero along open axes.
  Value<Vector> cells(const VectorArgument<S>& displacement) const {
    Vector numbers = Vector::Zero();
    const Vector parts =
        is_lattice_ ? product(inverse_, Vector(displacement)) : Vector(displacement);
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        numbers[axis] = std::round(is_lattice_ ? parts[axis] : parts[axis] / length_[axis]);
    return numbers;
  }
  /// The whole numbers of cells by which a point x [m] lies from the cell, rounded down: 0 for a point in the cell. 0 along
  /// open axes.
  Value<Vector> cell_of(const VectorArgument<S>& x) const {
    Vector numbers = Vector::Zero();
    const Vector parts = is_lattice_ ? product(inverse_, Vector(x - lower_)) : Vector(x - lower_);
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        numbers[axis] = std::floor(is_lattice_ ? parts[axis] : parts[axis] / length_[axis]);
    return numbers;
  }

  /// Whether points have images by these signed numbers of cells: not along open axes.
  bool has_image(const VectorArgument<S>& cells) const {
    for (int axis = 0; axis < S::dim; ++axis)
      if (cells[axis] != 0 && !is_periodic(axis)) return false;
    return true;
  }
  bool is_open() const { return length_.isZero(0); }  ///< whether no axis is periodic
  /// whether this axis is periodic (0 for x)
  bool is_periodic(int axis) const { return length_[axis] > 0; }
  /// Lengths of a box along the axes [m]; zero along open axes. For a lattice, the lengths of its vectors.
  const Vector& length() const { return length_; }
  /// lower bounds along the axes [m]; zero along open axes; corner of a lattice
  const Vector& lower() const { return lower_; }

  /// The image of x that lies in the cell, world axes [m].
  [[nodiscard]] Value<Vector> wrap(const VectorArgument<S>& x) const {
    return image_from(lower_, x);
  }
  /// The image y of x with from <= y < from + length() along the periodic axes. Along open axes, y
  /// = x. In a lattice, the image in the cell whose corner is `from`. World axes [m].
  Value<Vector> image_from(const VectorArgument<S>& from, const VectorArgument<S>& x) const {
    Vector y = x;
    if (is_lattice_) {
      Vector parts = product(inverse_, Vector(x - from));
      for (int axis = 0; axis < S::dim; ++axis) {
        parts[axis] -= std::floor(parts[axis]);
        if (!(parts[axis] < 1)) parts[axis] = 0;  // by rounding
      }
      return from + product(vectors_, parts);
    }
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis)) {
        const Scalar cells = std::floor((x[axis] - from[axis]) / length_[axis]);
        y[axis] = std::max(from[axis], x[axis] - length_[axis] * cells);
        if (!(y[axis] < from[axis] + length_[axis])) y[axis] = from[axis];  // by rounding
      }
    return y;
  }
  /// The image of x that lies in a box, if one does; otherwise any image. World axes [m].
  /// @param box not longer than the cell, see fits()
  Value<Vector> image_in(const Aabb<S>& box, const VectorArgument<S>& x) const {
    if (!is_lattice_) return image_from(box.lower, x);
    const Vector middle = (box.lower + box.upper) / 2;
    return image_from(Vector(middle - product(vectors_, Vector(Vector::Constant(Scalar(0.5))))), x);
  }
  /// Whether at most one image of a point lies in a box of these lengths [m]: they are not longer than those of the
  /// cell; in a lattice, sum_i |H^-1_ki| length_i <= 1 for all k (see Room in the head of this file). The lower side of
  /// the next image may lie on the upper side of the box, and rounding does not count.
  /// @param rounding relative [-]
  bool fits(const VectorArgument<S>& lengths, Scalar rounding) const {
    if (is_lattice_) return (inverse_.cwiseAbs() * lengths).maxCoeff() <= 1 + rounding;
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis) && lengths[axis] > (1 + rounding) * length_[axis]) return false;
    return true;
  }
  /// The image of x nearest to the point `to`, world axes [m]. Along every periodic axis of a box it is
  /// at most half a cell away. In a lattice it is the nearest if the vectors are reduced (reduce()).
  Value<Vector> nearest(const VectorArgument<S>& x, const VectorArgument<S>& to) const {
    Vector y = x;
    if (is_lattice_) return nearest_in_lattice(x + shift(cells(to - x)), to);
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        y[axis] += length_[axis] * std::round((to[axis] - x[axis]) / length_[axis]);
    return y;
  }

  /// Checks that the cell is longer than twice the width of the widest grain. Then two grains touch
  /// through at most one image, and no grain touches its own image.
  /// @param width    width of the widest grain, including margin and skin [m]
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the cell is too short
  void require_room(Scalar width, const char* function) const {
    if (is_lattice_) {
      const Scalar height = 1 / largest_row_sum(inverse_);
      require(height > 2 * width, function, "height of the cell", height,
              "must be more than two of the widest grain with margin and skin");
      return;
    }
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || length_[axis] > 2 * width, function, "length of the cell",
              length_[axis], "must be more than two of the widest grain with margin and skin");
  }
  /// Checks that a plane wall does not bound a periodic axis.
  /// @param normal   normal of the wall, unit, world axes
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the wall bounds a periodic axis
  void require_along(const VectorArgument<S>& normal, const char* function) const {
    require(!is_lattice_, function, "normal", normal, "must not be of a wall: the cell deforms");
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || std::abs(normal[axis]) <= Scalar(1e-5), function, "normal",
              normal, "must be perpendicular to the periodic axes");
  }
  /// Checks that a surface around an axis does not bound a periodic axis.
  /// @param axis     axis of the surface, unit, world axes. In the plane it is the normal of the
  ///                 plane, so that the wall bounds all axes
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the wall bounds a periodic axis
  void require_around(const AngularArgument<S>& axis, const char* function) const {
    require(!is_lattice_, function, "axis", axis, "must not be of a cylinder: the cell deforms");
    for (int k = 0; k < S::dim; ++k)
      require(!is_periodic(k) || S::spin(axis, Vector::Unit(k)).norm() <= Scalar(1e-5), function,
              "axis", axis, "must be parallel to the periodic axes");
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(lower_, length_, is_lattice_, vectors_, lost_); }
  void deserialized() {
    if (!is_lattice_) return;
    const Matrix lost = lost_;
    require(all_finite(lost), "PeriodicCell", "lost", lost, "must be finite");
    set_vectors(Matrix(vectors_), Vector(lower_), "PeriodicCell");
    lost_ = lost;
  }

  /// Replaces a vector by its sum with others, each once or minus once, if that is shorter.
  /// @returns whether there was one
  MOREAU_INLINED static bool shorten(Matrix& vectors) {
    for (int n = 0; n < detail::neighbour_cells<S::dim>(); ++n) {
      const Vector parts = detail::neighbour_cell<Vector>(n);
      const Vector sum = product(vectors, parts);
      for (int k = 0; k < S::dim; ++k)
        if (parts[k] == 1 &&
            sum.squaredNorm() < Scalar(0.99) * Vector(vectors.col(k)).squaredNorm()) {
          vectors.col(k) = sum;
          return true;
        }
    }
    return false;
  }
  void assign(const Matrix& vectors) {
    vectors_ = vectors;
    lost_.setZero();
    inverse_ = vectors.inverse();
    for (int k = 0; k < S::dim; ++k) length_[k] = Vector(vectors.col(k)).norm();
  }
  /// The image of x nearest to `to` among x and its neighbours.
  Vector nearest_in_lattice(const Vector& x, const Vector& to) const {
    Vector best = x;
    int neighbours = 1;
    for (int axis = 0; axis < S::dim; ++axis) neighbours *= 3;
    for (int n = 0; n < neighbours; ++n) {
      Vector y = x;
      for (int axis = 0, rest = n; axis < S::dim; ++axis, rest /= 3)
        y += Scalar(rest % 3 - 1) * vectors_.col(axis);
      if ((y - to).squaredNorm() < (best - to).squaredNorm()) best = y;
    }
    return best;
  }

  Vector lower_ = Vector::Zero(), length_ = Vector::Zero();
  bool is_lattice_ = false;
  Matrix vectors_ = Matrix::Zero(), inverse_ = Matrix::Zero();  // H and H^-1 of a lattice
  Matrix lost_ = Matrix::Zero();                                // of H, see grow()
};

}  // namespace moreau
