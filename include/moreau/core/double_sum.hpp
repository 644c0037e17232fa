// SPDX-License-Identifier: MIT
// Sums of many numbers in double precision, whatever the scalar of the simulation is. A sum in float of 1e6 equal numbers
// has an error of up to 1 %, and one of 1e8 numbers stops growing.
#pragma once

#include <array>
#include <cstddef>

namespace moreau::detail {

/// The sum of vectors or matrices of a fixed size, in double precision.
/// @tparam Matrix type of the terms, an Eigen::Matrix
template <class Matrix>
class DoubleSum {
 public:
  DoubleSum& operator+=(const Matrix& term) {
    for (std::size_t k = 0; k < size; ++k) values_[k] += double(term.data()[k]);
    return *this;
  }
  /// The sum divided by a number, in the scalar of the terms.
  Matrix over(double divisor) const {
    Matrix result;
    for (std::size_t k = 0; k < size; ++k)
      result.data()[k] = typename Matrix::Scalar(values_[k] / divisor);
    return result;
  }
  Matrix value() const { return over(1); }  ///< the sum, in the scalar of the terms

 private:
  static constexpr std::size_t size = Matrix::SizeAtCompileTime;

  std::array<double, size> values_{};
};

}  // namespace moreau::detail
