// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// D. G. Anderson's mixing of a fixed-point iteration x -> g(x) (J. ACM 12 (1965) 547): the next x
/// is the combination of the last results whose change g - x would be least if g were linear. The
/// iteration need not be stable: growing modes are removed as decaying ones are.
template <class T>
class AndersonMixing {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  /// Starts the iteration at x.
  void start(const Vector& x) {
    x_ = x;
    known_ = next_ = 0;
    first_ = true;
  }

  /// @param g      in: g(x); out: the next x
  /// @param shared bodies that contact problems of other processes share: x has a part in each
  ///               process; null: none
  void mix(Vector& g, SharedBodies* shared = nullptr) {
    x_ = g - x_;
    if (!first_) remember(g, shared);
    first_ = false;
    last_change_ = x_;
    last_result_ = g;
    const Weights share = weights(shared);
    for (std::size_t k = 0; k < known_; ++k) g -= T(share[k]) * result_[k];
    x_ = g;
  }

 private:
  static constexpr std::size_t memory = 10;
  using Weights = std::array<double, memory>;
  using Gram = std::array<Weights, memory>;

  void remember(const Vector& g, SharedBodies* shared) {
    change_[next_] = x_ - last_change_;
    result_[next_] = g - last_result_;
    known_ = std::max(known_, next_ + 1);
    const Weights products = products_with(change_[next_], shared);
    for (std::size_t k = 0; k < known_; ++k) gram_[k][next_] = gram_[next_][k] = products[k];
    next_ = (next_ + 1) % memory;
  }

  /// The products of a vector with the stored changes. In double precision: squares of impulses of grains of 1e-6 m or 1e4 m
  /// cannot be represented in single precision.
  Weights products_with(const Vector& x, SharedBodies* shared) const {
    Weights products{};
    for (std::size_t k = 0; k < known_; ++k) products[k] = product(change_[k], x);
    if (shared) shared->sum(std::span(products).first(known_));
    return products;
  }

  static double product(const Vector& a, const Vector& b) {
    if constexpr (std::is_same_v<T, double>)
      return a.dot(b);
    else
      return a.template cast<double>().dot(b.template cast<double>());
  }

  /// Returns the weights w_k that minimize |f - sum_k w_k df_k|^2 + c sum_k (w_k |df_k|)^2, where
  /// f = g(x) - x is the residual of the last iteration, df_k are the stored differences of
  /// residuals of successive iterations, and c is `regularization`.
  Weights weights(SharedBodies* shared) const {
    constexpr double regularization = 1e-10;
    Weights scale{}, right = products_with(last_change_, shared);
    for (std::size_t k = 0; k < known_; ++k) {
      scale[k] = gram_[k][k] > 0 ? 1 / std::sqrt(gram_[k][k]) : 0;
      right[k] *= scale[k];
    }
    Gram scaled{};
    for (std::size_t i = 0; i < known_; ++i)
      for (std::size_t k = 0; k < known_; ++k)
        scaled[i][k] = scale[i] * gram_[i][k] * scale[k] + (i == k ? regularization : 0);
    solve(scaled, right, known_);
    for (std::size_t k = 0; k < known_; ++k) right[k] *= scale[k];
    return right;
  }

  /// Solves A x = b by A = L D L^T, A positive definite. Overwrites A, and b by x.
  static void solve(Gram& a, Weights& b, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i) {
        const double factor = a[i][k] / a[k][k];
        for (std::size_t j = i; j < n; ++j) a[j][i] -= factor * a[j][k];
        b[i] -= factor * b[k];
      }
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t i = k + 1; i < n; ++i) b[k] -= a[i][k] * b[i];
      b[k] /= a[k][k];
    }
  }

  Vector x_, last_change_, last_result_;
  std::array<Vector, memory> change_, result_;  ///< one per step
  Gram gram_{};                                 ///< products of the changes
  std::size_t known_ = 0, next_ = 0;
  bool first_ = true;
};

}  // namespace moreau::detail
