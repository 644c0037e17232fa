// SPDX-License-Identifier: MIT
// Many vectors side by side, laid out so that a scan over them reads whole registers.
#pragma once

#include <Eigen/Core>

#include <array>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/wide.hpp"

namespace moreau::detail {

/// The rows of an N x D matrix, each column contiguous. Behind the last row the first one is
/// repeated up to a whole register, so that scans need no tail and never report a row that is not
/// there: of equals they report the first.
template <class S>
class Rows {
 public:
  using T = typename S::Scalar;
  using W = Wide<T>;
  using Vector = typename S::Vector;

  /// The rows of the body's matrix, turned.
  template <class BodyRows>
  void assign(const BodyRows& body, const typename S::Matrix& rotation) {
    MOREAU_ASSERT(body.rows() > 0);
    count_ = body.rows();
    rows_.resize(W::padded(count_), S::dim);
    rows_.topRows(count_).noalias() = body.lazyProduct(rotation.transpose());
    for (Eigen::Index i = count_; i < rows_.rows(); ++i) rows_.row(i) = rows_.row(0);
  }

  std::size_t size() const { return static_cast<std::size_t>(count_); }
  Eigen::Index padded_size() const { return rows_.rows(); }
  Vector operator[](std::size_t i) const {
    return rows_.row(static_cast<Eigen::Index>(i)).transpose();
  }

  /// direction . row for a register of rows from row i on; the direction in every lane.
  typename W::Values dot(Eigen::Index i, const std::array<typename W::Values, S::dim>& d) const {
    const T* column = rows_.data() + i;
    typename W::Values sum = d[0] * W::load(column);
    for (std::size_t k = 1; k < S::dim; ++k) sum += d[k] * W::load(column += rows_.rows());
    return sum;
  }
  static std::array<typename W::Values, S::dim> broadcast(const Vector& v) {
    std::array<typename W::Values, S::dim> wide;
    for (std::size_t k = 0; k < S::dim; ++k)
      wide[k] = W::broadcast(v[static_cast<Eigen::Index>(k)]);
    return wide;
  }

  /// The largest direction . row.
  Extreme<T> farthest(const Vector& direction) const {
    const auto d = broadcast(direction);
    auto index = W::iota();
    WideMaximum<T> best{dot(0, d), index};
    for (Eigen::Index i = W::lanes; i < rows_.rows(); i += W::lanes) {
      index += W::lanes;
      best.take(dot(i, d), index);
    }
    return best.reduce();
  }
  /// How many rows have direction . row >= lowest.
  std::ptrdiff_t count_above(const Vector& direction, T lowest) const {
    const auto d = broadcast(direction);
    auto above = dot(0, d) >= lowest;
    // The copies of the first row behind the last one do not count.
    const std::ptrdiff_t copies = above[0] ? rows_.rows() - count_ : 0;
    for (Eigen::Index i = W::lanes; i < rows_.rows(); i += W::lanes) above += dot(i, d) >= lowest;
    return -W::template fold<W::lanes / 2>(above, [](const auto& x, const auto& y) {
      return x + y;
    })[0] - copies;
  }
  /// The box around the rows.
  Aabb<S> bounding_box() const {
    Aabb<S> box;
    for (Eigen::Index k = 0; k < S::dim; ++k) {
      const T* column = rows_.data() + k * rows_.rows();
      auto low = W::load(column), high = low;
      for (Eigen::Index i = W::lanes; i < rows_.rows(); i += W::lanes) {
        const auto x = W::load(column + i);
        low = x < low ? x : low;
        high = x > high ? x : high;
      }
      box.lower[k] = -W::maximum(-low)[0];
      box.upper[k] = W::maximum(high)[0];
    }
    return box;
  }
  /// Calls use(row) for each row with direction . row >= lowest, in their order.
  template <class Use>
  void for_each_above(const Vector& direction, T lowest, Use&& use) const {
    const auto d = broadcast(direction);
    for (Eigen::Index i = 0; i < rows_.rows(); i += W::lanes) {
      const auto above = dot(i, d) >= lowest;
      for (int l = 0; l < W::lanes; ++l)
        if (above[l] && i + l < count_) use(static_cast<std::uint32_t>(i + l));
    }
  }

 private:
  Eigen::Matrix<T, Eigen::Dynamic, S::dim> rows_;
  Eigen::Index count_ = 0;
};

}  // namespace moreau::detail
