// SPDX-License-Identifier: MIT
// A sparse matrix of square blocks with a symmetric pattern, and its factorization L U without
// exchange of blocks. Blocks are eliminated in the order of minimum degree: the next block is that
// with the fewest neighbours that are left (A. George and J. W. H. Liu, SIAM Rev. 31 (1989) 1). A
// chain of bodies then has no fill. The pattern and the order are found once for each pattern.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace moreau::detail {

/// The matrix and its factors; the head of this file has the method. Keeps its memory.
/// @tparam N rows of a block
template <int N>
class BlockFactorization {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  using Segment = Eigen::Matrix<double, N, 1>;

  /// Finds the order of elimination and the blocks of the factors, unless they are those of the last
  /// call.
  /// @param count rows of blocks
  /// @param edges the pairs i != j with a block (i, j) and a block (j, i)
  void analyse(std::size_t count, std::span<const std::array<std::uint32_t, 2>> edges) {
    if (count == count_ && std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end()))
      return;
    count_ = count;
    edges_.assign(edges.begin(), edges.end());
    slots_.assign(count * count, none);
    degree_.assign(count, 0);
    slot_count_ = 0;
    for (std::size_t i = 0; i < count; ++i) slots_[i * count + i] = slot_count_++;
    for (const auto& [i, j] : edges) connect(i, j);
    order_.clear();
    later_.clear();
    first_later_.assign(1, 0);
    work_ = 0;
    gone_.assign(count, 0);
    for (std::size_t k = 0; k < count; ++k) eliminate(next());
  }
  /// Products of two blocks that a factorization takes.
  double work() const { return work_; }

  /// Makes all blocks zero.
  void clear() { blocks_.assign(slot_count_, Block::Zero()); }
  /// The block (i, j) of an edge, or of the diagonal.
  Block& block(std::size_t i, std::size_t j) { return blocks_[slots_[i * count_ + j]]; }

  /// Replaces the matrix by its factors.
  /// @returns false if a block to be inverted is singular
  bool factorize() {
    for (std::size_t k = 0; k < count_; ++k) {
      const std::uint32_t p = order_[k];
      Block& pivot = block(p, p);
      if (!invert(pivot)) return false;
      for (const std::uint32_t i : later(k)) {
        Block& lower = block(i, p);
        lower = (lower * pivot).eval();
        for (const std::uint32_t j : later(k)) block(i, j).noalias() -= lower * block(p, j);
      }
    }
    return true;
  }
  /// Replaces the right side by the solution.
  void solve(std::span<Segment> x) {
    for (std::size_t k = 0; k < count_; ++k) {
      const std::uint32_t p = order_[k];
      for (const std::uint32_t i : later(k)) x[i].noalias() -= block(i, p) * x[p];
    }
    for (std::size_t k = count_; k-- > 0;) {
      const std::uint32_t p = order_[k];
      Segment rest = x[p];
      for (const std::uint32_t j : later(k)) rest.noalias() -= block(p, j) * x[j];
      x[p].noalias() = block(p, p) * rest;
    }
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  void connect(std::size_t i, std::size_t j) {
    if (slots_[i * count_ + j] != none) return;
    slots_[i * count_ + j] = slot_count_++;
    slots_[j * count_ + i] = slot_count_++;
    ++degree_[i];
    ++degree_[j];
  }
  /// The row to be eliminated next.
  std::uint32_t next() const {
    std::uint32_t best = none;
    for (std::uint32_t i = 0; i < count_; ++i)
      if (!gone_[i] && (best == none || degree_[i] < degree_[best])) best = i;
    return best;
  }
  void eliminate(std::uint32_t p) {
    order_.push_back(p);
    gone_[p] = 1;
    const std::size_t begin = later_.size();
    for (std::uint32_t i = 0; i < count_; ++i)
      if (!gone_[i] && slots_[p * count_ + i] != none) later_.push_back(i);
    first_later_.push_back(later_.size());
    for (std::size_t a = begin; a < later_.size(); ++a) {
      --degree_[later_[a]];
      for (std::size_t b = begin; b < a; ++b) connect(later_[a], later_[b]);
    }
    const double neighbours = double(later_.size() - begin);
    work_ += 1 + neighbours * (neighbours + 1);
  }
  /// The rows that are eliminated after step k and have a block with that of step k.
  std::span<const std::uint32_t> later(std::size_t k) const {
    return std::span(later_).subspan(first_later_[k], first_later_[k + 1] - first_later_[k]);
  }

  /// Replaces a matrix by its inverse: Gauss and Jordan, with exchange of rows.
  static bool invert(Block& m) {
    std::array<int, std::size_t(N)> from;
    for (int k = 0; k < N; ++k) {
      int pivot = k;
      for (int i = k + 1; i < N; ++i)
        if (std::abs(m(i, k)) > std::abs(m(pivot, k))) pivot = i;
      from[std::size_t(k)] = pivot;
      if (!(std::abs(m(pivot, k)) > 0)) return false;
      if (pivot != k) m.row(k).swap(m.row(pivot));
      const double inverse = 1 / m(k, k);
      m(k, k) = 1;
      m.row(k) *= inverse;
      for (int i = 0; i < N; ++i) {
        if (i == k) continue;
        const double factor = m(i, k);
        m(i, k) = 0;
        m.row(i) -= factor * m.row(k);
      }
    }
    for (int k = N; k-- > 0;)
      if (from[std::size_t(k)] != k) m.col(k).swap(m.col(from[std::size_t(k)]));
    return true;
  }

  std::size_t count_ = 0;
  std::uint32_t slot_count_ = 0;
  double work_ = 0;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<std::uint32_t> slots_;   // of the block (i, j) in blocks_, or none
  std::vector<std::uint32_t> degree_;  // neighbours that are left
  std::vector<std::uint32_t> order_, later_;
  std::vector<std::size_t> first_later_;  // of each step, in later_
  std::vector<unsigned char> gone_;
  std::vector<Block> blocks_;
};

}  // namespace moreau::detail
