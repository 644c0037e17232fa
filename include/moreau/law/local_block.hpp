// SPDX-License-Identifier: MIT
// The Delassus block of one contact, factored so that the local solution of a law is a few
// divisions.
//
// Eliminating the normal impulse from u = W r + b leaves the tangential Schur complement
// W_tt - w_tn w_tn^T / w_nn. With the tangents of the contact frame turned to its eigenvectors,
//
//     W = w_nn [1 k^T; k k k^T] + diag(0, slip),        k = w_tn / w_nn (the coupling),
//
// and the impulse with u_n = 0 and u_t = -alpha r_t (alpha = 0 sticks) is
//
//     r_t = -(b_t - k b_n) / (slip + alpha)   (entry by entry),     r_n = -b_n / w_nn - k . r_t.
#pragma once

#include <array>
#include <cstddef>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/space.hpp"
#include "moreau/simd/wide.hpp"

namespace moreau {

/// W of one contact in its own frame, normal first; tangents aligned as above [1/kg]. Or W of one contact per SIMD
/// lane.
/// @tparam NumberT detail::OneNumber: one contact, vectors of Eigen; detail::Wide: a contact per lane, arrays of
///                 registers
template <class S, class NumberT = detail::OneNumber<typename S::Scalar>>
struct LocalBlock {
  using Number = NumberT;                     ///< OneNumber or Wide
  using Scalar = typename S::Scalar;          ///< double or float
  using Values = typename Number::Values;     ///< an entry: a number, or one number per lane
  using Index = typename Number::Index;       ///< of the entries of a vector
  static constexpr Index dim = S::dim;        ///< D
  static constexpr Index rows = dim;          ///< rows of a contact
  static constexpr Index tangents = dim - 1;  ///< D - 1
  using Vector = typename detail::RowsOf<Number, S::dim>::Type;       ///< D entries, normal first
  using Tangent = typename detail::RowsOf<Number, S::dim - 1>::Type;  ///< D - 1 entries

  Values normal;     ///< w_nn [1/kg]
  Tangent coupling;  ///< k = w_tn / w_nn [-]
  Tangent slip;      ///< eigenvalues of the Schur complement [1/kg]

  /// W r [m/s] of an impulse r [N s], both in the frame, normal first.
  Vector operator*(const Vector& r) const {
    Values sum = r[0];
    for (Index t = 0; t < tangents; ++t) sum += coupling[t] * r[t + 1];
    Vector u;
    u[0] = normal * sum;
    for (Index t = 0; t < tangents; ++t) u[t + 1] = u[0] * coupling[t] + slip[t] * r[t + 1];
    return u;
  }
  /// Makes the block that of W times a factor > 0 [-].
  LocalBlock& operator*=(Scalar factor) {
    normal *= factor;
    for (Index t = 0; t < tangents; ++t) slip[t] *= factor;
    return *this;
  }
  /// Trace of W [1/kg].
  Values trace() const {
    Values squares = 1 + coupling[0] * coupling[0], slips = slip[0];
    for (Index t = 1; t < tangents; ++t) {
      squares += coupling[t] * coupling[t];
      slips += slip[t];
    }
    return normal * squares + slips;
  }
  /// W, D x D, normal first [1/kg]; of one contact.
  MOREAU_INLINED typename S::Matrix matrix() const {
    typename S::Matrix w;
    for (int k = 0; k < S::dim; ++k) w.col(k) = *this * Vector(Vector::Unit(k));
    return w;
  }

  /// Sets the block of a lane, lane < Number::lanes.
  void set(std::size_t lane, const LocalBlock<S>& block) {
    Number::set(normal, lane, block.normal);
    for (int t = 0; t < S::dim - 1; ++t) {
      Number::set(coupling[Index(t)], lane, block.coupling[t]);
      Number::set(slip[Index(t)], lane, block.slip[t]);
    }
  }
  /// The block of a lane, lane < Number::lanes.
  LocalBlock<S> operator[](std::size_t lane) const {
    LocalBlock<S> block;
    block.normal = Number::get(normal, lane);
    for (int t = 0; t < S::dim - 1; ++t) {
      block.coupling[t] = Number::get(coupling[Index(t)], lane);
      block.slip[t] = Number::get(slip[Index(t)], lane);
    }
    return block;
  }
};

namespace detail {

/// W after its tangents are turned. new tangents = old tangents * turn
template <class S, class Number>
struct AlignedBlock {
  static constexpr std::size_t tangents = S::dim - 1;
  using Values = typename Number::Values;
  LocalBlock<S, Number> block;
  std::array<std::array<Values, tangents>, tangents> turn;
};

/// The turn of the tangents of one contact about its normal, for vectors. One tangent has none.
template <class S, int Tangents = S::dim - 1>
struct TangentTurn {
  static constexpr bool turns = false;
};
template <class S>
struct TangentTurn<S, 2> {
  static constexpr bool turns = true;
  typename S::Scalar cosine, sine;

  /// Writes a vector with entries along the tangents as one along the turned tangents.
  /// @param vector in, out: entries k and k + 1 are those along the tangents
  /// @param back   the other way round
  void apply(auto& vector, int k, bool back) const {
    const typename S::Scalar s = back ? -sine : sine, first = vector[k], second = vector[k + 1];
    vector[k] = cosine * first + s * second;
    vector[k + 1] = cosine * second - s * first;
  }
};

/// @param w lower triangle of W, row after row
template <class S, class Number>
AlignedBlock<S, Number> aligned_block(
    const std::array<typename Number::Values, std::size_t{S::dim * (S::dim + 1) / 2}>& w) {
  using Values = typename Number::Values;
  using Index = typename Number::Index;
  constexpr std::size_t turned = S::dim - 1;
  static_assert(turned <= 2, "of three rows one rotation for each pair is not enough");
  const auto entry = [&](std::size_t i, std::size_t k) -> const Values& {
    return w[i < k ? k * (k + 1) / 2 + i : i * (i + 1) / 2 + k];
  };
  const Values zero{}, one = zero + 1;
  AlignedBlock<S, Number> aligned;
  auto& [block, turn] = aligned;
  // No impulse changes the normal velocity: the contact cannot act (ContactLanes), any value will do.
  block.normal = entry(0, 0) == zero ? (entry(1, 1) == zero ? one : entry(1, 1)) : entry(0, 0);
  const Values inverse = one / block.normal;
  std::array<Values, turned> k;  // before the turn
  for (std::size_t t = 0; t < turned; ++t) k[t] = entry(t + 1, 0) * inverse;
  std::array<std::array<Values, turned>, turned> schur;
  for (std::size_t i = 0; i < turned; ++i)
    for (std::size_t j = 0; j < turned; ++j) {
      schur[i][j] = entry(i + 1, j + 1) - entry(i + 1, 0) * k[j];
      turn[i][j] = i == j ? one : zero;
    }
  if constexpr (turned == 2) {
    // One Jacobi rotation by the smaller angle.
    const Values mixed = schur[1][0] + schur[1][0];
    const Values theta = (schur[1][1] - schur[0][0]) / (mixed == zero ? one : mixed);
    const Values size = theta < zero ? -theta : theta;
    const Values least = one / (size + Number::square_root(theta * theta + one));
    const Values signed_least = theta < zero ? -least : least;
    const Values tangent = mixed == zero ? zero : signed_least;
    const Values cosine = one / Number::square_root(tangent * tangent + one);
    turn[0][0] = turn[1][1] = cosine;
    turn[0][1] = tangent * cosine;
    turn[1][0] = -(tangent * cosine);
  }
  for (std::size_t t = 0; t < turned; ++t) {
    Values &coupling = block.coupling[Index(t)], &slip = block.slip[Index(t)];
    coupling = slip = zero;
    for (std::size_t i = 0; i < turned; ++i) {
      coupling += turn[i][t] * k[i];
      for (std::size_t j = 0; j < turned; ++j) slip += turn[i][t] * schur[i][j] * turn[j][t];
    }
  }
  return aligned;
}

}  // namespace detail

/// Finds the rotation of the tangents (columns 1.. of the contact frame) that makes W a LocalBlock.
/// @param w     W in the given frame, D x D, normal first, symmetric positive definite [1/kg]
/// @param turn  out: D - 1 x D - 1, a rotation; new tangents = old tangents * turn
/// @returns W in the turned frame
template <class S>
LocalBlock<S> align_tangents(const typename S::Matrix& w,
                             Eigen::Matrix<typename S::Scalar, S::dim - 1, S::dim - 1>& turn) {
  using T = typename S::Scalar;
  constexpr std::size_t tangents = S::dim - 1;
  std::array<T, (tangents + 1) * (tangents + 2) / 2> lower;
  for (int i = 0, e = 0; i < S::dim; ++i)
    for (int k = 0; k <= i; ++k) lower[std::size_t(e++)] = w(i, k);
  const auto aligned = detail::aligned_block<S, detail::OneNumber<T>>(lower);
  for (std::size_t t = 0; t < tangents; ++t)
    for (std::size_t i = 0; i < tangents; ++i)
      turn(Eigen::Index(i), Eigen::Index(t)) = aligned.turn[i][t];
  return aligned.block;
}

}  // namespace moreau
