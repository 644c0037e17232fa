// SPDX-License-Identifier: MIT
// The mean velocity of grains in a vertical section, and the rotation of this velocity field.
//
// The section is spanned by the first axis, x, drawn to the right, and by the last axis (z in
// space, y in the plane), drawn upwards. A rotation that is counter-clockwise in this picture is
// positive. A field that points to the right above its centre and to the left below is clockwise,
// so its rotation is negative.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/measure/control_volume.hpp"

namespace moreau {

/// A cell of the section and the mean velocity in it. Vectors have two components: along the first
/// axis and along the last axis.
template <class T>
struct SectionSample {
  Eigen::Matrix<T, 2, 1> position;  ///< centre of the cell [m]
  Eigen::Matrix<T, 2, 1> velocity;  ///< mean over the grains in the cell [m/s]
  std::size_t grains;               ///< number of grains added, in all steps
};

/// The mean rotation of a velocity field.
template <class T>
struct Roll {
  T angular_velocity = 0;  ///< sum r x v / sum r^2, > 0 if counter-clockwise [rad/s]; r, v: see
                           ///< VelocityField::roll()
  /// sum r x v / sqrt(sum r^2 sum v^2), in [-1, 1] [-]. It is 1 or -1 for a rigid rotation.
  T strength = 0;
  /// Sum of |r x v| over the samples that rotate in the direction of the whole field, divided by
  /// the sum over all samples, in [0, 1] [-].
  T agreement = 0;
};

/// The mean velocity of the grains whose centres lie in each cell of a two-dimensional grid. The
/// grid divides the section of a control volume.
template <class S>
class VelocityField {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Sample = SectionSample<Scalar>;

  /// @param control_volume world axes [m]
  /// @param columns,rows   number of cells along the first axis and along the last axis, > 0
  /// @throws std::invalid_argument for no cells, or a control volume that is empty, inverted or not
  ///         finite
  VelocityField(const Aabb<S>& control_volume, std::size_t columns, std::size_t rows)
      : box_(control_volume), columns_(columns), rows_(rows) {
    require_control_volume(control_volume, "VelocityField");
    require(columns > 0, "VelocityField", "columns", columns, "must be > 0");
    require(rows > 0, "VelocityField", "rows", rows, "must be > 0");
    require(rows <= cells_.max_size() / columns, "VelocityField", "rows", rows,
            "must be no more than memory can hold");
    cells_.resize(columns * rows);
  }

  /// Removes all grains.
  void clear() { cells_.assign(cells_.size(), Cell{}); }

  /// Adds a grain, if its centre lies in the control volume. Call this function in several steps to
  /// average over time.
  /// @param position position of the grain's centre, world axes [m]; in a periodic cell, of any
  ///                 image
  /// @param velocity velocity of the grain's centre, world axes [m/s]
  /// @param periodic periodic cell of the simulation, Simulation::cell(): without it, only the given image counts
  /// @throws std::invalid_argument if a number is not finite, or if the control volume is longer than the
  ///         periodic cell, see require_within()
  void add(const VectorArgument<S>& position, const VectorArgument<S>& velocity,
           const PeriodicCell<S>& periodic = {}) {
    constexpr const char* self = "VelocityField::add";
    require(all_finite(position), self, "position", position, "must be finite");
    require(all_finite(velocity), self, "velocity", velocity, "must be finite");
    require_within(periodic, box_, self);
    const Vector image = periodic.image_in(box_, position);
    const Vector share = (image - box_.lower).cwiseQuotient(box_.upper - box_.lower);
    if (!((share.array() >= 0).all() && (share.array() < 1).all())) return;
    Cell& cell = cells_[index(share[S::dim - 1], rows_) * columns_ + index(share[0], columns_)];
    cell.velocity += section(velocity);
    ++cell.grains;
  }

  std::size_t columns() const { return columns_; }  ///< number of cells along the first axis
  std::size_t rows() const { return rows_; }        ///< number of cells along the last axis
  /// The cell in a column (counted from the left) and a row (counted from below). Its velocity is
  /// zero if it contains no grain.
  /// @throws std::invalid_argument unless column < columns() and row < rows()
  Sample sample(std::size_t column, std::size_t row) const {
    constexpr const char* self = "VelocityField::sample";
    require(column < columns_, self, "column", column, "must be below the number of columns");
    require(row < rows_, self, "row", row, "must be below the number of rows");
    const Cell& cell = cells_[row * columns_ + column];
    const Section extent = section(box_.upper - box_.lower);
    const Section share{(Scalar(column) + Scalar(0.5)) / Scalar(columns_),
                        (Scalar(row) + Scalar(0.5)) / Scalar(rows_)};
    const double grains = cell.grains > 0 ? double(cell.grains) : 1;
    return {section(box_.lower) + share.cwiseProduct(extent), cell.velocity.over(grains),
            cell.grains};
  }

  /// Rotation of the field. Each cell that contains grains is a sample of equal weight. r is the
  /// position of the cell relative to the mean position of these cells, and v its velocity relative
  /// to their mean velocity. Zero if the field does not rotate.
  Roll<Scalar> roll() const {
    detail::DoubleSum<Section> positions, velocities;
    double count = 0;
    for_each([&](const Sample& s) {
      positions += s.position;
      velocities += s.velocity;
      count += 1;
    });
    if (count == 0) return {};
    const Section centre = positions.over(count), drift = velocities.over(count);
    double turning = 0, opposite = 0, arms = 0, speeds = 0;
    for_each([&](const Sample& s) {
      const Section r = s.position - centre, v = s.velocity - drift;
      const double part = double(r.x() * v.y() - r.y() * v.x());
      turning += part;
      opposite += part < 0 ? -part : 0;
      arms += double(r.squaredNorm());
      speeds += double(v.squaredNorm());
    });
    if (!(arms > 0) || !(speeds > 0)) return {};
    const double all = turning + 2 * opposite;
    const double with = turning < 0 ? opposite : all - opposite;
    return {Scalar(turning / arms), Scalar(turning / std::sqrt(arms * speeds)),
            Scalar(all > 0 ? with / all : 0)};
  }

 private:
  using Section = Eigen::Matrix<Scalar, 2, 1>;
  struct Cell {
    detail::DoubleSum<Section> velocity;
    std::size_t grains = 0;
  };

  static Section section(const Vector& x) { return {x[0], x[S::dim - 1]}; }
  static std::size_t index(Scalar share, std::size_t cells) {
    const auto i = static_cast<std::size_t>(share * Scalar(cells));
    return i < cells ? i : cells - 1;
  }
  void for_each(const auto& visit) const {
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column)
        if (cells_[row * columns_ + column].grains > 0) visit(sample(column, row));
  }

  Aabb<S> box_;
  std::size_t columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace moreau
