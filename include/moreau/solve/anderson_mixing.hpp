// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace moreau::detail {

/// D. G. Anderson's mixing of a fixed-point iteration x -> g(x) (J. ACM 12 (1965) 547): the next x
/// is the combination of the last results whose change g - x, were g linear, would be least. It
/// asks for no stability: a mode that grows by itself is removed like any other.
template <class T>
class AndersonMixing {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// Forgets what was before; the iteration starts at x.
  void start(const Vector& x) {
    x_ = x;
    known_ = next_ = 0;
    first_ = true;
    if (change_.rows() == x.size()) return;
    change_.resize(x.size(), memory);
    result_.resize(x.size(), memory);
  }

  /// @param g in: g(x); out: the next x
  void mix(Vector& g) {
    x_ = g - x_;
    if (!first_) remember(g);
    first_ = false;
    last_change_ = x_;
    last_result_ = g;
    if (known_ > 0) g.noalias() -= result_.leftCols(known_) * weights().template cast<T>();
    x_ = g;
  }

 private:
  static constexpr int memory = 10;
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, memory, 1>;
  using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, memory, memory>;

  void remember(const Vector& g) {
    change_.col(next_) = x_ - last_change_;
    result_.col(next_) = g - last_result_;
    known_ = std::max(known_, next_ + 1);
    for (int k = 0; k < known_; ++k)
      gram_(k, next_) = gram_(next_, k) = double(change_.col(k).dot(change_.col(next_)));
    next_ = (next_ + 1) % memory;
  }

  /// Least squares | f - sum_k w_k (change of f)_k |, each change scaled to 1 and none trusted
  /// beyond `share` of the others.
  Weights weights() const {
    constexpr double share = 1e-10;
    Weights scale(known_), right(known_);
    for (int k = 0; k < known_; ++k) {
      scale[k] = gram_(k, k) > 0 ? 1 / std::sqrt(gram_(k, k)) : 0;
      right[k] = scale[k] * double(change_.col(k).dot(last_change_));
    }
    Gram scaled = scale.asDiagonal() * gram_.topLeftCorner(known_, known_) * scale.asDiagonal();
    scaled.diagonal().array() += share;
    return scale.cwiseProduct(scaled.ldlt().solve(right));
  }

  Vector x_, last_change_, last_result_;
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> change_, result_;  ///< a column per step
  Eigen::Matrix<double, memory, memory> gram_;  ///< products of the columns of change_
  int known_ = 0, next_ = 0;
  bool first_ = true;
};

}  // namespace moreau::detail
