// SPDX-License-Identifier: MIT
// Many points or directions, stored for scans that use vector registers.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/simd/cache_lines.hpp"
#include "moreau/simd/prefetch.hpp"
#include "moreau/simd/wide.hpp"

namespace moreau::detail {

/// The rows of an N x D matrix, such as the vertices [m] or the normals of a polytope, stored in tiles. Each tile has as many rows as a register has
/// lanes. In a tile the x of all its rows come first, then the y of all its rows, and so on. So a
/// scan reads memory in order, and a single row lies on one or two cache lines. The last tile is
/// filled up with copies of the first row, so that scans need no special case at the end. If
/// several rows are equal, a scan reports the first of them, never a copy.
template <class S>
class PointRows {
 public:
  using T = typename S::Scalar;
  using Lanes = Wide<T>;
  using Vector = typename S::Vector;
  using Wides = std::array<typename Lanes::Values, std::size_t{S::dim}>;

  /// Stores the rows of a matrix, rotated from body axes to world axes.
  template <class BodyRows>
  void assign(const BodyRows& body, const typename S::Matrix& rotation) {
    MOREAU_ASSERT(body.rows() > 0);
    count_ = body.rows();
    padded_ = Lanes::padded(count_);
    const auto size = std::size_t(S::dim * padded_);
    if (rows_.size() < size) rows_.resize(size);
    for (Eigen::Index i = 0; i < padded_; i += Lanes::lanes) {
      const Wides tile = load(body, i);
      for (Eigen::Index k = 0; k < S::dim; ++k) {
        auto sum = rotation(k, 0) * tile[0];
        for (Eigen::Index l = 1; l < S::dim; ++l)
          sum += rotation(k, l) * tile[static_cast<std::size_t>(l)];
        std::memcpy(rows_.data() + S::dim * i + k * Lanes::lanes, &sum, sizeof sum);
      }
    }
  }

  /// Begins to load the rows into the cache.
  void prefetch() const {
    detail::prefetch(rows_.data(), std::size_t(S::dim * padded_) * sizeof(T));
  }

  std::size_t size() const { return static_cast<std::size_t>(count_); }
  Eigen::Index padded_size() const { return padded_; }
  /// Row i. The function is always inlined. Otherwise g++ decides not to inline it and calls it for
  /// every vertex.
  [[gnu::always_inline]] Vector operator[](std::size_t i) const {
    constexpr std::size_t lanes = Lanes::lanes;
    const T* tile = rows_.data() + i / lanes * (S::dim * lanes) + i % lanes;
    Vector row;
    for (Eigen::Index k = 0; k < S::dim; ++k) row[k] = tile[k * Lanes::lanes];
    return row;
  }

  /// direction . row for the tile of rows that starts at row i.
  /// @param d  the direction, each component in all lanes
  typename Lanes::Values dot(Eigen::Index i, const Wides& d) const {
    const T* tile = rows_.data() + S::dim * i;
    typename Lanes::Values sum = d[0] * Lanes::load(tile);
    for (std::size_t k = 1; k < S::dim; ++k) sum += d[k] * Lanes::load(tile += Lanes::lanes);
    return sum;
  }
  static Wides broadcast(const Vector& v) {
    Wides wide;
    for (std::size_t k = 0; k < S::dim; ++k)
      wide[k] = Lanes::broadcast(v[static_cast<Eigen::Index>(k)]);
    return wide;
  }

  /// The tile of rows that starts at row i.
  Wides wide(Eigen::Index i) const {
    Wides rows;
    for (std::size_t k = 0; k < S::dim; ++k)
      rows[k] = Lanes::load(rows_.data() + S::dim * i + k * std::size_t{Lanes::lanes});
    return rows;
  }
  /// The smallest value of direction . row over all rows, for a different direction in each lane.
  typename Lanes::Values lowest(const Wides& directions) const {
    constexpr std::size_t lanes = Lanes::lanes;
    auto lowest = Lanes::broadcast(std::numeric_limits<T>::infinity());
    const T* tile = rows_.data();
    for (std::size_t left = size(); left > 0; tile += S::dim * lanes) {
      const std::size_t here = std::min(left, lanes);
      for (std::size_t l = 0; l < here; ++l) {
        auto height = directions[0] * Lanes::broadcast(tile[l]);
        for (std::size_t k = 1; k < S::dim; ++k)
          height += directions[k] * Lanes::broadcast(tile[k * lanes + l]);
        lowest = height < lowest ? height : lowest;
      }
      left -= here;
    }
    return lowest;
  }

  /// The largest value of direction . row over all rows, and the index of this row.
  Extreme<T> farthest(const Vector& direction) const {
    const auto d = broadcast(direction);
    auto index = Lanes::iota();
    WideMaximum<T> best{dot(0, d), index};
    for (Eigen::Index i = Lanes::lanes; i < padded_; i += Lanes::lanes) {
      index += Lanes::lanes;
      best.take(dot(i, d), index);
    }
    return best.reduce();
  }
  /// The largest value of direction . row over all rows.
  T reach(const Vector& direction) const {
    const auto d = broadcast(direction);
    auto best = dot(0, d);
    for (Eigen::Index i = Lanes::lanes; i < padded_; i += Lanes::lanes) {
      const auto here = dot(i, d);
      best = here > best ? here : best;
    }
    return Lanes::maximum(best)[0];
  }
  /// The number of rows with direction . row >= lowest.
  std::ptrdiff_t count_above(const Vector& direction, T lowest) const {
    const auto d = broadcast(direction);
    auto above = dot(0, d) >= lowest;
    // The copies of the first row at the end are not counted.
    const std::ptrdiff_t copies = above[0] ? padded_ - count_ : 0;
    for (Eigen::Index i = Lanes::lanes; i < padded_; i += Lanes::lanes)
      above += dot(i, d) >= lowest;
    const auto sum = Lanes::template fold<Lanes::lanes / 2>(
        above, [](const auto& x, const auto& y) -> typename Lanes::Indices { return x + y; });
    return -static_cast<std::ptrdiff_t>(sum[0]) - copies;
  }
  /// Bit i: whether direction . row i >= lowest. For at most 64 rows.
  std::uint64_t bits_above(const Vector& direction, T lowest) const {
    const auto d = broadcast(direction);
    std::uint64_t bits = 0;
    for (Eigen::Index i = 0; i < padded_; i += Lanes::lanes)
      bits |= std::uint64_t{Lanes::bits(dot(i, d) >= lowest)} << i;
    return bits & ~std::uint64_t{0} >> (64 - count_);
  }
  /// The square of the largest ratio of distance to rise [-]. The ratio is taken for the vector
  /// from one row, the apex, to each other row. Infinite if another row rises by `least` or less.
  /// @param apex   the row from which distances and rises are measured
  /// @param up     direction of the rise, unit
  /// @param least  [m]
  T spread2(const Vector& apex, const Vector& up, T least) const {
    const auto from = broadcast(apex), d = broadcast(up);
    const auto infinite = Lanes::broadcast(std::numeric_limits<T>::infinity());
    typename Lanes::Values widest{};
    for (Eigen::Index i = 0; i < padded_; i += Lanes::lanes) {
      typename Lanes::Values rise{}, length2{};
      for (std::size_t k = 0; k < S::dim; ++k) {
        const auto x =
            Lanes::load(rows_.data() + S::dim * i + k * std::size_t{Lanes::lanes}) - from[k];
        rise += d[k] * x;
        length2 += x * x;
      }
      const auto low = length2 == 0 ? typename Lanes::Values{} : infinite;
      const auto here = rise > least ? length2 / (rise * rise) : low;
      widest = here > widest ? here : widest;
    }
    return Lanes::maximum(widest)[0];
  }
  /// The bounding box of the rows, in their unit; there is at least one row.
  Aabb<S> bounding_box() const {
    Wides low, high;
    for (std::size_t k = 0; k < S::dim; ++k)
      low[k] = high[k] = Lanes::load(rows_.data() + k * std::size_t{Lanes::lanes});
    for (Eigen::Index i = Lanes::lanes; i < padded_; i += Lanes::lanes)
      for (std::size_t k = 0; k < S::dim; ++k) {
        const auto x = Lanes::load(rows_.data() + S::dim * i + k * std::size_t{Lanes::lanes});
        low[k] = x < low[k] ? x : low[k];
        high[k] = x > high[k] ? x : high[k];
      }
    Aabb<S> box;
    for (std::size_t k = 0; k < S::dim; ++k) {
      box.lower[static_cast<Eigen::Index>(k)] = -Lanes::maximum(-low[k])[0];
      box.upper[static_cast<Eigen::Index>(k)] = Lanes::maximum(high[k])[0];
    }
    return box;
  }
  /// Calls use(index) for each row with direction . row >= lowest, in ascending order of the index.
  template <class Use>
  void for_each_above(const Vector& direction, T lowest, Use&& use) const {
    const auto d = broadcast(direction);
    for (Eigen::Index i = 0; i < padded_; i += Lanes::lanes) {
      std::uint32_t above = Lanes::bits(dot(i, d) >= lowest);
      for (; above != 0; above &= above - 1) {
        const Eigen::Index k = i + std::countr_zero(above);
        if (k < count_) use(static_cast<std::uint32_t>(k));
      }
    }
  }

 private:
  /// Loads a tile of rows of a matrix whose columns are contiguous. Rows after the last row are
  /// copies of the first row.
  template <class BodyRows>
  static Wides load(const BodyRows& body, Eigen::Index i) {
    Wides tile;
    if (i + Lanes::lanes <= body.rows()) {
      for (std::size_t k = 0; k < S::dim; ++k)
        tile[k] = Lanes::load(&body(i, static_cast<Eigen::Index>(k)));
      return tile;
    }
    for (std::size_t k = 0; k < S::dim; ++k)
      for (int l = 0; l < Lanes::lanes; ++l)
        tile[k][l] = body(i + l < body.rows() ? i + l : 0, static_cast<Eigen::Index>(k));
    return tile;
  }

  List<T, cache_line> rows_;
  Eigen::Index count_ = 0, padded_ = 0;
};

}  // namespace moreau::detail
