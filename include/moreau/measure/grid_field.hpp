// SPDX-License-Identifier: MIT
// Means over the grains in each cell of a grid: fields of velocity, of displacement, or of any
// other vector quantity of the grains.
//
//   GridField<S> velocity(box, {20, 20, 10}), displacement(box, {20, 20, 10});
//   velocity.add(x, v, mass);              // for every grain, in one step or in several
//   displacement.add(x_0, x - x_0);        // x_0 = reference position, to which the field refers
//
// The poses of a periodic simulation are not wrapped into the cell. So the difference of two poses
// of a grain is its displacement. Pass the cell as the last argument of add(): it adds the image of the grain that lies in
// the control volume.
#pragma once

#include <cstddef>
#include <vector>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/measure/control_volume.hpp"

namespace moreau {

/// The result for one cell of a grid.
template <class S>
struct GridSample {
  typename S::Vector position;  ///< centre of the cell, world axes [m]
  typename S::Vector value;     ///< weighted mean over the grains in the cell, in the unit of the
                                ///< values; zero without grains
  typename S::Scalar weight;    ///< sum of the weights of these grains, in the unit of the weights
  std::size_t grains;           ///< number of grains added, in all steps
};

/// Weighted means of a vector quantity over the grains whose centres lie in each cell of a grid.
template <class S>
class GridField {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Cells = Eigen::Matrix<std::size_t, S::dim, 1>;

  /// @param control_volume world axes [m]
  /// @param cells          number of cells along each axis, > 0
  /// @throws std::invalid_argument if there are no cells along an axis, or more cells than memory
  ///         can hold, or if the control volume is empty, inverted or not finite
  GridField(const Aabb<S>& control_volume, const Components<S::dim, std::size_t>& cells)
      : box_(control_volume), cells_(cells) {
    require_control_volume(control_volume, "GridField");
    std::size_t count = 1;
    for (const std::size_t n : cells) {
      require(n > 0 && n <= sums_.max_size() / count, "GridField", "cells", n,
              "must be > 0 along every axis, and no more than memory can hold");
      count *= n;
    }
    sums_.resize(count);
  }

  /// Removes all grains.
  void clear() { sums_.assign(sums_.size(), Sum{}); }

  /// Adds a grain, if its centre lies in the control volume. Call this function in several steps to
  /// average over time.
  /// @param position position of the grain's centre, world axes [m]; in a periodic cell, of any
  ///                 image
  /// @param value    the quantity to average, in any unit
  /// @param weight   > 0. If the value is the velocity and the weight the mass [kg], the mean in a
  ///                 cell is the momentum of its grains divided by their mass
  /// @param periodic periodic cell of the simulation, Simulation::cell(): without it, only the given image counts
  /// @throws std::invalid_argument if a number is not finite, if the weight is not positive, or if the control
  ///         volume is longer than the periodic cell, see require_within()
  void add(const VectorArgument<S>& position, const VectorArgument<S>& value, Scalar weight = 1,
           const PeriodicCell<S>& periodic = {}) {
    constexpr const char* self = "GridField::add";
    require(all_finite(position), self, "position", position, "must be finite");
    require(all_finite(value), self, "value", value, "must be finite");
    require_positive(weight, self, "weight");
    require_within(periodic, box_, self);
    const Vector image = periodic.image_in(box_, position);
    const Vector share = (image - box_.lower).cwiseQuotient(box_.upper - box_.lower);
    if (!((share.array() >= 0).all() && (share.array() < 1).all())) return;
    std::size_t index = 0;
    for (int axis = S::dim; axis-- > 0;) {
      const std::size_t n = cells_[axis];
      const auto k = static_cast<std::size_t>(share[axis] * Scalar(n));
      index = index * n + (k < n ? k : n - 1);
    }
    Sum& sum = sums_[index];
    sum.value += weight * value;
    sum.weight += double(weight);
    ++sum.grains;
  }

  const Aabb<S>& control_volume() const { return box_; }  ///< world axes [m]
  const Cells& cells() const { return cells_; }           ///< number of cells along each axis
  std::size_t size() const { return sums_.size(); }       ///< total number of cells
  /// The result for cell k. Consecutive k run along the first axis.
  /// @throws std::invalid_argument unless k < size()
  GridSample<S> sample(std::size_t k) const {
    require(k < size(), "GridField::sample", "k", k, "must be below the number of cells");
    const Sum& sum = sums_[k];
    Vector share;
    for (int axis = 0; axis < S::dim; ++axis) {
      const std::size_t n = cells_[axis];
      share[axis] = (Scalar(k % n) + Scalar(0.5)) / Scalar(n);
      k /= n;
    }
    const Vector mean = sum.grains > 0 ? sum.value.over(sum.weight) : Vector(Vector::Zero());
    return {box_.lower + share.cwiseProduct(box_.upper - box_.lower), mean, Scalar(sum.weight),
            sum.grains};
  }

 private:
  struct Sum {
    detail::DoubleSum<Vector> value;
    double weight = 0;
    std::size_t grains = 0;
  };

  Aabb<S> box_;
  Cells cells_;
  std::vector<Sum> sums_;
};

}  // namespace moreau
